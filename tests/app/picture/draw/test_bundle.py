"""The front end's modules as one: in order of dependency, each with names of its own."""

import pytest
from codim2_app.picture.draw.bundle import bundle


def write(folder, **modules):
    for name, text in modules.items():
        (folder / f"{name}.js").write_text(text)
    return folder / f"{next(reversed(modules))}.js"


def test_what_is_imported_stands_before_what_imports_it_and_stands_once(tmp_path):
    entry = write(
        tmp_path,
        one="export const a = 1\n",
        two='import {a} from "./one.js"\nexport const b = a + 1\n',
        all='import {b} from "./two.js"\nimport {a} from "./one.js"\nexport default {a, b}\n',
    )
    joined = bundle(entry)
    assert [joined.count(part) for part in ("a = 1", "b = a + 1", "export default {a, b}")] == [1, 1, 1]
    assert joined.index("a = 1") < joined.index("b = a + 1") < joined.index("export default")


@pytest.mark.parametrize(
    ("modules", "words"),
    [
        ({"one": 'import {b} from "./two.js"\n', "two": 'import {a} from "./one.js"\n'}, "in a circle"),
        ({"one": "const a = 1\n", "two": 'import {a} from "./one.js"\n'}, "exports no such name"),
        ({"one": 'import {a} from "./none.js"\n'}, "does not exist"),
        ({"one": "export default 1\n", "two": 'import "./one.js"\n'}, "is not read"),
        ({"one": "export const a = 1\n", "two": 'import * as b from "./one.js"\n'}, "is not read"),
        ({"one": "export const a = 1\n", "two": 'import {a as b} from "./one.js"\n'}, "exports no such name"),
    ],
)
def test_what_cannot_be_joined_is_said(tmp_path, modules, words):
    with pytest.raises(ValueError, match=words):
        bundle(write(tmp_path, **modules))


def test_several_entries_and_folders_and_what_the_last_one_exports(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "one.js").write_text("export const a = 1\nexport function f() { return 2 }\nconst own = 3\n")
    (tmp_path / "side.js").write_text('import {f} from "./parts/one.js"\nf()\n')
    (tmp_path / "last.js").write_text('import "./side.js"\nimport {a, f} from "./parts/one.js"\nexport const b = a\n')
    joined = bundle(tmp_path / "side.js", tmp_path / "last.js")
    one, side = joined.split("const module")[1:3]
    assert one.startswith("0 = (() => {")
    assert "return {a, f}" in one
    assert side.startswith("1 = (() => {")
    assert "const {f} = module0" in side
    assert "const {a, f} = module0" in joined
    assert "const {} = module1" in joined
    assert joined.rstrip().endswith("export const b = a")
    assert joined.count("export") == 1
    with pytest.raises(ValueError, match=r"bundle imports missing\.js, which does not exist"):
        bundle(tmp_path / "missing.js")
