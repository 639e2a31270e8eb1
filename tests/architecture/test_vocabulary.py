"""Names are verbs or what they stand for, and docstrings begin as an entry of a reference does."""

import ast
from collections import Counter
from pathlib import Path

import pytest

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
#: Top-level names that three modules or more have, as of today: fewer with every change.
SHARED = 158


def tree(path):
    return ast.parse(path.read_text())


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_a_module_speaks_plainly(path):
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            said = ast.get_docstring(node)
            assert not said or said.split()[0].strip("`,:;.") not in OPENINGS, said.split("\n")[0]
    functions = [node.name for node in tree(path).body if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    assert not {name.strip("_") for name in functions} & REFUSED


def test_fewer_names_have_many_homes():
    homes = Counter()
    for path in MODULES:
        for node in tree(path).body:
            if isinstance(node, ast.Assign | ast.AnnAssign):
                bound = [
                    name.id
                    for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
                    for name in ast.walk(target)
                    if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
                ]
            else:
                bound = [node.name] if isinstance(node, ast.ClassDef | ast.FunctionDef) else []
            homes.update(set(bound))
    assert sum(count >= 3 for count in homes.values()) <= SHARED
