"""Which tests guard which module, and which mutants are known to change nothing that anybody can see.

Left out: modules compiled by Numba (`stepping`, `cycles.return_map`), where each mutant costs a compilation of tens
of seconds. `core/orbits/test_trajectories.py` holds them against exact solutions at every tolerance instead.
"""

from __future__ import annotations

from typing import NamedTuple

# Files, or single tests of them; quick ones first, as a mutant dies at the first failure.
TARGETS: dict[str, tuple[str, ...]] = {
    "layer_problem.equator": (
        "core/layer_problem/test_equator.py",
        "core/portrait/test_portrait_words.py",
        "core/portrait/test_classify.py",
        "precision/test_equator.py",
        "core/layer_problem/test_equator_zeros.py",
    ),
    "layer_problem.closed_equator": ("core/layer_problem/test_equator.py", "precision/test_equator.py"),
    "numerics.trigonometric": (
        "core/layer_problem/test_equator.py",
        "precision/test_equator.py",
        "core/numerics/test_trigonometric.py",
    ),
    "numerics.trigonometric_exact": ("core/layer_problem/test_equator.py", "core/numerics/test_trigonometric.py"),
    "layer_problem.critical": (
        "core/layer_problem/test_critical.py",
        "core/portrait/test_classify.py",
        "precision/test_critical.py",
        "stress/test_rounding.py",
        "core/layer_problem/test_disc_zeros.py",
    ),
    "layer_problem.linearisation": (
        "core/layer_problem/test_critical.py",
        "core/portrait/test_classify.py",
        "precision/test_critical.py",
        "core/layer_problem/test_disc_zeros.py",
    ),
    "portrait.nullclines": (
        "core/portrait/test_nullcline_pieces.py",
        "core/portrait/test_nullclines.py",
        "core/portrait/test_nullclines_typed.py",
    ),
    "layer_problem.hemisphere": (
        "core/layer_problem/test_hemisphere_values.py",
        "core/layer_problem/test_hemisphere.py",
    ),
    "sliding.flow": ("core/layer_problem/test_critical.py",),
    "portrait.classify": (
        "core/portrait/test_portrait_words.py",
        "core/portrait/test_classify.py",
        "core/portrait/test_classify_typed.py",
    ),
    "systems.elinear": ("core/systems/test_elinear.py", "core/layer_problem/test_critical.py"),
    "layer_problem.lyapunov": (
        "precision/test_bifurcations.py::test_three_derivatives_of_psi",
        "precision/test_bifurcations.py::test_first_lyapunov_coefficient",
    ),
    "psi.function": ("core/psi/test_psi.py",),
    "psi.families.constant": ("precision/test_steepness.py", "core/psi/test_psi.py"),
    "psi.families.rational": ("precision/test_steepness.py", "core/psi/test_psi.py"),
    "psi.families.exponential": ("precision/test_steepness.py", "core/psi/test_psi.py"),
    "psi.families.tanh": ("precision/test_steepness.py", "core/psi/test_psi.py"),
    "psi.families.hill": ("precision/test_steepness.py", "core/psi/test_psi.py"),
    "psi.kernel": ("precision/test_steepness.py", "core/psi/test_psi.py"),
    "bifurcations.geometry": ("core/bifurcations/test_bifurcations.py", "precision/test_bifurcations.py"),
    "bifurcations.trace": ("core/bifurcations/test_bifurcations.py", "precision/test_bifurcations.py"),
}


class Allowed(NamedTuple):
    """Mutants of the lines that contain `line`, and why they live."""

    module: str
    line: str
    why: str


_EXACT = "Only decides whether the slow exact way is gone, which gives the same answer (and more often than needed)."
_GUESS = "A first guess: the steps that follow restore all digits of it."
_UNUSED = "The value of the branch that `where` does not take."
_SLACK = "Part of a bound that is larger than it need be."
_LOOKS = "How finely a line is drawn, within what the tests allow."

ALLOWED: tuple[Allowed, ...] = (
    Allowed("layer_problem.critical", "CANCELLATION", _EXACT),
    Allowed("layer_problem.critical", "w0 = ", _EXACT),
    Allowed("layer_problem.critical", "w1, w2 = ", _EXACT),
    Allowed("layer_problem.critical", "gap, size = ", _EXACT),
    Allowed("layer_problem.linearisation", "CANCELLATION", _EXACT),
    Allowed("layer_problem.linearisation", "size = abs(a * d) + b * b", _EXACT),
    Allowed("layer_problem.linearisation", "size < 1e-280", _EXACT),
    Allowed("layer_problem.critical", "size < 1e-280", _EXACT),
    Allowed("layer_problem.critical", "+ 0.0", "Turns -0.0 into 0.0."),
    Allowed(
        "layer_problem.critical", "complement: float = 1.0", "Read only where a critical set exists, and then given."
    ),
    Allowed("layer_problem.equator", "SINGULAR = ", "A tolerance of a few roundings."),
    Allowed("layer_problem.equator", "abs(value) <= 1e-3 * size", _EXACT),
    Allowed("layer_problem.equator", "size = abs(a) + abs(d)", _EXACT),
    Allowed("layer_problem.equator", "if m > 4", "General systems only: core/layer_problem/test_equator_zeros.py."),
    Allowed(
        "layer_problem.equator",
        "reached is not None and zeros.theta",
        "U(e) = 0 at |e| = 1 is a zero of Theta: there is one.",
    ),
    Allowed("layer_problem.critical", "parts = ((n1", _SLACK),
    Allowed("layer_problem.critical", "solvable = ", _SLACK),
    Allowed("layer_problem.linearisation", "radial * (abs(a) * c * c", "A tolerance of a few roundings."),
    Allowed(
        "layer_problem.lyapunov",
        "size = (abs(",
        "Either column of a singular matrix will do; the larger is the better one.",
    ),
    Allowed(
        "layer_problem.lyapunov", "size[:, :1] >= size[:, 1:]", "Either column will do; the larger is the better one."
    ),
    Allowed("layer_problem.hemisphere", "h2 = np.maximum", _UNUSED),
    Allowed("layer_problem.hemisphere", "s = np.where(h2 > 0.0", _UNUSED),
    Allowed("layer_problem.hemisphere", "shape = np.where(h2 > 0.0", _UNUSED),
    Allowed("sliding.flow", "writeable = False", "A result that can be changed is no wrong formula."),
    Allowed("layer_problem.equator", "writeable = False", "A result that can be changed is no wrong formula."),
    Allowed("layer_problem.critical", "writeable = False", "A result that can be changed is no wrong formula."),
    Allowed("portrait.nullclines", "POINTS", _LOOKS),
    Allowed("portrait.nullclines", "PASSES", _LOOKS),
    Allowed("portrait.nullclines", "SAG", _LOOKS),
    Allowed("portrait.nullclines", "share = ", _LOOKS),
    Allowed("portrait.nullclines", "sag", _LOOKS),
    Allowed("portrait.nullclines", "1e-9 * size_l", "Within an angle of 1e-9 the two ways draw the same."),
    Allowed("portrait.nullclines", "right - left < 1e-14", "A span so short is no pixel."),
    Allowed("numerics.trigonometric", "d_r2", _SLACK),
    Allowed("numerics.trigonometric", "d_q = ", _SLACK),
    Allowed("numerics.trigonometric", "d_i = ", _SLACK),
    Allowed("numerics.trigonometric", "d_j = ", _SLACK),
    Allowed("numerics.trigonometric", "change = ", _SLACK),
    Allowed("numerics.trigonometric", "e_i, e_j = ", _SLACK),
    Allowed("numerics.trigonometric", "error = ", _SLACK),
    Allowed("numerics.trigonometric", "fast = _fast(", _SLACK),
    Allowed("numerics.trigonometric", "starts = _starts(", _EXACT),
    Allowed("numerics.trigonometric", "len(starts) not in", _EXACT),
    Allowed("numerics.trigonometric", "steep", _EXACT),
    Allowed("numerics.trigonometric", "clear", _EXACT),
    Allowed("psi.families.constant", "0.0 * lib.minimum(s, 0.0)", "Zero either way, as s >= 0."),
    Allowed("psi.families.hill", "guess", _GUESS),
    Allowed("psi.families.exponential", "Winitzki", _GUESS),
    Allowed("psi.families.exponential", "L = lib.where(", _GUESS),
    Allowed("psi.families.hill", "L = lib.where(", _GUESS),
    Allowed("psi.families.hill", "log_y = ", _GUESS),
    Allowed("psi.families.hill", "ratio", _GUESS),
    Allowed("psi.families.exponential", "for _ in range(", _GUESS),
    Allowed("psi.families.hill", "for _ in range(", _GUESS),
    Allowed("psi.families.exponential", "s = lib.maximum(L", _GUESS),
    Allowed("psi.families.exponential", "zeta = lib.where(s > 0.05", "Either side of the threshold is right there."),
    Allowed("psi.families.tanh", "lib.minimum(s, 1e9)", "exp(-2 sqrt s) is 0 long before."),
    Allowed("psi.families.exponential", "lib.minimum(zeta, 1e", "The value is saturated long before."),
    Allowed("psi.families.tanh", "lib.minimum(zeta, 1e", "The value is saturated long before."),
    Allowed("psi.families.hill", "lib.minimum(u, 1e160)", "The value is saturated long before."),
    Allowed("psi.families.hill", "5e-324", _UNUSED),
    Allowed("psi.families.tanh", "for odd in", "The far end of a continued fraction that has long converged."),
)


def explained(module: str, line: str) -> bool:
    """Whether the list above says why mutants of this line may live."""
    return any(allowed.module == module and allowed.line in line for allowed in ALLOWED)
