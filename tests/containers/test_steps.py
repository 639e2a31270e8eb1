"""The steps of the Dockerfile on this machine, each stage in a fresh environment: where no image can be built.

What is copied and run is read from the Dockerfile. Left out are the kernels, which take minutes, and
the user. Downloads are kept between the stages.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: What a stage may copy or write, from the root of its file system.
PATHS = re.compile(r"(?<![\w./])/(?=(?:build\.txt|wheels|source|srv)\b)")
LEFT_OUT = ("useradd", "codim2 warm")
#: In place of what takes minutes.
FASTER = (("--no-cache-dir", ""),)


def instructions():
    """Yield the Dockerfile's instructions: their names, and the rest of their lines."""
    text = re.sub(r"^#.*\n", "", (ROOT / "Dockerfile").read_text(encoding="utf-8"), flags=re.MULTILINE)
    for line in re.sub(r"\\\n", " ", text).splitlines():
        if line.strip():
            yield line.split(None, 1)


def copy(stage, stages, folder, words):
    """Copy as COPY does; of a folder what is in it."""
    source = ROOT
    if words[0].startswith("--from="):
        source = stages[words.pop(0).removeprefix("--from=")]
    *given, to = words
    target = stage / to.lstrip("/") if to.startswith("/") else folder / to
    for each in given:
        one = source / each.lstrip("/")
        if one.is_dir():
            shutil.copytree(one, target, dirs_exist_ok=True)
        else:
            target = target / one.name if to.endswith("/") else target
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(one, target)
            target = target.parent if to.endswith("/") else target


@pytest.fixture(scope="module")
def stages(tmp_path_factory):
    """The roots of the stages, after all their steps."""
    roots, environment = {}, {}
    for name, rest in instructions():
        if name == "FROM":
            stage = folder = tmp_path_factory.mktemp("stage")
            roots[rest.split()[-1] if " AS " in rest else "image"] = stage
            subprocess.run([sys.executable, "-m", "venv", str(stage / "python")], check=True)
            clean = {key: value for key, value in os.environ.items() if not key.startswith(("CODIM2_", "PYTHON"))}
            environment = {**clean, "PATH": f"{stage}/python/bin:{os.environ['PATH']}", "PIP_NO_COMPILE": "1"}
        elif name == "COPY":
            copy(stage, roots, folder, rest.split())
        elif name == "WORKDIR":
            folder = stage / rest.lstrip("/")
            folder.mkdir(parents=True)
        elif name == "RUN":
            steps = [step for step in rest.split("&&") if not step.strip().startswith(LEFT_OUT)]
            command = "&&".join(steps) or "true"
            for slow, fast in FASTER:
                command = command.replace(slow, fast)
            command = PATHS.sub(f"{stage}/", command)
            done = subprocess.run(["bash", "-ec", command], cwd=folder, env=environment, capture_output=True, text=True)
            assert done.returncode == 0, f"RUN {command}\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}"
    return roots


def test_the_steps_build_what_serves(stages):
    said = [subprocess.run([stages["image"] / "python/bin/codim2", *words], capture_output=True, text=True, check=True)
            for words in (["--version"], ["serve", "--help"], ["classify", "-a", "-2", "-d", "-1"])]  # fmt: skip
    assert all(one.stdout for one in said)


def test_the_image_has_no_more_than_the_explorer_needs(stages):
    (packages,) = (stages["image"] / "python/lib").glob("python3*/site-packages")
    assert not [*packages.rglob("*.map"), *packages.glob("IPython")]
