"""What the README and its pages say works as printed, and names what is there."""

import re
import shlex
from pathlib import Path

import pytest
from codim2_app.server.cli import main

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text()
TEXT = ROOT / "app" / "codim2_app" / "site" / "docs" / "text"
# changelog, hosting, ... are of the site too, where lessons and gallery are made
PAGES = (
    "README.md", "tests/benchmarks/results/benchmarks.md", "CONTRIBUTING.md",
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


@pytest.mark.parametrize("page", PAGES)
def test_pictures_and_links_are_in_the_repository(page):
    path = ROOT / page
    text = re.sub(
        r"^(`{3,}).*?^\1$|`[^`\n]+`", "", path.read_text(), flags=re.MULTILINE | re.DOTALL
    )  # code has no links
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        assert target.startswith("http") or (path.parent / target).is_file(), target
