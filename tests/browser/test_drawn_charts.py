"""What each panel's chart draws, against the core's numbers, at two settings without any symmetry.

A chart that is upside down, or has its axes, colours, branches or columns swapped, is told apart from the right one.
"""

import numpy as np
import pytest

import codim2_core as c2

from .asymmetric import PSI, at, equator, size, system
from .drawn import SCRIPTS, colour, numbers, plots, table


def test_planes(opened, setting):
    page = opened("planes")
    sets = at(setting)
    assert sets
    (plane,) = plots(page, ".trace-plane")
    dots = plane.dots("now")
    assert len(dots) == len(sets)
    for (place, drawn), C in zip(dots, sets, strict=True):
        np.testing.assert_allclose(place, [C.trace, C.determinant], rtol=0.0, atol=max(plane.near))
        assert drawn["stroke"] == colour(page, "crit")
        assert (drawn["fill"] == colour(page, "crit")) == C.kind.startswith("stable")
    ((parabola, _),) = plane.lines("parabola")
    np.testing.assert_allclose(parabola[:, 1], parabola[:, 0] ** 2 / 4, rtol=0.0, atol=3 * max(plane.near))
    (area,) = [plane.line(it) for it in plane.raw["areas"]]
    assert area[:, 0].max() == pytest.approx(0, abs=plane.near[0])
    assert area[:, 1].min() == pytest.approx(0, abs=plane.near[1])
    (values,) = plots(page, ".eigen-plane")
    drawn = np.array([place for place, _ in values.dots("now")])
    wanted = np.array([[v.real, v.imag] for C in sets for v in C.eigenvalues])
    order = lambda v: v[np.lexsort(v.round(3).T)]
    np.testing.assert_allclose(order(drawn), order(wanted), rtol=0.0, atol=max(values.near))


@pytest.mark.parametrize("along", ["f1", "d"])
def test_diagram(opened, setting, along):
    page = opened("diagram", along=along)
    angles, radii = plots(page, ".diagram")[:2]
    assert angles.title == "limit directions θ"
    assert radii.word == {"f1": "f₁", "d": "d"}[along]
    seen = {"attracting": 0, "repelling": 0}
    for name in seen:
        for points, drawn in angles.lines("branch", name):
            assert drawn["stroke"] == colour(page, "attr" if name == "attracting" else "rep")
            for value, theta in points[:: max(1, len(points) // 7)][1:-1]:
                if not 0.1 < theta < 2 * np.pi - 0.1:
                    continue
                q, *beside = (equator(setting, **{along: value + k * angles.near[0]}) for k in (0, -2, 2))
                if any(len(one) != len(q) or (one.lambda_rho * q.lambda_rho < 0).any() for one in beside):
                    continue  # a special value is as near as the chart tells values apart
                gap = np.abs(np.angle(np.exp(1j * (q.theta - theta))))
                near = int(gap.argmin())
                assert gap[near] < 0.06
                if np.sort(gap)[1:2] > 0.2:  # clear of a saddle-node
                    assert (q.lambda_rho[near] < 0) == (name == "attracting")
                    assert (q.lambda_theta[near] > 0) == drawn["dashed"]
                    seen[name] += 1
    assert seen["attracting"] + seen["repelling"] >= 4
    checked = 0
    for points, drawn in radii.lines("critical"):
        for value, radius in points[:: max(1, len(points) // 7)][1:-1]:
            sets = at(setting, **{along: value})
            if not sets:
                continue
            sizes = np.array([size(C) for C in sets])
            near = int(np.abs(sizes - radius).argmin())
            assert sizes[near] == pytest.approx(radius, abs=4 * radii.near[1] + 0.01)
            if abs(sets[near].trace) > 0.2 and abs(sets[near].determinant) > 0.2:
                assert sets[near].kind.split()[0] in drawn["name"].split()
            checked += 1
    assert checked >= 3
    line = page.find(".diagram .value").get_attribute("d")
    assert radii.x(numbers(line.split("V")[0])[0]) == pytest.approx(setting[along], abs=radii.near[0])


def test_along_z(opened, setting):
    page = opened("along")
    (plot,) = plots(page, "svg.along")
    assert plot.title == "slow flow z′"
    checked = 0
    for points, drawn in plot.lines("branch"):
        for z, flow in points[:: max(1, len(points) // 8)][1:-1]:
            sets = at(setting, z=z)
            if not sets:
                continue
            flows = np.array([C.slow_flow[0] for C in sets])
            near = int(np.abs(flows - flow).argmin())
            assert flows[near] == pytest.approx(flow, abs=4 * plot.near[1] + 0.01)
            if abs(sets[near].trace) > 0.1 and abs(sets[near].determinant) > 0.1:
                assert ("stable" in drawn["name"].split()) == sets[near].kind.startswith("stable")
            checked += 1
    assert checked >= 3
    for (z, flow), way in plot.arrows():
        assert np.sign(way[0]) == np.sign(flow), z
    kinds = {"sliding", "crossing", "unstable"}
    for low, high, kind in plot.bands():
        assert kind in kinds
        if high - low < 0.1:
            continue
        sets = at(setting, z=(low + high) / 2)
        assert (kind == "crossing") == (not sets)
        if sets:
            assert (kind == "sliding") == any(C.kind.startswith("stable") for C in sets)
    rest = [place for place, mark in plot.marks() if "rest" in mark["kind"]]
    for z, _ in rest:
        flows = [C.slow_flow[0] for C in at(setting, z=z)]
        assert min(map(abs, flows)) < 0.05


def test_psi(opened):
    page = opened("psi", log_eps=-0.5)
    above, below = plots(page, ".psi-curves")
    ((curve, drawn),) = above.lines("series-line")
    np.testing.assert_allclose(curve[:, 1], PSI(np.clip(curve[:, 0], 0, None)), rtol=0.0, atol=2 * above.near[1])
    for points, drawn in below.lines("series-line"):
        eps = {"s3": 1.0, "s1": 0.3, "s0": 0.1, "present": 10**-0.5, "limit": 1e-9}[drawn["name"].split()[-1]]
        x = np.where(np.abs(points[:, 0]) < 2 * below.near[0], 0, points[:, 0])
        there = (x != 0) | (eps > 1e-3)  # the limit jumps at 0
        np.testing.assert_allclose(points[there, 1], np.sign(x[there]) * PSI.modulus(np.abs(x[there]) / eps), atol=0.03)


@pytest.mark.parametrize("across", ["f1", "a"])
def test_atlas(opened, setting, across):
    page = opened("atlas", across=across, up="f2")
    page.page.wait_for_selector(".pad:not(.old) .region")
    (plot,) = plots(page, ".pad")
    assert (plot.title, plot.word) == ("f₂", {"f1": "f₁"}.get(across, across))
    pixels = [(x, y) for x in np.linspace(60, 300, 9) for y in np.linspace(50, 270, 8)]
    agreeing = 0
    for pixel, names in zip(pixels, page.find(".pad").evaluate(SCRIPTS["regions"], pixels), strict=True):
        at_x, f2 = plot.data(pixel)[0]
        name = c2.classify(system(setting, **{across: at_x}, f2=f2), PSI, (0.0,)).name
        agreeing += bool(names) and names[0].split(",")[0] == name
    assert agreeing > 0.93 * len(pixels)
    handle = page.find(".pad .handle").evaluate("(it) => [it.cx.baseVal.value, it.cy.baseVal.value]")
    here = [setting[across], setting["f2"]]
    np.testing.assert_allclose(plot.data(handle)[0], here, rtol=0.0, atol=max(plot.near))
    if across == "f1":
        matrix = np.array([[setting["a"], -setting["b"]], [setting["b"], setting["d"]]])
        curve = np.concatenate([points for points, _ in plot.lines("transcritical")])
        np.testing.assert_allclose(np.hypot(*np.linalg.solve(matrix, curve.T)), 1.0, atol=0.03)


def test_numbers(opened, setting):
    page = opened("numbers")
    q = equator(setting)
    rows = table(page, ".equator-table")
    assert rows[0] == ["", "θ", "λρ", "λθ"]
    for i, row in enumerate(row for row in rows[1:] if row[0]):
        wanted = [q.theta[i], q.lambda_rho[i], q.lambda_theta[i]]
        np.testing.assert_allclose([numbers(cell)[0] for cell in row[1:]], wanted, rtol=2e-3, atol=6e-4)
    (C, *_) = at(setting)
    rows = {row[0]: row[1] for row in table(page, ".critical-table")}
    for name, wanted in [("(c, s)", C.e), ("(x₂, y₂)", C.x2), ("tr J", [C.trace]), ("det J", [C.determinant])]:
        np.testing.assert_allclose(numbers(rows[name]), wanted, rtol=2e-3, atol=1e-3)
    rate = C.slow_flow[0]
    assert numbers(page.find(".slow b").text_content().replace("z′", ""))[0] == pytest.approx(rate, rel=2e-3, abs=6e-4)
    assert ("increases" if rate > 0 else "decreases") in page.find(".slow").text_content()
    start, tip = (numbers(part)[-1] for part in page.find(".slow .z-arrow").get_attribute("d").split("V"))
    assert (tip < start) == (rate > 0)  # z points up, pixels run down
