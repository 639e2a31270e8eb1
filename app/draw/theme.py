"""Colours and line widths of the picture, light and dark, shared by Bokeh, SVG, HoloViews and the legend.

Nullclines have the paper's colours (matlab1 to matlab4 of fig:sim_5cases); the dark theme lightens them.
"""

from __future__ import annotations

LIGHT = {
    "page": "#ffffff",
    "ink": "#1c2430",
    "orbit": "#1c2430",
    "outside": "#5b6675",
    "continuation": "#b3123f",
    "separatrix": "#6d28d9",
    "cycle": "#e0121f",
    "rho": "#0072BD",
    "theta": "#D95319",
    "lines_inside": "#EDB120",
    "lines_outside": "#7E2F8E",
    "equator": "#1c2430",
    "attracting": "#15803d",
    "repelling": "#be185d",
    "degenerate": "#6b7280",
    "critical": "#c8102e",
    "hollow": "#ffffff",
    "shade": "#3b6ea5",
    "shade_alpha": 0.022,
    "slide": "#0d9488",
    "cross": "#e8751a",
    "depends": "#7c3aed",
    "undecided": "#64748b",
    "misses": "#dfe4ea",
    "motion": "#c026d3",
    "basins": ["#0d9488", "#7c3aed", "#0284c7", "#a16207"],
}
DARK = {
    "page": "#12161d",
    "ink": "#e6eaf0",
    "orbit": "#d6dce5",
    "outside": "#8d99aa",
    "continuation": "#ff6b8f",
    "separatrix": "#b794ff",
    "cycle": "#ff3b47",
    "rho": "#4aa8e8",
    "theta": "#ff8552",
    "lines_inside": "#f2c14e",
    "lines_outside": "#c58ad6",
    "equator": "#e6eaf0",
    "attracting": "#4ade80",
    "repelling": "#f472b6",
    "degenerate": "#aab2bf",
    "critical": "#ff5468",
    "hollow": "#12161d",
    "shade": "#7fb2ff",
    "shade_alpha": 0.028,
    "slide": "#2dd4bf",
    "cross": "#fb923c",
    "depends": "#a78bfa",
    "undecided": "#94a3b8",
    "misses": "#2c3440",
    "motion": "#f0abfc",
    "basins": ["#2dd4bf", "#a78bfa", "#38bdf8", "#facc15"],
}
THEMES = {"light": LIGHT, "dark": DARK}

#: Half the width of the picture: the disc has radius 1.
VIEW = 1.75
#: Radius up to which the scene is computed: the corners of the square picture.
REACH = 2.45

#: Radii of the translucent discs that shade the hemisphere; there are more near the centre, so the limb is pale.
DISCS = (*(0.06 * k + 0.04 for k in range(16)), 1.0)

#: The ring of approach outcomes: its radii, and the pattern over each colour, so that colour is not all there is.
RING = (1.03, 1.075)
HATCHES = {"slide": " ", "cross": "/", "depends": "x", "undecided": ".", "misses": " "}

#: Polyline layers from bottom to top: name, colour key, width in px.
LINES = (
    ("lines_outside", "lines_outside", 1.4),
    ("lines_inside", "lines_inside", 1.8),
    ("rho_outside", "rho", 1.8),
    ("rho_inside", "rho", 1.8),
    ("theta_outside", "theta", 1.8),
    ("theta_inside", "theta", 1.8),
    ("outside", "outside", 0.9),
    ("inside", "orbit", 0.9),
    ("continuations", "continuation", 1.6),
    ("separatrices_stable", "separatrix", 2.0),
    ("separatrices_unstable", "separatrix", 2.0),
    ("cycles", "cycle", 2.8),
    ("limit", "motion", 1.6),
    ("motion", "motion", 2.4),
)
#: Layers that carry arrowheads.
ARROWED = ("outside", "inside", "continuations", "separatrices_stable", "separatrices_unstable", "cycles")
#: Layers drawn in dashes: stable and unstable separatrices, a motion and its limit differ by more than colour.
DASHED = {"separatrices_stable": (7, 4), "limit": (5, 4)}
