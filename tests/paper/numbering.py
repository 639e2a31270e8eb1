"""Numbers of the paper's labels, as its class (siamart, one run of figures and tables) gives them, from its source."""

import re

SHARED = ("theorem", "lemma", "proposition", "definition", "remark", "assumption")  # one counter within each section
NAMES = {"theorem": "Theorem", "lemma": "Lemma", "proposition": "Proposition", "definition": "Definition",
         "remark": "Remark", "assumption": "Assumption"}  # fmt: skip
TOKEN = re.compile(
    r"\\appendix|\\section(?!\*)|\\subsection(?!\*)|\\subsubsection(?!\*)|\\begin\{(\w+\*?)\}|\\end\{(\w+\*?)\}"
    r"|\\item|\\caption|\\subcaptionbox|\\label(?:\[\w+\])?\{([^}]*)\}"
)


def numbers(source):
    """Return {label: reference} for sections, theorems, figures and tables, their parts with letters."""
    text = re.sub(r"(?<!\\)%.*", "", source)
    text = text[text.index(r"\begin{document}") :]
    section, shared, figure, table = [0, 0, 0], 0, 0, 0
    appendix = False
    stack, found = [], {}
    here = ""  # the reference that a label outside all environments names
    part = {}  # letters used in the present theorem or figure

    def letter(kind):
        part[kind] = part.get(kind, 0) + 1
        return chr(ord("a") + part[kind] - 1)

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
            shared = 0 if level == 0 else shared
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
            elif opened.startswith(("equation", "align", "subequations", "gather")):
                current = ""
        elif closed:
            name, before = stack.pop()
            current = before
            if name in SHARED:
                current = here
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
