"""What the README and its pages say works as printed, and names what is there."""

import re
import shlex
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest
from codim2_app.server.cli import main

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text()
TEXT = ROOT / "app" / "codim2_app" / "site" / "docs" / "text"
# changelog, hosting, ... are of the site too, where lessons and gallery are made
PAGES = (
    "README.md", ".readme/benchmarks.md", "CONTRIBUTING.md",
    *(f"app/codim2_app/site/docs/text/{one.name}" for one in TEXT.glob("*.md")),
)  # fmt: skip


def test_the_core_in_use_runs(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    names = {}
    exec(compile(code, "README.md", "exec"), names)
    first, *sets = capsys.readouterr().out.splitlines()
    assert "limit directions" in first
    assert [line.split(" [")[0] for line in sets] == ["stable node", "saddle", "stable node"]
    assert len(names["lines"].points) == 2
    assert len(names["scene"]["critical"]) == 3


def test_the_command_line_answers_as_printed(capsys):
    (shown,) = re.findall(r"```console\n\$ codim2 (.*?)\n(.*?)```", README, re.DOTALL)
    main(shlex.split(shown[0]))
    assert capsys.readouterr().out == shown[1]


def test_ci_runs_the_test_command_of_the_readme():
    install, test, _ = re.findall(r"```sh\n(.*?)\n```", README, re.DOTALL)
    assert install == "pip install -e . && codim2 serve"
    assert test.split(" && ")[1] in (ROOT / ".ci" / "run").read_text()


def test_the_readme_and_the_changes_are_short():
    assert len(README.split()) <= 800  # with the code
    assert len((TEXT / "changelog.md").read_text().splitlines()) <= 60


@pytest.mark.parametrize("page", PAGES)
def test_pictures_and_links_are_in_the_repository(page):
    path = ROOT / page
    text = re.sub(
        r"^(`{3,}).*?^\1$|`[^`\n]+`", "", path.read_text(), flags=re.MULTILINE | re.DOTALL
    )  # code has no links
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        assert target.startswith("http") or (path.parent / target).is_file(), target


def test_every_room_is_named_and_on_its_floor():
    text, line = CONTRIBUTING, r"(core|app|    )\s+(\w+ \| )*{}\b"
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
    for one in contracts:
        if one["type"] != "layers" or one["containers"] not in (["codim2_core"], ["codim2_app"]):
            continue
        places = []
        for floor in one["layers"]:
            if floor == "__main__":
                continue
            rooms = [line.format(room) for room in floor.split(" | ")]
            lines = [next(i for i, one in enumerate(text.splitlines()) if re.match(room, one)) for room in rooms]
            places.append(lines)
        for above, below in pairwise(places):
            assert max(above) <= min(below), (one["containers"], above, below)


def test_files_that_the_house_rules_name_exist():
    for name in re.findall(r"`((?:app|codim2_core|tests)/[\w./]+)`", CONTRIBUTING + (TEXT / "adding.md").read_text()):
        if "NAME" not in name and "ROOM" not in name:
            assert (ROOT / name).exists(), name
