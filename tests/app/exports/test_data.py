"""What is taken away as data and code is what the core computed, to the last bit."""

import csv
import io
import json
import zipfile

import numpy as np
import pandas as pd
import pytest
from codim2_app import tables as data_frames
from codim2_app.exports.files import csv_zip, json_text, npz, snippet
from codim2_app.exports.tables import tables
from codim2_app.exports.view import View, view_of

import codim2_core as c2

ALL = (
    "outside,inside,continuations,separatrices,cycles,rho,theta,lines,conics,launched,equator,critical,outcomes,basins"
)
VIEWS = {
    "first": "v=1",
    "case3": f"preset=case3-n3&layers={ALL}&orbits=0.3,0.2;1.2,-0.4",
    "zoomed": "a=-2&b=0.35&d=-1&f1=-0.4&f2=0.25&psi=rational&seen=-0.5,0.7,-0.3,0.9&trajectories=20",
    "typed Psi": "psi=custom&psi_text=1/(1%2Bs)**2&z=0.25",
    "e-linear text": "system=typed&z=0.5",
    "own": "system=own&z=0.3",
    "example": "system=ball_in_pool&parameters=%7B%22mu%22:0.3%7D",
    "no critical set": "preset=case1-ncm2",
    "two slow variables": "preset=ball-dynamic",
}


@pytest.mark.parametrize("name", VIEWS)
def test_the_code_rebuilds_the_scene_exactly(name):
    view = view_of(VIEWS[name])
    made = {}
    exec(snippet(view), made)
    scene = view.scene()
    assert made["system"] == scene.system
    assert made["psi"] == scene.psi
    assert made["drawn"].keys() >= {"inside", "equator"}
    again, first = tables(made["scene"], view.values["layers"]), tables(scene, view.values["layers"])
    assert again.keys() == first.keys()
    for key, table in first.items():
        for column, values in table.data.items():
            assert np.array_equal(again[key].data[column], values), (key, column)


def test_the_code_of_a_system_from_python():
    for system in (
        c2.ELinear.from_matrix([[1.0, 0.5], [0.25, -1.0]], f=("0.1*z + k", 0.2), B=((1, 2),), parameters={"k": 0.3}),
        c2.System(U=("-c + k", "-s*chi"), W=("c", "s"), parameters={"k": 0.3}, definitions={"chi": "1 + z2**2"}),
    ):
        made = {}
        exec(snippet(View(view_of("v=1").values, system=system)), made)
        assert made["scene"].coefficients.U((0.6, 0.8)).tolist() == system.at((0.0,) * system.m).U((0.6, 0.8)).tolist()


def test_code_that_cannot_be_is_told():
    with pytest.raises(ValueError, match="frozen at one z"):
        snippet(View(view_of("v=1").values, system=c2.ELinear(-1, 0, -2).at(())))


def _same(one, other):
    """pandas reads the last bit of a number otherwise than Python does."""
    return np.array_equal(one, other) if other.dtype.kind in "iU" else np.allclose(one, other, rtol=1e-15, atol=0)


@pytest.mark.parametrize("name", ["case3", "own"])
def test_csv_json_and_npz_hold_the_same_numbers(name):
    view = view_of(VIEWS[name])
    whole = tables(view.scene(), view.values["layers"])
    files = zipfile.ZipFile(io.BytesIO(csv_zip(view)))
    assert {file.filename for file in files.infolist()} == {"README.txt", *(f"{key}.csv" for key in whole)}
    read = json.loads(json_text(view))
    arrays = np.load(io.BytesIO(npz(view)))
    for key, table in whole.items():
        frame = pd.read_csv(files.open(f"{key}.csv"), comment="#", keep_default_na=False)
        for column, values in table.data.items():
            assert _same(frame[column].to_numpy(), values), (key, column)
            assert np.array_equal(read["tables"][key]["data"][column], values)
            assert np.array_equal(arrays[f"{key}.{column}"], values)
            unit, meaning = table.columns[column]
            assert f"# {column} [{unit}]: {meaning}" in files.read(f"{key}.csv").decode()
            assert read["tables"][key]["columns"][column] == {"unit": unit, "meaning": meaning}


def test_they_say_what_they_are_data_of():
    view = view_of(VIEWS["case3"])
    files = zipfile.ZipFile(io.BytesIO(csv_zip(view)))
    told = [files.read(name).decode() for name in ("README.txt", "inside.csv")]
    told += [str(np.load(io.BytesIO(npz(view)))["about"])]
    told += [json.dumps(json.loads(json_text(view))["about"], ensure_ascii=False)]
    for text in told:
        assert "a = 172" in text
        assert "Ψ(s) = 3/(3 + (4s)ⁿ), n = 3" in text
        assert f"codim2 {c2.__version__}" in text
        assert view.query in text
    rows = [row for row in csv.reader(told[1].splitlines()) if not row[0].startswith("#")]
    assert rows[0] == ["curve", "px", "py"]


def test_tables_are_those_of_the_core():
    scene = view_of(VIEWS["case3"]).scene()
    found = tables(scene, ALL.split(","))
    assert found["limit_directions"].data["theta"].tolist() == scene["equator"].theta.tolist()
    (C,) = scene["critical"]
    row = {column: values[0] for column, values in found["critical_sets"].data.items()}
    assert (row["c"], row["s"], row["kind"]) == (*C.e, C.kind)
    assert [row["eigenvalue1_re"], row["eigenvalue1_im"]] == [C.eigenvalues[0].real, C.eigenvalues[0].imag]
    curves = [found["inside"].data["curve"] == i for i in range(len(scene["inside"].points))]
    assert np.array_equal(found["inside"].data["px"][curves[3]], scene["inside"].points[3][:, 0])
    basin = found["basins"]
    assert np.hypot(basin.data["px"], basin.data["py"]).max() < 1.02
    near = np.hypot(basin.data["px"] - C.p[0], basin.data["py"] - C.p[1]).argmin()
    assert basin.data["destination"][near] == "cycle 1"  # an unstable focus in a limit cycle
    assert set(basin.data["destination"]) == {"cycle 1", "Q3"}
    assert found["launched"].data["px"].tolist() == [0.3, 1.2]
    assert "launched" not in tables(scene, ["inside"])


def test_pandas_frames_of_a_scene():
    scene = c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0)))
    frames = data_frames(scene)
    assert frames["limit_directions"]["lambda_rho"].tolist() == scene["equator"].lambda_rho.tolist()
    assert frames["limit_directions"].attrs["columns"]["theta"].startswith("rad angle")
    assert "basins" not in frames


#: The unit of each number that has one. T, tau and t are three times: dT = dt/|(x, y)|, dt = eps dtau.
UNITS = {
    "theta": "rad", "lambda_rho": "1/T", "lambda_theta": "1/T", "trace": "1/τ", "determinant": "1/τ²",
    "discriminant": "1/τ²", "eigenvalue1_re": "1/τ", "eigenvalue1_im": "1/τ", "eigenvalue2_re": "1/τ",
    "eigenvalue2_im": "1/τ", "slow_flow1": "1/t", "period": "τ", "start": "rad", "end": "rad",
}  # fmt: skip
POWERS = {"": 0, "1": 0, "rad": 0, "1/T": 1, "1/τ": 1, "1/t": 1, "1/τ²": 2, "τ": -1}
PERIODIC = "preset=case3-n3&layers=equator,critical,cycles,outcomes"


def test_units_are_those_of_the_numbers():
    """Three times as fast: each number changes as its unit says."""
    view = view_of(PERIODIC)
    at, psi = view.scene().coefficients, view.scene().psi

    def of(k):
        f, B, g = (k * at.f[0], k * at.f[1]), ((0.4 * k, -0.3 * k),), (0.7 * k,)
        return tables(c2.Scene(c2.ELinear(k * at.a, k * at.b, k * at.d, f, B, g), psi, 0.0), view.values["layers"])

    slow, fast = of(1.0), of(3.0)
    assert slow.keys() == fast.keys() >= {"limit_cycles", "critical_sets", "outcomes"}
    seen = set()
    for name, table in slow.items():
        for column, (unit, _) in table.columns.items():
            if unit not in ("", "1"):
                assert unit == UNITS[column]
                seen.add(column)
            if table.data[column].dtype.kind == "f":
                expected = table.data[column] * 3.0 ** POWERS[unit]
                np.testing.assert_allclose(fast[name].data[column], expected, rtol=1e-5, atol=1e-6, err_msg=column)
    assert seen >= UNITS.keys() - {"theta", "lambda_rho", "lambda_theta"}
    (directions,) = (tables(view_of("v=1").scene())["limit_directions"].columns,)
    assert {name: unit for name, (unit, _) in directions.items() if name in UNITS} == {
        name: UNITS[name] for name in ("theta", "lambda_rho", "lambda_theta")
    }
