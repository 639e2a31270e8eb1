"""Names of controls, layers and views, each with its words."""

from __future__ import annotations

from pathlib import Path

#: Coefficients of the normal form: f(z) = f + z k, z' = B e + g.
COEFFICIENTS = ("a", "b", "d", "f1", "f2", "k1", "k2", "B1", "B2", "g0")
#: Panels next to the picture by the name of their script; `panels.registry` knows their tabs, and offers further ones.
PANEL_NAMES = tuple(sorted(path.stem for path in (Path(__file__).parents[2] / "static" / "panels").glob("*.js")))
#: What a bifurcation diagram can run along, and what the axes of the atlas can be.
SLIDER_AXES = ("a", "b", "d", "f1", "f2", "z", "z2", "z3", "z4", "n")
#: Or a parameter of the system, after this: own:mu.
OWN_AXIS = "own:"
#: Views of the panel "3-D".
SOLIDS = {"sphere": "Hemisphere", "stack": "Along z", "filippov": "Filippov"}
#: What the panel "Census" draws: what it is called, and how many systems the smallest census has; each size is 10 times
#: the one before.
CENSUSES = {"normal": ("e-linear", 10_000), "quadratic": ("quadratic in e", 50)}
MOST_CENSUS = 2
#: Controls of the slow variables z1, z2, …
SLOW_CONTROLS = ("z", "z2", "z3", "z4")
MAX_TRAJECTORIES = 160
#: What is drawn, as against how it is looked at: a portrait counts as changed once one of these is another.
SETTING = (
    "a", "b", "d", "f1", "f2", "system", "texts", "parameters", *SLOW_CONTROLS, "k1", "k2", "B1", "B2", "g0",
    "psi", "n", "psi_text",
)  # fmt: skip
