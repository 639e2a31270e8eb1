"""Which tests guard which module, and which mutants are known to change nothing that anybody can see.

Left out: modules compiled by Numba (`stepping*`, `dop853`, `return_map`), where each mutant costs a compilation of tens
of seconds. `core/test_trajectories.py` holds them against exact solutions at every tolerance instead.
"""

from __future__ import annotations

from typing import NamedTuple

# Files, or single tests of them; quick ones first, as a mutant dies at the first failure.
TARGETS: dict[str, tuple[str, ...]] = {
    "equator": (
        "core/test_equator.py", "core/test_portrait_words.py", "core/test_classify.py", "precision/test_equator.py",
        "core/test_equator_general.py",
    ),
    "equator_orbit": ("core/test_equator.py", "precision/test_equator.py"),
    "trigonometric": ("core/test_equator.py", "precision/test_equator.py", "core/test_trigonometric.py"),
    "trigonometric_exact": ("core/test_equator.py", "core/test_trigonometric.py"),
    "critical": (
        "core/test_critical.py", "core/test_classify.py", "precision/test_critical.py", "stress/test_rounding.py",
        "core/test_critical_general.py",
    ),
    "critical_linearisation": (
        "core/test_critical.py", "core/test_classify.py", "precision/test_critical.py", "core/test_critical_general.py",
    ),
    "nullclines": ("core/test_nullcline_pieces.py", "core/test_nullclines.py", "core/test_nullclines_general.py"),
    "hemisphere": ("core/test_hemisphere_values.py", "core/test_hemisphere.py"),
    "sliding": ("core/test_critical.py",),
    "classify": ("core/test_portrait_words.py", "core/test_classify.py", "core/test_classify_general.py"),
    "systems": ("core/test_systems.py", "core/test_critical.py"),
    "lyapunov": (
        "precision/test_bifurcations.py::test_three_derivatives_of_psi",
        "precision/test_bifurcations.py::test_first_lyapunov_coefficient",
    ),
    "regularisation": ("core/test_regularisation.py",),
    "regularisation_families": ("precision/test_steepness.py", "core/test_regularisation.py"),
    "bifurcation_geometry": ("core/test_bifurcations.py", "precision/test_bifurcations.py"),
    "bifurcation_trace": ("core/test_bifurcations.py", "precision/test_bifurcations.py"),
}  # fmt: skip


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
    Allowed("critical", "CANCELLATION", _EXACT),
    Allowed("critical", "w0 = ", _EXACT),
    Allowed("critical", "w1, w2 = ", _EXACT),
    Allowed("critical", "gap, size = ", _EXACT),
    Allowed("critical_linearisation", "CANCELLATION", _EXACT),
    Allowed("critical_linearisation", "size = abs(a * d) + b * b", _EXACT),
    Allowed("critical_linearisation", "size < 1e-280", _EXACT),
    Allowed("critical", "size < 1e-280", _EXACT),
    Allowed("critical", "+ 0.0", "Turns -0.0 into 0.0."),
    Allowed("critical", "complement: float = 1.0", "Read only where a critical set exists, and then given."),
    Allowed("equator", "SINGULAR = ", "A tolerance of a few roundings."),
    Allowed("equator", "abs(value) <= 1e-3 * size", _EXACT),
    Allowed("equator", "size = abs(a) + abs(d)", _EXACT),
    Allowed("equator", "if m > 4", "General systems only: core/test_equator_general.py."),
    Allowed("equator", "reached is not None and zeros.theta", "U(e) = 0 at |e| = 1 is a zero of Theta: there is one."),
    Allowed("critical", "parts = ((n1", _SLACK),
    Allowed("critical", "solvable = ", _SLACK),
    Allowed("critical_linearisation", "radial * (abs(a) * c * c", "A tolerance of a few roundings."),
    Allowed("lyapunov", "size = (abs(", "Either column of a singular matrix will do; the larger is the better one."),
    Allowed("lyapunov", "size[:, :1] >= size[:, 1:]", "Either column will do; the larger is the better one."),
    Allowed("hemisphere", "h2 = np.maximum", _UNUSED),
    Allowed("hemisphere", "s = np.where(h2 > 0.0", _UNUSED),
    Allowed("hemisphere", "shape = np.where(h2 > 0.0", _UNUSED),
    Allowed("sliding", "writeable = False", "A result that can be changed is no wrong formula."),
    Allowed("equator", "writeable = False", "A result that can be changed is no wrong formula."),
    Allowed("critical", "writeable = False", "A result that can be changed is no wrong formula."),
    Allowed("nullclines", "POINTS", _LOOKS),
    Allowed("nullclines", "PASSES", _LOOKS),
    Allowed("nullclines", "SAG", _LOOKS),
    Allowed("nullclines", "share = ", _LOOKS),
    Allowed("nullclines", "sag", _LOOKS),
    Allowed("nullclines", "1e-9 * size_l", "Within an angle of 1e-9 the two ways draw the same."),
    Allowed("nullclines", "right - left < 1e-14", "A span so short is no pixel."),
    Allowed("trigonometric", "d_r2", _SLACK),
    Allowed("trigonometric", "d_q = ", _SLACK),
    Allowed("trigonometric", "d_i = ", _SLACK),
    Allowed("trigonometric", "d_j = ", _SLACK),
    Allowed("trigonometric", "change = ", _SLACK),
    Allowed("trigonometric", "e_i, e_j = ", _SLACK),
    Allowed("trigonometric", "error = ", _SLACK),
    Allowed("trigonometric", "fast = _fast(", _SLACK),
    Allowed("trigonometric", "starts = _starts(", _EXACT),
    Allowed("trigonometric", "len(starts) not in", _EXACT),
    Allowed("trigonometric", "steep", _EXACT),
    Allowed("trigonometric", "clear", _EXACT),
    Allowed("regularisation_families", "0.0 * lib.minimum(s, 0.0)", "Zero either way, as s >= 0."),
    Allowed("regularisation_families", "guess", _GUESS),
    Allowed("regularisation_families", "Winitzki", _GUESS),
    Allowed("regularisation_families", "L = lib.where(", _GUESS),
    Allowed("regularisation_families", "log_y = ", _GUESS),
    Allowed("regularisation_families", "ratio", _GUESS),
    Allowed("regularisation_families", "for _ in range(", _GUESS),
    Allowed("regularisation_families", "s = lib.maximum(L", _GUESS),
    Allowed("regularisation_families", "zeta = lib.where(s > 0.05", "Either side of the threshold is right there."),
    Allowed("regularisation_families", "lib.minimum(s, 1e9)", "exp(-2 sqrt s) is 0 long before."),
    Allowed("regularisation_families", "lib.minimum(zeta, 1e", "The value is saturated long before."),
    Allowed("regularisation_families", "lib.minimum(u, 1e160)", "The value is saturated long before."),
    Allowed("regularisation_families", "5e-324", _UNUSED),
    Allowed("regularisation_families", "for odd in", "The far end of a continued fraction that has long converged."),
)


def explained(module: str, line: str) -> bool:
    """Whether the list above says why mutants of this line may live."""
    return any(allowed.module == module and allowed.line in line for allowed in ALLOWED)
