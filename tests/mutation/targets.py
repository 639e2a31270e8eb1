"""Which tests guard which module, and which mutants are known to change nothing that anybody can see."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
FOLDERS = {"core": "codim2_core", "app": "app"}
EVERYWHERE = {"core": ("core/test_read_only.py", "core/test_tables.py")}
# Beside the tests in the room itself.
ELSEWHERE: dict[str, tuple[str, ...]] = {
    "core.bifurcations": ("precision/test_bifurcations.py",),
    "core.cycles": ("core/layer_problem/test_given_matrix.py", "precision/test_cycles.py"),
    "core.expressions": ("core/systems",),
    "core.layer_problem": (
        "core/portrait/test_classify.py",
        "core/portrait/test_portrait_words.py",
        "precision/test_bifurcations.py",
        "precision/test_critical.py",
        "precision/test_equator.py",
        "stress/test_rounding.py",
    ),
    "core.motion": ("core/initial_value",),
    "core.numerics": ("core/layer_problem", "precision/test_equator.py"),
    "core.psi": ("precision/test_steepness.py",),
    "core.portrait": ("precision/test_separatrices.py",),
    "core.sliding": ("core/layer_problem/test_critical.py",),
    "core.stepping": ("core/orbits",),
    "core.systems": ("core/layer_problem/test_critical.py",),
    "core.figures": ("presets",),
    "app.draw": ("app/view/test_view.py",),
    "app.frame": ("app/panels", "app/view/test_refresh.py"),
    "app.phrases": ("words/test_app_words.py",),
    "app.slow_layers": ("app/panels",),
    "app.state": ("app/view/test_refresh.py",),
    "app.view": ("app/state",),
}


# Of kernels, which are run as Python: tests that are quick all the same.
KERNELS = {
    "core.cycles": tuple(f"core/cycles/test_{name}.py" for name in ("lane_steps", "return_map", "turn_map")),
}


def modules() -> dict[str, Path]:
    """All modules that are more than a list of names, as ``core.ROOM.NAME`` and ``app.ROOM.NAME``."""
    found = {}
    for short, folder in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            if parts[-1] == "__init__" and "def " not in path.read_text():
                continue
            if len(parts) > 1 or parts[0] != "__init__":
                found[".".join((short, *parts))] = path
    return found


def front_end() -> dict[str, Path]:
    """All modules of the browser's half, as ``static/NAME.js``."""
    app = ROOT / "app"
    return {path.relative_to(app).as_posix(): path for path in sorted((app / "static").rglob("*.js"))}


def room(module: str) -> str:
    """``core.ROOM`` of ``core.ROOM.NAME``."""
    return ".".join(module.split(".")[:2])


def is_kernel(module: str) -> bool:
    """Whether Numba compiles what a module defines: its mutants are tried as Python."""
    return room(module) == "core.stepping" or "from numba import" in modules()[module].read_text()


def guards(name: str, kernels: bool = False) -> tuple[str, ...]:
    """Files and folders of the tests that guard a room, or its kernels."""
    if kernels and name in KERNELS:
        return KERNELS[name]
    own = name.replace(".", "/")
    folder = ROOT / "tests" / own
    # a module beside the rooms has files of tests beside their folders
    beside = (path.relative_to(ROOT / "tests").as_posix() for path in folder.parent.glob(f"test_{folder.name}*.py"))
    there = [own] if folder.is_dir() else sorted(beside)
    return (*there, *ELSEWHERE.get(name, ()), *EVERYWHERE.get(name.split(".")[0], ()))


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
_FAR_APART = "A threshold: what it tells apart lies far on either side."
_EFFORT = "How much is tried: less would do for what is asked of it here."

ALLOWED: tuple[Allowed, ...] = (
    Allowed("core.sliding.along", "BISECTIONS = 44", "One bisection more, beyond the digits of z."),
    Allowed("core.sliding.along", "THIRDS = 48", "A third less, beyond the digits of z."),
    Allowed("core.sliding.along", "AT_EQUATOR = 1e-4", "A critical set this near the equator is about to reach it."),
    Allowed("core.sliding.along", "count: int = 81", "How finely changes are looked for, unless the caller says it."),
    Allowed("core.sliding.along", "if sets[0] else 2", "Where there is nothing, nothing is looked at in between."),
    Allowed("core.sliding.filippov", "weights, slope = np.zeros(0)", "Every round gives both anew."),
    Allowed("core.sliding.over", "count: int = ", "How many values are shown, unless the caller says it."),
    Allowed("core.layer_problem.location", "CANCELLATION", _EXACT),
    Allowed("core.layer_problem.location", "w0 = ", _EXACT),
    Allowed("core.layer_problem.location", "w1, w2 = ", _EXACT),
    Allowed("core.layer_problem.location", "gap, size = ", _EXACT),
    Allowed("core.layer_problem.linearisation", "CANCELLATION", _EXACT),
    Allowed("core.layer_problem.linearisation", "size = abs(a * d) + b * b", _EXACT),
    Allowed("core.layer_problem.linearisation", "size < 1e-280", _EXACT),
    Allowed("core.layer_problem.location", "size < 1e-280", _EXACT),
    Allowed("core.layer_problem.location", "+ 0.0", "Turns -0.0 into 0.0."),
    Allowed(
        "core.layer_problem.location",
        "complement: float = 1.0",
        "Read only where a critical set exists, and then given.",
    ),
    Allowed("core.layer_problem.equator", "SINGULAR = ", "A tolerance of a few roundings."),
    Allowed("core.layer_problem.equator", "abs(value) <= 1e-3 * size", _EXACT),
    Allowed("core.layer_problem.equator", "size = abs(a) + abs(d)", _EXACT),
    Allowed("core.layer_problem.equator", "if m > 4", "General systems only: test_equator_zeros.py."),
    Allowed(
        "core.layer_problem.equator",
        "reached is not None and zeros.theta",
        "U(e) = 0 at |e| = 1 is a zero of Theta: there is one.",
    ),
    Allowed("core.layer_problem.location", "parts = ((n1", _SLACK),
    Allowed("core.layer_problem.location", "solvable = ", _SLACK),
    Allowed("core.layer_problem.linearisation", "radial * (abs(a) * c * c", "A tolerance of a few roundings."),
    Allowed(
        "core.layer_problem.lyapunov",
        "size = (abs(",
        "Either column of a singular matrix will do; the larger is the better one.",
    ),
    Allowed(
        "core.layer_problem.lyapunov",
        "size[:, :1] >= size[:, 1:]",
        "Either column will do; the larger is better.",
    ),
    Allowed("core.layer_problem.hemisphere", "h2 = np.maximum", _UNUSED),
    Allowed("core.layer_problem.hemisphere", "s = np.where(h2 > 0.0", _UNUSED),
    Allowed("core.layer_problem.hemisphere", "shape = np.where(h2 > 0.0", _UNUSED),
    Allowed("core.portrait.separatrices", "PIXEL = ", _LOOKS),
    Allowed(
        "core.portrait.separatrices", "rtol: float = 1e-9", "How closely it is followed, unless the caller says it."
    ),
    Allowed(
        "core.portrait.separatrices",
        "tolerance: float = 1e-6",
        "What counts as a connection, unless the caller says it.",
    ),
    Allowed("core.portrait.endings", "rtol: float = 1e-9", "How closely it is followed, unless the caller says it."),
    Allowed("core.portrait.launched", "LONG = 40.0", "How long a line is drawn."),
    Allowed("core.motion.agreement", "FAR_OUT = 1e6", "Where the limit of the steepness is read off."),
    Allowed("core.cycles.section", "limit: int = 0", "A protocol: what it says is never run."),
    Allowed("core.cycles.section", "rtol: float = 0.0, backward", "A protocol: what it says is never run."),
    Allowed("core.cycles.orbit", "LEAST = 1e-300", "A number too small to be told from the next."),
    Allowed("core.cycles.return_map", "step[k] = h * at_low[k] / (", _GUESS),
    Allowed("core.cycles.return_map", "low[k], at_low[k], high[k], at_high[k] = 0.0", _GUESS),
    Allowed("core.cycles.turn_map", "step[k] = h * at_low[k] / (", _GUESS),
    Allowed("core.cycles.turn_map", "low[k], at_low[k] = 0.0, abs(", _GUESS),
    Allowed("core.cycles.turn_map", "high[k], at_high[k] = h, abs(", _GUESS),
    Allowed("core.layer_problem.border", "CANCELS = 0.05", _EXACT),
    Allowed("core.layer_problem.linearisation", "radial * (cc * abs(m11)", "A tolerance of a few roundings."),
    Allowed("core.sliding.filippov", "START = 48", "How many directions are combined first: the others are added."),
    Allowed(
        "core.sliding.filippov",
        "CLOSE = 1e-3",
        "Within which directions are one maximum, which has all digits either way.",
    ),
    Allowed("core.sliding.filippov", "primal_feasibility_tolerance", "Newton's method restores the digits."),
    Allowed("core.sliding.filippov", "residual = np.ones(1)", "Every round gives it anew."),
    Allowed("core.sliding.filippov", "bounds=[(-1.0, 1.0)", "Any box does: only the sign of the least s is asked for."),
    Allowed("core.sliding.filippov", "s + 0.5 * abs(s)", "How early a round may end; the next would find the same."),
    Allowed("core.sliding.filippov", "np.abs(residual).max() < 1e-12", "Newton's method has converged, or it has not."),
    Allowed("core.sliding.filippov", "for _ in range(40)", "One golden section more, beyond what can be told."),
    Allowed("core.sliding.filippov", "fresh = np.abs(", "A direction that is taken twice changes no extreme."),
    Allowed("core.sliding.along", "xtol=1e-15", "A tolerance of a few roundings."),
    Allowed("core.nullcline.polylines", "POINTS", _LOOKS),
    Allowed("core.nullcline.polylines", "PASSES", _LOOKS),
    Allowed("core.nullcline.polylines", "SAG", _LOOKS),
    Allowed("core.nullcline.polylines", "share = ", _LOOKS),
    Allowed("core.nullcline.polylines", "sag", _LOOKS),
    Allowed("core.nullcline.conics", "1e-9 * size_l", "Within an angle of 1e-9 the two ways draw the same."),
    Allowed("core.nullcline.conics", "right - left < 1e-14", "A span so short is no pixel."),
    Allowed("core.numerics.trigonometric", "d_r2", _SLACK),
    Allowed("core.numerics.trigonometric", "d_q = ", _SLACK),
    Allowed("core.numerics.trigonometric", "d_i = ", _SLACK),
    Allowed("core.numerics.trigonometric", "d_j = ", _SLACK),
    Allowed("core.numerics.trigonometric", "change = ", _SLACK),
    Allowed("core.numerics.trigonometric", "e_i, e_j = ", _SLACK),
    Allowed("core.numerics.trigonometric", "error = ", _SLACK),
    Allowed("core.numerics.trigonometric", "fast = _fast(", _SLACK),
    Allowed("core.numerics.trigonometric", "starts = _starts(", _EXACT),
    Allowed("core.numerics.trigonometric", "len(starts) not in", _EXACT),
    Allowed("core.numerics.trigonometric", "steep", _EXACT),
    Allowed("core.numerics.trigonometric", "clear", _EXACT),
    Allowed("core.layer_problem.disc_zeros", "EFFORTS = ", _EFFORT),
    Allowed("core.layer_problem.disc_zeros", "CURVE = 200", _FAR_APART),
    Allowed("core.layer_problem.disc_zeros", "LONG = 0.02", _FAR_APART),
    Allowed("core.layer_problem.disc_zeros", "REGULAR = 1e-4", _FAR_APART),
    Allowed("core.layer_problem.disc_zeros", "ROUGH = 1e-2", _FAR_APART),
    Allowed("core.layer_problem.disc_zeros", "SMALL = 2e-6", _FAR_APART),
    Allowed("core.layer_problem.disc_zeros", "CROWDED = 100", _EFFORT),
    Allowed(
        "core.layer_problem.disc_zeros", "found, rest = np.empty(", "Room for what is found, of which part is read."
    ),
    Allowed("core.layer_problem.disc_zeros", "for _ in range(40)", _EFFORT),
    Allowed("core.layer_problem.closed_equator", "CLOSE = 1e-4", _FAR_APART),
    Allowed("core.layer_problem.closed_equator", "NEUTRAL_EQUATOR = ", "A tolerance of a few roundings."),
    Allowed("core.layer_problem.closed_equator", "for _ in range(3)", _EFFORT),
    Allowed("core.layer_problem.closed_equator", "for _ in range(100)", _EFFORT),
    Allowed("core.layer_problem.closed_equator", "bits = 256", "More digits than are asked for."),
    Allowed("core.layer_problem.equator_zeros", "MOST_ANGLES = ", _EFFORT),
    Allowed("core.layer_problem.equator_zeros", "NET = 4096", _EFFORT),
    Allowed("core.layer_problem.equator_zeros", "MOST_OF_A_TURN = ", _EFFORT),
    Allowed("core.layer_problem.equator_zeros", "for _ in range(2)", _EFFORT),
    Allowed("core.layer_problem.equator_zeros", "between = (np.arange(n)", "Any angles between will do."),
    Allowed("core.motion.phases", "HALVINGS = 45", _EFFORT),
    Allowed("core.motion.followed", "NEWTON = 12", _EFFORT),
    Allowed("core.motion.slide", "NEWTON = 20", _EFFORT),
    Allowed("core.motion.slide_on_cycle", "APART = 0.2", _FAR_APART),
    Allowed("core.motion.slide_on_cycle", "DIFFERENCE = 1e-4", "Newton's method is a simplified one."),
    Allowed("core.motion.agreement", "NEUTRAL = 1e-6", _FAR_APART),
    Allowed("core.motion.course", "CLOSER = 1e-4", _FAR_APART),
    Allowed("core.motion.decide", "AT_MIDDLE = 1e-12", _FAR_APART),
    Allowed("core.motion.slide", "NEAR_HOPF = 1e-2", _FAR_APART),
    Allowed("core.motion.places", "FASTEST, LONGEST = 60.0, 4.0", _EFFORT),
    Allowed("core.motion.regularised", "FIRST = 1e-2", "The first step tried: its error says how long the next is."),
    Allowed("core.motion.result", "SAMPLES, MOST = 240", _LOOKS),
    Allowed("core.motion.result", "ASCENT = 3", _LOOKS),
    Allowed("core.motion.regularised", "PATIENCE = 400", "When a motion goes on compiled: the same motion."),
    Allowed("core.motion.regularised", "MANY = 8", "When motions are compiled at once: the same motions."),
    Allowed("app.draw.theme", "NEAREST, WIDEST = ", "How near and how wide one may look."),
    Allowed("app.draw.thumbnails", "VIEW = 1.5", _LOOKS),
    Allowed("app.draw.thumbnails", "PIXEL = 1 / 28", _LOOKS),
    Allowed("app.draw.thumbnails", "COUNT = 22", _LOOKS),
    Allowed("app.draw.vector.labels", "NARROW, WIDE, CAPITAL, OTHER = ", "How wide letters are at most."),
    Allowed("app.draw.vector.paper", '"rho": (9, 4)', "How long dashes are, as long as they differ."),
    Allowed("app.draw.vector.paper", '"launch-3": (12, 3)', "How long dashes are, as long as they differ."),
    Allowed("static/cell.js", "const PATIENCE", "How long a kernel is waited for, to a millisecond."),
    Allowed("static/cell.js", "step = 50", "How often it is looked, to a millisecond."),
    Allowed("static/cell.js", "Infinity, 500)", "How often it is looked, to a millisecond."),
    Allowed("static/gestures.js", "|| 1e-9", "Fingers at one place: the factor is bounded either way."),
    Allowed("static/gestures.js", "passive: true", "A promise to the browser not to prevent, which nothing does."),
    Allowed("core.psi.families.constant", "0.0 * lib.minimum(s, 0.0)", "Zero either way, as s >= 0."),
    Allowed("core.psi.families.hill", "guess", _GUESS),
    Allowed("core.psi.families.exponential", "Winitzki", _GUESS),
    Allowed("core.psi.families.exponential", "L = lib.where(", _GUESS),
    Allowed("core.psi.families.hill", "L = lib.where(", _GUESS),
    Allowed("core.psi.families.hill", "log_y = ", _GUESS),
    Allowed("core.psi.families.hill", "ratio", _GUESS),
    Allowed("core.psi.families.exponential", "for _ in range(", _GUESS),
    Allowed("core.psi.families.hill", "for _ in range(", _GUESS),
    Allowed("core.psi.families.exponential", "s = lib.maximum(L", _GUESS),
    Allowed(
        "core.psi.families.exponential", "zeta = lib.where(s > 0.05", "Either side of the threshold is right there."
    ),
    Allowed("core.psi.families.tanh", "lib.minimum(s, 1e9)", "exp(-2 sqrt s) is 0 long before."),
    Allowed("core.psi.families.exponential", "lib.minimum(zeta, 1e", "The value is saturated long before."),
    Allowed("core.psi.families.tanh", "lib.minimum(zeta, 1e", "The value is saturated long before."),
    Allowed("core.psi.families.hill", "lib.minimum(u, 1e160)", "The value is saturated long before."),
    Allowed("core.psi.families.hill", "5e-324", _UNUSED),
    Allowed("core.psi.families.tanh", "for odd in", "The far end of a continued fraction that has long converged."),
)


def explained(module: str, line: str) -> bool:
    """Whether the list above says why mutants of this line may live."""
    return any(allowed.module == module and allowed.line in line for allowed in ALLOWED)


class Lives(NamedTuple):
    """A mutant that was tried and lives, by part of its text, and why."""

    module: str
    change: str
    why: str


LIVES: tuple[Lives, ...] = (
    Lives("app.draw.arrowheads", "/ clearance) + 1  →  1", "All in one row of cells: the same places, more slowly."),
    Lives("app.draw.arrowheads", "row - 1  →  -1", "More cells are looked at: the same places, more slowly."),
    Lives("core.layer_problem.closed_equator", "abs(a) + abs(d)  →  abs(d)", "A tolerance of a few roundings."),
    Lives("core.layer_problem.closed_equator", "0.1  →  0.125", "Either way is right there."),
    Lives("core.layer_problem.critical", "  →  at.affine is None", "Both are None, or neither is."),
    Lives("core.layer_problem.critical", "or location.e  →", "Turned back it is there as well."),
    Lives("core.portrait.outcomes", "  →  cycle.neutral", "Without a limit direction there is a closed orbit."),
    Lives("core.cycles.first_turns", "  →  finite.sum() >= 8", "Backward it is the identity where it is forward."),
    Lives("core.cycles.first_turns", "left * (left - right)", "The interval is 1e-13 wide by then."),
    Lives("core.cycles.resolution", "86: 3  →  4", "One more difference, which is not read."),
    Lives("core.cycles.search", "23: 2.0  →  2.5", "How far outside a newborn cycle its expansion is measured."),
    Lives("core.motion.course", "266: 3e3  →", "How far past a fold it is looked at last."),
    Lives("core.motion.course", "10.0  →  12.5", "How far past the last cycle it is looked."),
    Lives("core.motion.decide", "8  →  9", "How many orbits around a set are followed."),
    Lives("core.motion.nonsmooth", "1e-200  →", "A number too small to be told from the next."),
    Lives("core.portrait.separatrices", "2.0 * pixel  →", "Lines are drawn finely though they are far apart."),
    Lives("core.portrait.separatrix_branches", "1e-4  →", "How near the equator a branch starts."),
    Lives(
        "core.portrait.separatrix_branches", "- NEAR_SIGMA * lean", "Where it starts, within 1e-4: all is drawn to it."
    ),
    Lives("core.portrait.verdicts", "0.02  →", "How near a direction a fan of orbits starts."),
    Lives("core.portrait.verdicts", "0.1  →", "How closely orbits are followed whose ends are asked for."),
    Lives("core.cycles.lane_steps", "1e-300  →", "A number too small to be told from the next."),
    Lives("core.cycles.lane_steps", "+ 1e-300", "A bound that keeps from dividing by zero."),
    Lives("core.cycles.lane_steps", "1e-30  →", "A bound that keeps from dividing by zero."),
    Lives("core.cycles.lane_steps", "13: 0.1  →", "The share of the tolerance that one step may take."),
    Lives("core.cycles.lane_steps", "40  →  41", "How often it is tried at most."),
    Lives("core.cycles.lane_steps", "95: 3  →  4", "Written over at once."),
    Lives("core.cycles.return_map", "88: 0.0  →", "The length of a step that nobody takes."),
    Lives("core.cycles.return_map", "160: 0.0  →", "The length of a step that nobody takes."),
    Lives("core.cycles.return_map", "0.5  →  0.625", "The length of the first step that is tried."),
    Lives("core.cycles.return_map", "or phase[k] == REFINING  →", "What has ended is judged again: nothing is read."),
    Lives("core.cycles.return_map", "119: 1  →  2", "How often it is tried at most."),
    Lives("core.cycles.return_map", "-16  →", "A tolerance of a few roundings."),
    Lives("core.cycles.return_map", "high[k] - low[k]  →", "Once more than needed: the same end."),
    Lives("core.cycles.return_map", "u[0] * vy  →  u[0] / vy", "Only its sign is read."),
    Lives("core.cycles.return_map", "153: 3  →  4", "Written over before it is read."),
    Lives("core.cycles.return_map", "82: SHARE * rtol", "The share of the tolerance that one step may take."),
    Lives("core.cycles.return_map", "94: 0.0  →", "Either way it is the same crossing."),
    Lives("core.cycles.return_map", "running > 0 and spent < limit", "Nothing runs any more."),
    Lives("core.cycles.return_map", "108: 1.0  →", "The share of the tolerance that one step may take."),
    Lives("core.cycles.return_map", "vx * vx + vy * vy", "Within which a crossing is exact: a few roundings."),
    Lives("core.cycles.turn_map", "141: 3  →  4", "Written over before it is read."),
    Lives("core.cycles.turn_map", "146: 0.0  →", "The length of a step that nobody takes."),
    Lives("core.cycles.turn_section", "54: 2.0  →", "More room than there is in the disc."),
    Lives("core.portrait.endings", "127: ", "Looked at again, it ends where it ended."),
    Lives("core.cycles.turn_map", "86: 0.0  →", "The length of a step that nobody takes."),
    Lives("core.cycles.turn_map", "0.5  →  0.625", "The length that is tried next."),
    Lives("core.cycles.turn_map", "-16  →", "A tolerance of a few roundings."),
    Lives("core.cycles.turn_map", "-15  →", "A tolerance of a few roundings."),
    Lives("core.cycles.turn_map", "114: 1.0  →", "The share of the tolerance that one step may take."),
    Lives("core.cycles.section", "1e-300  →", "A number too small to be told from the next."),
    Lives("core.cycles.section", "1e-290  →", "A number too small to be told from the next."),
    Lives("core.cycles.search", "y[-1] - y[0]  →  y[-1]", "Only its sign is read, and the two have different ones."),
    Lives("core.cycles.section", "23: 1e-", "How near C or the equator an orbit has gone there."),
    Lives("core.cycles.turn_section", "1e-300  →", "A number too small to be told from the next."),
    Lives("core.cycles.turn_section", "20: 1e-", "How near C or the equator an orbit has gone there."),
    Lives("core.cycles.turn_section", "21: 1e-4  →", "How near a set an orbit has settled there."),
    Lives("core.cycles.search", "8.0  →", "How flat a displacement is near its limit."),
    Lives("core.cycles.search", "y[-1] - y[0]  →  -y[0]", "Only its sign is read."),
    Lives("core.cycles.search", "89: 1e-3  →", "How closely a jump is looked at."),
    Lives("core.cycles.search", "71: 2  →", "One more sample for the first guess."),
    Lives("core.cycles.search", "width * np.array", "Then the rounds of samples find it."),
    Lives("core.cycles.resolution", "35: 24  →", "How many rounds at most."),
    Lives("core.cycles.resolution", "38: 10.0  →", "By how much two samples differ that are told apart."),
    Lives("core.cycles.orbit", "1e-300  →", "A number too small to be told from the next."),
    Lives("core.portrait.classify", "location is None or", "Both are None, or neither is."),
    Lives("core.portrait.classify_typed", "ROUNDINGS * UNIT", "A tolerance of a few roundings."),
    Lives("core.portrait.endings", "197: 0.0  →", "Without a limit direction there is nothing to compare."),
    Lives("core.portrait.saddle_manifold", "6  →  7", "How often the start is moved at most."),
    Lives("core.portrait.saddle_manifold", "108: 1  →  2", "How soon a start is near enough."),
    Lives("core.portrait.separatrix_branches", "100.0  →", "The first of times that are ever longer."),
    Lives("core.portrait.separatrix_branches", "184: 2.0 * abs", "More time than it takes to leave the picture."),
    Lives("core.portrait.saddle_manifold", "106: SMALLEST", "How near the saddle a branch starts at least."),
    Lives("core.portrait.saddle_manifold", "0.8 * reach", "How soon a start is near enough."),
    Lives("core.portrait.saddle_connections", "1e-300  →", "A number too small to be told from the next."),
    Lives("core.portrait.endings", "31: 1e-2", "How near a radially neutral direction an orbit is at it."),
    Lives("core.portrait.endings", "0.1  →", "How closely orbits are followed whose ends are asked for."),
    Lives("core.portrait.separatrix_branches", "50: 0.1", "How closely a branch is followed beside its tolerance."),
    Lives("core.portrait.outcomes", "begin + end -", "The same angle, a turn less."),
    Lives("core.portrait.outcomes", "64  →  65", "In how many directions it is looked."),
    Lives("core.portrait.outcomes", "206: 2.0  →", "In how many directions it is looked."),
    Lives("core.portrait.outcomes", "1e-9  →", "Within which an angle is that of a limit direction."),
    Lives("core.portrait.verdicts", "0.1 * RTOL  →  RTOL", "How closely orbits are followed whose ends are asked for."),
    Lives("core.portrait.basins", "77: 128", "Into how many cells, unless the caller says it."),
    Lives("core.layer_problem.linearisation", "Fraction(ROUNDING)", "A tolerance of a few roundings."),
    Lives("core.cycles.turn_section", "2000  →  2001", "How many steps are tried at most."),
    Lives(
        "core.layer_problem.problem",
        "31: len(on) or",
        "Asked for the closed orbit of an equator at rest, there is none.",
    ),
    Lives(
        "core.cycles.first_turns", "  →  np.isfinite(shift[[i, j]]).all()", "Where it repels, narrowing finds nothing."
    ),
    Lives("core.cycles.first_turns", "146: 1.0  →", "How narrow a bracket becomes: a few roundings."),
    Lives("core.cycles.first_turns", "1e-300  →", "A number too small to be told from the next."),
    Lives("core.cycles.first_turns", "170: 1e-3  →", "How near two multipliers are that are one."),
    Lives("core.cycles.first_turns", "135: 0.5", "How far beyond two samples it is looked."),
    Lives("core.cycles.loop", "64: 1  →  2", "A multiple zero has no eigenvalue, and begins and ends no arc."),
    Lives("core.layer_problem.critical", "and location is None", "Both are None, or neither is."),
    Lives("core.layer_problem.critical", "sides - middle  →  sides", "Sides are looked at that agree."),
    Lives("core.layer_problem.critical", "1e-3  →  0.00125", "Sides that differ by so little agree."),
    Lives("core.layer_problem.closed_equator", "abs(b) + h  →", "A tolerance of a few roundings."),
    Lives("core.layer_problem.closed_equator", "-f1  →  f1", "Where Newton's method starts; it finds the same zero."),
    Lives("core.portrait.launched", "1.0  →  1.25", "How finely a line is drawn, unless the caller says it."),
    Lives("core.layer_problem.closed_equator", "1e-16  →", "A tolerance of a few roundings."),
    Lives(
        "core.cycles.section", "start * start  →", "Where the first of the outer samples lies: they are looked between."
    ),
    Lives("core.motion.decide", "  →  outcome.depends_on_psi", "With a Psi given none is compared."),
    Lives("core.motion.course", "self.t < self.t_end  →", "Only where a phase ends just at the end of the time."),
    Lives("core.motion.course", "  →  self.line is not None", "In a line there is no Hopf point and no cycle."),
    Lives("core.portrait.endings", "138: 0  →  1", "The name of a direction where there is none: not read."),
    Lives("core.portrait.endings", "52: 0  →  1", "The number of a set where there is none: not read."),
    Lives("core.portrait.endings", "1.0  →  1.25", "Beyond the end of a piece, where the next one is as near."),
    Lives("core.portrait.endings", "  →  statuses[i] is Status.ARRIVED", "Only at a limit direction does one arrive."),
    Lives("core.motion.followed", "size >= 0.5 * before", "How early Newton's method ends."),
    Lives("core.cycles.first_turns", "0.0  →  1.0", "A zero just at a sample is found as any other."),
    Lives(
        "core.cycles.first_turns", "  →  C.discriminant < 0.0 and", "Where no orbit returns it goes as the trace says."
    ),
    Lives("core.cycles.first_turns", "8  →  9", "How many samples show that all orbits are closed, at least."),
    Lives("core.cycles.turn_section", "0.25  →  0.3125", "Which of all rays is taken: any of them will do."),
    Lives("core.cycles.first_turns", "left - right  →  left", "The interval is 1e-13 wide by then."),
    Lives("core.cycles.orbit", "way is not None and math.dist", "Once more round than needed: the same orbit."),
    Lives(
        "app.draw.arrowheads", "int((x - left) / clearance) + 1  →", "The cells beside the first wrap to empty ones."
    ),
    Lives(
        "app.draw.arrowheads", "int((y - bottom) / clearance) + 1  →", "The cells beside the first wrap to empty ones."
    ),
    Lives("app.draw.arrowheads", "y - bottom  →", "Other cells by the same rule: the same places."),
    Lives("app.draw.arrowheads", "x - left  →", "Other cells by the same rule: the same places."),
    Lives("app.draw.arrowheads", "83: 1  →  2", "More cells are looked at: the same places, more slowly."),
    Lives("app.draw.arrowheads", "84: 1  →  2", "More cells are looked at: the same places, more slowly."),
    Lives("app.draw.plane_curves", "66: 0.0  →  1.0", "Without curves their size is 1 either way."),
    Lives("app.draw.still", "33: 1  →  2", "It is there once."),
    Lives("app.draw.svg", "97: -view  →  view", "The height of a small portrait is not asked for."),
    Lives("core.layer_problem.critical", "not kinks(system.U, PLANE)", "Sides that agree are looked at, more slowly."),
    Lives("app.draw.packing", "350  →", "Where arrowheads are placed: as it looks at 700 px."),
    Lives("core.layer_problem.critical", "→  location is None", "Both are None, or neither is."),
    Lives("core.layer_problem.critical", "→  not _sides_agree", "The sides of a rough set do not agree."),
    Lives("core.motion.followed", "109: 1.0  →  1.25", "In the centre D e_Psi is the same in all directions."),
    Lives("core.motion.slide", "size >= 0.5 * before", "How early Newton's method ends."),
    Lives("core.motion.phases", "before.e and ", "Runs on one set both have a place, or neither has: a cycle."),
    Lives("core.motion.slide", "187: 1.0  →  1.25", "Only its sign is asked for."),
    Lives("core.motion.slide", "self.e - self.slope", "Where Newton's method starts; it finds the same zero."),
    Lives("core.motion.slide", "272: 0.0  →  1.0", "From where a gauge is positive its zero has been found."),
    Lives("core.motion.course", "1e2  →", "How far past a fold it is looked next."),
    Lives("core.motion.part", "40: 0.0  →  1.0", "In the limit eps is not read."),
    Lives("core.motion.regularised", "compile_at_once and", "How it is computed: the same motion."),
    Lives("core.motion.regularised", "→  len(taken) in (0, PATIENCE)", "Only where just so many steps end a motion."),
    Lives("core.motion.result", "0.1  →  0.125", "Up to where rounding is measured."),
    Lives("core.motion.slide", "→  -turn / trace", "Only its sign is asked for."),
    Lives("static/requests.js", "1e12  →", "From which number requests are counted."),
    Lives("app.draw.layers", "177: 100  →  101", "Which lies above which stays as it is."),
    Lives("app.draw.layers", "194: 120  →  121", "Which lies above which stays as it is."),
    Lives("static/chart/space.js", "row >= 0  →  (column >= 0)", "What has a negative index is no part of an array."),
    Lives("static/cell.js", "0  →  1", "A millisecond more is waited."),
    Lives("static/chart/chart.js", "26  →  27", "From where on a name stands below: a pixel."),
    Lives("static/chart/scale.js", "1e-9  →", "A tolerance of a few roundings."),
    Lives("static/chart/space.js", "1  →  2", "What nothing is divided by."),
    Lives("static/chart/space.js", "height / 2  →", "Marked again where it has been marked."),
    Lives("static/chart/space.js", "width / 2  →", "Marked again where it has been marked."),
    Lives("static/words.js", "0  →  1", "Zero is written as it is either way."),
    Lives("static/hands.js", "0  →  1", "Where the orbit would be: only how many there are is asked for."),
    Lives("static/launches.js", "|| 0  →", "-0 is written as 0 either way."),
    Lives("static/panels/along.js", "1e-9  →", "A bound that keeps from dividing by zero."),
    Lives("static/panels/along.js", "1e-4  →", "How slow counts as at rest."),
    Lives("static/panels/diagram.js", "200  →  201", "A key's step is rounded to a thousandth of the span."),
    Lives("static/panels/diagram.js", "0.6  →", "How far apart points come that were one mark."),
    Lives("static/panels/diagram.js", "8  →  9", "A ninth digit of what has been rounded."),
    Lives("static/panels/numbers.js", "0.1  →  0.125", "The axis shows at least −4 to 4."),
    Lives("static/panels/psi.js", "1.05 *", "How much room there is above a curve."),
    Lives("core.sliding.filippov", "1.0  →  1.25", "The unit of a field that is zero everywhere."),
    Lives("core.sliding.filippov", "512  →  513", "How finely maxima are looked for first."),
    Lives("core.sliding.filippov", "np.minimum(weighed, 0.0)", "Newton's method fails, and the weights are balanced."),
)


def reason(module: str, change: str) -> str:
    """Return why a mutant lives, as far as it is known, to be written after it."""
    return next((f": {one.why}" for one in LIVES if one.module == module and one.change in change), "")
