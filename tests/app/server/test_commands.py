"""The commands that answer in the terminal say what the core says."""

import json
import os
import re
import subprocess
import sys

import pytest
from codim2_app.picture.frame.dask_executor import ClusterError
from codim2_app.server.cli import main

import codim2_core as c2
from codim2_core.portrait.cycles.proof.check import check


def test_classify_in_words_and_as_json(capsys):
    assert main(["classify", "-a", "-2", "-d", "-1", "--f1", "-0.5"]) == 0
    said = capsys.readouterr().out
    system = c2.ELinear(-2, 0, -1, (-0.5, 0))
    assert said.startswith(c2.classify(system, c2.psi.constant()).sentence)
    assert said.count("λ_ρ") == 4
    of_paper = ["-a", "172", "-b", "186", "-d", "-200", "--f1", "-86", "--f2", "-93", "--psi", "hill:3"]
    assert main(["classify", *of_paper, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["case"], found["name"]) == ("III", "CM4")
    (C,) = found["critical_sets"]
    assert C["e"] == pytest.approx([0.5, 0.0])
    assert C["trace"] == pytest.approx(-71 + 32.25 * 3)
    assert C["kind"] == "unstable focus"
    assert len(found["limit_directions"]) == 4


def test_classify_takes_a_preset_or_equations(capsys):
    assert main(["classify", "case3-n2"]) == 0
    preset = c2.presets["case3-n2"]
    assert capsys.readouterr().out.startswith(c2.classify(preset.system, preset.psi).sentence)
    assert main(["classify", "-U", "-c + ln(2)*pull; -s", "pull=0.3"]) == 0
    assert "C: e = (0.207944, 0), stable node" in capsys.readouterr().out
    done = subprocess.run(
        [sys.executable, "-m", "codim2_app", "classify", "case1-cm4"], capture_output=True, text=True, check=True
    )
    assert "CM4" in done.stdout


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-U", "-2k*c; -s"], "The parameter 'k' has no value; give one, such as k=0.5."),
        (["-U", "-2k c; -s", "k=1"], "Write k*c for a product."),
        (["-U", "-c + asin(s); -s"], "Write atan(u/sqrt(1 - u^2)) for asin(u)."),
        (["-a", "-1"], "Only one of -a and -d is given"),
    ],
)
def test_what_is_missing_or_called_otherwise_is_named(words, said, capsys):
    assert main(["classify", *words]) == 2
    assert said in capsys.readouterr().err


def test_a_census_of_ten_thousand_million_is_allowed_and_its_file_is_tried_first(capsys, tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(c2, "census", lambda *given, **named: asked.append(given) or (_ for _ in ()).throw(ValueError))
    assert main(["census", "--count", "1e10", "--csv", str(tmp_path / "no" / "x.csv")]) == 2
    assert "cannot be written" in capsys.readouterr().err
    assert not asked


@pytest.mark.parametrize("wrong", [["--psi", "hill:many"], ["--psi", "s +"], ["--f1", "nan"]])
def test_what_cannot_be_used_is_said_in_one_line(wrong, capsys):
    assert main(["classify", "-a", "-2", "-d", "-1", *wrong]) == 2
    told = capsys.readouterr().err
    assert told.startswith("codim2: ")
    assert "Traceback" not in told


def test_prove_says_what_is_proved_and_writes_the_certificate(capsys, tmp_path):
    path = tmp_path / "certificate.json"
    assert main(f"prove -a 1 -b 3 -d -2 --f1 0.4 --f2 0.1 -o {path}".split()) == 0
    said = capsys.readouterr().out
    assert said.startswith("Limit cycles: 0. It is proved that there are no other limit cycles")
    assert f"check.py < {path}" in said
    assert check(json.loads(path.read_text()))["limit cycles"] == 0
    of_paper = ["-a", "172", "-b", "186", "-d", "-200", "--f1", "-86", "--f2", "-93"]
    assert main(["prove", *of_paper, "--psi", "1/(1+s)**2"]) == 1
    assert "The count is not proved" in capsys.readouterr().out


@pytest.mark.parametrize("words", ["-a -.5 -d -1e-3", "-a=-1/2 -d −0,001", "-a -5e-1 -d=-0.001"])
def test_numbers_are_read_as_on_the_page(words, capsys):
    assert main(["classify", *words.split()]) == 0
    assert "tr J = −0.501" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        main(["classify", "-a", "1/0", "-d", "1"])
    assert "give a number such as" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["nonunique-sliding"],
            "Limit directions: 8, proved\nCritical sets: stable node, saddle, stable node; proved\n",
        ),
        (["-U", "s; c/2 - 5*c**3 - k*s", "k=.3"], "Critical sets: stable focus, saddle, stable focus; proved\n"),
        (["saddle-node-at"], "Limit directions: not proved\nCritical sets: stable focus; proved\n"),
    ],
)
def test_prove_takes_presets_and_typed_equations(words, said, capsys):
    assert main(["prove", *words]) == 0
    assert capsys.readouterr().out.endswith(said)
    assert main(["prove", "no-such-preset"]) == 2


def test_a_theorem_leaves_no_certificate_to_write(capsys, tmp_path):
    path = tmp_path / "certificate.json"
    words = "prove -a -1 -b 3 -d -1.5 --f1 .3 --f2 .1 --psi 1/(1+s)**2 -o"
    assert main([*words.split(), str(path)]) == 1
    assert str(path) in capsys.readouterr().err
    assert not path.exists()


def test_files_are_there_before_a_pipe_is_closed(tmp_path):
    words = ["census", "--count", "3000", "--csv", str(tmp_path / "t.csv")]
    reading, writing = os.pipe()
    os.close(reading)
    said = subprocess.run(
        [sys.executable, "-m", "codim2_app.server.cli", *words],
        stdout=writing, stderr=subprocess.PIPE, env=os.environ | {"PYTHONIOENCODING": "cp1252"},
    )  # fmt: skip
    os.close(writing)
    assert (said.stderr, said.returncode) == (b"", 0)
    assert len((tmp_path / "t.csv").read_text().splitlines()) > 10


def test_presets_are_listed(capsys):
    assert main(["presets"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == list(c2.presets)
    assert main(["presets", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == list(c2.presets)


def test_census_prints_its_table(capsys, tmp_path):
    assert main(["census", "--count", "1e4", "--csv", str(tmp_path / "t.csv")]) == 0
    lines = capsys.readouterr().out.strip("\r").splitlines()[1:]
    expected = c2.census(count=10_000).table
    assert [(" ".join(line.split()[:2]), int(line.split()[2])) for line in lines] == [
        (r.name, r.count) for r in expected
    ]
    assert (tmp_path / "t.csv").read_text().count("\n") == len(expected) + 1
    assert main(["census", "--count", "0"]) == 2
    capsys.readouterr()
    assert main(["census", "--count", "30", "--draw", "quadratic"]) == 0
    told = capsys.readouterr().out
    for row in c2.census("quadratic", count=30).table:
        assert re.search(rf"^{row.name} +{row.count} ", told, re.MULTILINE)


def test_a_census_of_outcomes_is_kept_and_goes_on(capsys, tmp_path):
    kept = tmp_path / "kept.json"
    told = []
    for count in ("210", "250"):
        assert main(["census", "--count", count, "--outcomes", "--psi", "hill:2", "--resume", str(kept)]) == 0
        told.append(capsys.readouterr().out)
    for row in c2.census(count=250, psi=c2.psi.hill(2), outcomes=True).table:
        assert re.search(rf"^{row.name} +{row.count} ", told[1], re.MULTILINE)
    assert main(["census", "--count", "250", "--resume", str(kept)]) == 2
    assert "another draw" in capsys.readouterr().err


def test_a_census_is_stopped_by_its_key(capsys, tmp_path, monkeypatch):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(c2, "census", stopped, raising=False)
    assert main(["census", "--resume", str(tmp_path / "kept.json")]) == 130
    assert "kept.json keeps what is counted" in capsys.readouterr().err


def test_a_census_on_a_cluster_that_is_not_there(capsys, monkeypatch):
    assert main(["census", "--dask", "tcp://127.0.0.1:9", "--processes", "2"]) == 2
    assert "no --processes" in capsys.readouterr().err

    def missing(_):
        raise ClusterError("no Dask scheduler answers at tcp://127.0.0.1:9.")

    monkeypatch.setattr("codim2_app.server.commands.count.dask_executor", missing)
    assert main(["census", "--dask", "tcp://127.0.0.1:9"]) == 2
    assert "no Dask scheduler answers" in capsys.readouterr().err


def test_notebooks_are_copied_and_what_is_there_is_kept(capsys, tmp_path):
    folder = tmp_path / "my notebooks"
    assert main(["notebooks", str(folder)]) == 0
    assert f"jupyter lab '{folder}'" in capsys.readouterr().out
    copied = sorted(file.name for file in folder.iterdir())
    assert copied == ["first-steps.ipynb", "the-paper-in-figures.ipynb", "your-own-system.ipynb"]
    (folder / copied[0]).write_text("mine")
    assert main(["notebooks", str(folder)]) == 0
    assert "kept" in capsys.readouterr().out
    assert (folder / copied[0]).read_text() == "mine"
    (tmp_path / "file").touch()
    assert main(["notebooks", str(tmp_path / "file")]) == 1
    assert "cannot be written" in capsys.readouterr().err
