"""What the README says works as printed."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()


def test_the_core_in_use_runs(capsys):
    first, second = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    exec(compile(first, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert printed.startswith("Case I, CM4.")
    assert "stable node" in printed
    exec(compile(second, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert printed.startswith("['stable node', 'saddle', 'stable node']")
    assert "Q2 slide C3" in printed
    assert "\nslip 0.0" in printed
    assert "\nslide 0.857" in printed


def test_ci_runs_the_test_command_of_the_readme():
    commands = re.findall(r"```sh\n(.*?)\n```", README, re.DOTALL)
    assert len(commands) == 2
    assert commands[1].split(" && ")[1] in (ROOT / ".ci" / "run").read_text()


def test_pictures_are_in_the_repository():
    for path in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", README):
        assert (ROOT / path).is_file(), path
