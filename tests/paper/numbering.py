"""Numbers of the paper's labels, as its class (siamart, one run of figures and tables) gives them, from its source.

Equations are numbered within sections, rows of an `align` one by one, those of `subequations` by letters.
"""

import re

SHARED = ("theorem", "lemma", "proposition", "definition", "remark", "assumption")  # one counter within each section
NAMES = {"theorem": "Theorem", "lemma": "Lemma", "proposition": "Proposition", "definition": "Definition",
         "remark": "Remark", "assumption": "Assumption"}  # fmt: skip
TOKEN = re.compile(
    r"\\appendix|\\section(?!\*)|\\subsection(?!\*)|\\subsubsection(?!\*)|\\begin\{(\w+\*?)\}|\\end\{(\w+\*?)\}"
    r"|\\item(?![a-z])|\\caption|\\subcaptionbox|\\label(?:\[\w+\])?\{([^}]*)\}"
    r"|\\\\|\\nonumber|\\notag|\\intertext"
)


def numbers(source):
    """Return {label: reference} for sections, theorems, figures and tables, their parts with letters."""
    text = re.sub(r"(?<!\\)%.*", "", source)
    text = text[text.index(r"\begin{document}") :]
    section, shared, figure, table, equation = [0, 0, 0], 0, 0, 0, 0
    letters = None  # of subequations: rows so far
    appendix = False
    stack, found = [], {}
    here = ""  # the reference that a label outside all environments names
    part = {}  # letters used in the present theorem or figure

    def letter(kind):
        part[kind] = part.get(kind, 0) + 1
        return chr(ord("a") + part[kind] - 1)

    def numbered_row():
        return f"({top()}.{equation}{'' if letters is None else chr(ord('a') + letters - 1)})"

    def top():
        return chr(ord("A") + section[0] - 1) if appendix else str(section[0])

    current = ""
    for token in TOKEN.finditer(text):
        word, opened, closed, label = token[0], token[1], token[2], token[3]
        if word == r"\appendix":
            appendix, section[:] = True, [0, 0, 0]
        elif word in (r"\section", r"\subsection", r"\subsubsection"):
            level = word.count("sub")
            section[level] += 1
            section[level + 1 :] = [0] * (2 - level)
            shared, equation = (0, 0) if level == 0 else (shared, equation)
            numbered = ".".join([top(), *map(str, section[1 : level + 1])])
            here = f"{'Appendix' if appendix else 'Section'} {numbered}"
            current = here
        elif opened:
            stack.append((opened, current))
            if opened in SHARED:
                shared += 1
                part.clear()
                current = f"{NAMES[opened]} {top()}.{shared}"
            elif opened in ("figure", "table"):
                figure, table = figure + (opened == "figure"), table + (opened == "table")
                part.clear()
                current = f"Figure {figure}" if opened == "figure" else f"Table {table}"
            elif opened == "subfigure":
                current = f"{current}({letter('figure')})"
            elif opened == "subequations":
                equation, letters = equation + 1, 0
                current = f"({top()}.{equation})"
            elif opened in ("equation", "align"):
                if letters is None:
                    equation += 1
                else:
                    letters += 1
                current = numbered_row()
            elif opened in ("equation*", "align*"):
                current = ""
        elif closed:
            name, before = stack.pop()
            current = before
            letters = None if name == "subequations" else letters
            if name in SHARED:
                current = here
        elif word in (r"\\", r"\nonumber", r"\notag", r"\intertext"):
            last = word == r"\\" and re.match(r"\s*\\end\{align\}", text[token.end() :])
            done = word == r"\intertext" and text[: token.start()].rstrip().endswith(r"\\")  # it ends the row itself
            if stack and stack[-1][0] == "align" and word in (r"\\", r"\intertext") and not last and not done:
                equation, letters = (equation + 1, None) if letters is None else (equation, letters + 1)
                current = numbered_row()
            elif stack and stack[-1][0] in ("align", "equation") and word in (r"\nonumber", r"\notag"):
                equation -= 1
        elif word == r"\subcaptionbox":
            current = f"Figure {figure}({letter('figure')})"
        elif word == r"\item":
            inside = [name for name, _ in stack]
            if inside and inside[-1] == "enumerate" and any(name in SHARED for name in inside):
                owner = next(ref for ref in [current] if ref).split("(")[0]
                current = f"{owner}({letter('item')})"
        elif word == r"\caption":
            if stack and stack[-1][0] == "figure":  # the caption of the whole: its label names the whole figure
                current = f"Figure {figure}"
        elif label and current:
            found[label] = current
    return found
