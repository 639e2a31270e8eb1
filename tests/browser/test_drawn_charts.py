"""What each panel's chart draws, against the core's numbers, at two settings without any symmetry.

A chart that is upside down, or has its axes, colours, branches or columns swapped, is told apart from the right one.
"""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches

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


def test_names_of_the_trace_plane_stand_in_their_regions(opened):
    page = opened("planes")
    (plane,) = plots(page, ".trace-plane")
    names = [word for word in page.find(".trace-plane").evaluate(SCRIPTS["words"]) if word[1] == "region-name"]
    assert len(names) >= 3
    for text, _, x, y in names:
        trace, determinant = plane.data([x, y - 4])[0]
        focus = trace**2 < 4 * determinant
        kind = f"{'stable' if trace < 0 else 'unstable'} {'focus' if focus else 'node'}"
        assert text == ("saddle" if determinant < 0 else kind)


def test_table_of_the_planes(opened, setting):
    page = opened("planes")
    psis = {"Ψ = 1": c2.psi.constant(), "exp(−s)": c2.psi.exponential()}
    rows = {row[0]: row for row in table(page, ".plane-table")[1:]}
    (plane,) = plots(page, ".trace-plane")
    assert table(page, ".plane-table")[0] == ["", "tr J", "det J", ""]
    found = 0
    for words, psi in psis.items():
        row = next((row for text, row in rows.items() if words.split(" = ")[-1] in text), None)
        sets = c2.critical_sets(system(setting), psi, (0.0,))
        if row is None or not sets:
            continue
        found += 1
        wanted = [sets[0].trace, sets[0].determinant]
        np.testing.assert_allclose(numbers(row[1]) + numbers(row[2]), wanted, rtol=1e-3, atol=6e-4)
        assert row[3] == sets[0].kind
        spots = np.array([place for place, _ in plane.dots("over-mark")])
        away = np.abs(spots - [sets[0].trace, sets[0].determinant]) / plane.near
        assert away.max(axis=1).min() < 2
    assert found


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


def test_special_points_of_the_diagram(opened, setting):
    page = opened("diagram", along="f1")
    drawn = [mark for plot in plots(page, ".diagram") for mark in plot.marks()]
    flat = c2.ELinear(setting["a"], setting["b"], setting["d"], (setting["f1"], setting["f2"]))
    found = equilibrium_branches(flat, PSI, "f1", (-3.0, 3.0), ()).special
    assert sum(len(mark["words"].splitlines()) for _, mark in drawn) == len(found) > 3
    near = plots(page, ".diagram")[-1].near[0]
    for one in found:
        marks = [place for place, mark in drawn if f"{one.kind} at " in mark["words"]]
        assert min(abs(place[0] - one.value) for place in marks) < 30 * near  # a group stands amid its members


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


def test_slow_flow_in_the_plane_of_two_slow_variables(open_page):
    page = open_page(viewport={"width": 1440, "height": 900}).open("?system=ball_in_pool&panel=along")
    page.settle()
    (plot,) = plots(page, ".slow-plane")
    arrows = plot.arrows()
    assert len(arrows) > 20
    ball = c2.examples.ball_in_pool()
    for place, way in arrows[::5]:
        (C, *_) = c2.critical_sets(ball, c2.psi.constant(), tuple(place))
        flow = np.array(C.slow_flow[:2])
        assert way @ flow / np.hypot(*flow) > 0.99


@pytest.mark.slow
def test_a_typed_start_over_time(opened, setting):
    page = opened("orbits", launch="0.6, 0.8, 0.3", t_end=3.0, log_eps=-1.0, orbit_eps="show")
    page.page.wait_for_selector(".phases li")
    run = c2.simulate(system(setting), PSI, (0.6, 0.8, 0.3), (0.0, 3.0), eps=0.1)
    limit = c2.simulate_nonsmooth(system(setting), (0.6, 0.8, 0.3), (0.0, 3.0), psi=PSI)
    plane, _, radius, slow = plots(page, ".orbit-time .series")
    assert (plane.title, radius.title, slow.title, slow.word) == ("x y", "r = |p|, outside 1 + ρ", "z", "t")
    for plot, column, name, token in [(plane, 0, "s0", "rho"), (plane, 1, "s1", "theta"), (slow, 2, "s0", "rho")]:
        found = plot.lines(name)
        assert sorted("broken" in it["name"] for _, it in found) == [False, True]
        for points, drawn in found:
            motion = run if "broken" in drawn["name"] else limit
            assert drawn["stroke"] == colour(page, token)
            wanted = np.array([motion.dense(t)[column] for t in np.clip(points[:, 0], 0, motion.times[-1])])
            np.testing.assert_allclose(points[:, 1], wanted, atol=6 * plot.near[1] + 0.01)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [(0.45, -0.3), (-1.2, 0.7)])
def test_an_orbit_over_time(opened, setting, seed):
    x, y = seed
    page = opened("orbits", orbits=f"{x},{y}", orbit_eps="show", log_eps=-2.5)
    page.page.wait_for_selector(".phases li")
    eps, r = 10.0**-2.5, np.hypot(x, y)
    unit = eps if r < 1.0 else 1.0
    state = unit * np.array(seed) * (1.0 / np.sqrt(1.0 - r * r) if r < 1.0 else (r - 1.0) / r)
    plane, angle, radius, slow = plots(page, ".orbit-time .series")
    assert (plane.title, slow.word) == (("x/ε y/ε", "t/ε") if r < 1.0 else ("x y", "t"))
    (broken,) = [points for points, _ in slow.lines("broken")]
    motion = c2.simulate(system(setting), PSI, (*state, 0.0), (0.0, unit * broken[-1, 0]), eps=eps)

    def states(t):
        return np.array([motion.dense(v)[:2] / unit for v in np.clip(unit * t, 0.0, motion.times[-1])])

    for name, token, column in [("s0", "rho", 0), ("s1", "theta", 1)]:
        for points, drawn in plane.lines(name):
            assert drawn["stroke"] == colour(page, token)
            if "broken" in drawn["name"]:
                np.testing.assert_allclose(points[:, 1], states(points[:, 0])[:, column], atol=4 * plane.near[1] + 0.01)
    # the orbit itself: x = r cos theta, y = r sin theta, with the radius of the third plot
    full = {
        name: next(points for points, it in plane.lines(name) if "broken" not in it["name"]) for name in ("s0", "s1")
    }
    theta = next(points for points, it in angle.lines("s2") if "broken" not in it["name"])
    size = next(points for points, it in radius.lines("s3") if "broken" not in it["name"])
    length = np.hypot(full["s0"][:, 1], full["s1"][:, 1])
    p = length / np.hypot(1.0, length) if r < 1.0 else length
    np.testing.assert_allclose(size[:, 1], p, atol=3 * radius.near[1] + 0.01)
    far = length > 20 * plane.near[1]
    turn = theta[:, 1] - np.arctan2(full["s1"][:, 1], full["s0"][:, 1])
    assert np.abs(np.exp(1j * turn[far]) - 1.0).max() < 0.15
    at = np.abs(full["s0"][:, 0]).argmin()
    assert (full["s0"][at, 1], full["s1"][at, 1]) == pytest.approx(state / unit, abs=6 * plane.near[1])
    page.find(".orbit-time .series").press("ArrowRight")
    assert " = 0:" not in page.find(".orbit-now").text_content()
    assert page.complaints == []


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
