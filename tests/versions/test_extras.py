"""Each extra alone, in an environment of exactly its packages: its command runs."""

import subprocess

import pytest

from .test_versions import PROJECT, pip, source

DASK = """
from codim2_app.picture.frame.dask_executor import dask_executor
try:
    dask_executor("tcp://127.0.0.1:9")
except Exception as error:
    assert "no Dask scheduler answers" in str(error), error
"""
RUN = {
    "notebook": ["python", "-c", "from codim2_app import explorer; explorer('case1-cm0')._repr_mimebundle_()"],
    "plot": ["python", "-c", "import codim2_core as c2; c2.Scene('case1-cm4').plot(__import__('pylab').gca())"],
    "symbolic": ["python", "-c", "import codim2_core as c2; print(c2.ELinear(-1, 0, -1).to_sympy())"],
    "figures": ["codim2", "figure", "case1-cm4", "-o", "it.png"],
    "dask": ["python", "-c", DASK],
}


def test_every_extra_has_a_command():
    assert RUN.keys() == PROJECT["optional-dependencies"].keys() - {"test", "bench"}


@pytest.mark.parametrize("extra", RUN)
def test_its_command_runs(extra, tmp_path):
    wanted = f"{source(tmp_path / 'source')}[{extra}]"
    python = pip(tmp_path / "env", "install", wanted)
    command = [str(python.parent / RUN[extra][0]), *RUN[extra][1:]]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
