"""Names are verbs or what they stand for, and docstrings begin as an entry of a reference does."""

import ast
from collections import Counter
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
MODULES = sorted(path for room in ("app", "codim2_core") for path in (ROOT / room).rglob("*.py"))
#: A docstring that begins with one of these is no sentence that an index of functions could print.
OPENINGS = {"What", "Whom", "Who", "Whose", "Where", "How", "Which", "Why", "When", "That", "Of", "As", "From"}
#: Participles, prepositions, adverbs and pronouns are no names of functions. Methods may be: `system.at(z)`.
REFUSED = set(
    """
    about above after ahead all along alike among answered apart around arriving asked at before begun behind
    below beside between beyond both bound bounded by carried checked closed compared compiled continued
    corrected counted crossed cut drawn each ended entered extended filled finished followed foretold found from
    gathered given held here interpolated into it its joined judged kept known led left linearised located made
    mapped matched measured met moved named narrowed near noted on one onto opened over own packed passed
    passing picked placed polished posed put reached refined rendered reversed rotated rounded sampled scaled
    searched seen settled shared shortened shown smoothed solved sought started stepped swept taken then there
    through together told traced turned typed under unknown whole why with within without written
    """.split()  # noqa: SIM905 (read as a list of words)
)
#: Names that three modules or more have, their own among them, each with its reason.
SHARED = {
    "__all__": "Python's own",
    "__getattr__": "Python's own",
    "__dir__": "Python's own",
    "_HOMES": "where the public names of a package are",
    "add": "a panel's, or a slow layer's, part of a frame: `registry` calls it",
    "PANEL": "a panel's row of the registry",
    "EXAMPLE": "an example's row of the list",
    "FAMILY": "a family of Psi's row of the list",
    "derivatives": "a family's derivatives of Psi",
    "gain": "a family's compiled gain: e_Psi = gain p",
    "result.py": "the public result of a room",
    "register": "adds to a list that a program may extend: examples, presets, families, panels",
    "unregister": "takes off such a list",
    "RTOL": "relative tolerance of an integration, as SciPy has it",
    "ATOL": "absolute tolerance of an integration, as SciPy has it",
    "DIFFERENCE_STEP": "step of a finite difference",
    "MIN_STEP": "shortest step along a curve or in time",
    "MAX_NEWTON": "bound on iterations of Newton's method",
    "NEWTON_TOLERANCE": "last correction of Newton's method",
    "MAX_CORRECTION": "longest correction of Newton's method",
    "MAX_HALVINGS": "bound on halvings of a step or an interval",
    "MAX_ROUNDS": "bound on rounds of an iteration",
    "ON_CURVE_DISTANCE": "distance below which a point lies on a curve that is known",
    "ONE_SIDED_DISTANCE": "step to one side of a kink, where derivatives are taken",
}


@cache
def tree(path):
    return ast.parse(path.read_text())


def definitions(node):
    yield node
    for part in getattr(node, "body", ()):
        if isinstance(part, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield from definitions(part)


def test_every_docstring_begins_as_an_entry_of_a_reference():
    found = []
    for path in MODULES:
        for node in definitions(tree(path)):
            said = ast.get_docstring(node)
            if said and said.split()[0].strip("`,:;.") in OPENINGS:
                found.append((path.relative_to(ROOT).as_posix(), said.split("\n")[0]))
    assert not found


def test_every_function_is_a_verb_or_what_it_returns():
    assert not [
        (path.relative_to(ROOT).as_posix(), node.name)
        for path in MODULES
        for node in tree(path).body
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name.strip("_") in REFUSED
    ]


def names_of(path):
    yield path.name
    for node in tree(path).body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                yield from (name.id for name in ast.walk(target) if isinstance(name, ast.Name))


def test_a_name_of_many_modules_has_its_reason():
    assert len(SHARED) <= 30
    homes = Counter(name for path in MODULES for name in set(names_of(path)))
    assert {name for name, count in homes.items() if count >= 3} - {"__init__.py"} == set(SHARED)
