"""Along Sigma: where a system slides, crosses or is unstable, and the slow flow on each critical set.

One slow variable is varied, the others stay. Between special points the number and the kinds of the critical sets do
not change; the special points are found by bisection on exactly that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...numerics.assignment import assign
from ...numerics.sign_changes import root_between
from ...results.arrays import Array
from ...results.words import say, subscript
from ...systems.elinear import ELinear
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ...systems.reading import slow_axis, slow_values
from ...systems.typed import System
from ..layer_problem.critical import CriticalSet, critical_sets
from ..layer_problem.equator import equator_equilibria
from .slow_portrait_result import SlowBranch, SlowInterval, SlowPoint, SlowPortrait

BISECTIONS = 44  # of one step of the net: to the rounding of z
MIN_CHANGE_DISTANCE = 1e-7  # of the span: two changes this near, as where a double zero is lost in rounding, are one
SLOPING = 0.75  # of the larger of its neighbours: the smallest distance of two sets that meet within a step of the net
THIRDS = 48  # times that an interval around it is cut by a third
EQUATOR_DISTANCE = 1e-4  # 1 - |e| of a critical set about to reach the equator, one bisected step before it does
STABLE, UNSTABLE, CROSSING = "sliding", "unstable", "crossing"
_SENTENCES = {
    STABLE: say("along: sliding"),
    UNSTABLE: say("along: unstable"),
    CROSSING: say("along: crossing"),
}


@dataclass(frozen=True)
class _Line:
    """The critical sets as a function of one slow variable."""

    system: AnySystem
    psi: Psi
    z: tuple[float, ...]
    axis: int

    def __call__(self, value: float) -> tuple[CriticalSet, ...]:
        z = list(self.z)
        z[self.axis] = value
        return critical_sets(self.system, self.psi, tuple(z))


@takes_names
def slow_portrait(
    system: ELinear | System,
    psi: Psi,
    along: str,
    span: tuple[float, float],
    z: ArrayLike = (),
    *,
    count: int = 81,
) -> SlowPortrait:
    """Sliding, crossing and unstable intervals of one slow variable, with the slow flow and its equilibria, (2.29).

    Parameters
    ----------
    system : ELinear or System
        With m >= 1 slow variables.
    psi : Psi
        Decides stability where that depends on it; the slow flow itself does not.
    along : str
        Which slow variable is varied, "z1" to "zm".
    span : (low, high)
    z : (m,) floats
        The other slow variables; that of `along` is not used. Left out, they are 0.
    count : int
        Values of z, at least 2, on which changes are looked for, and again where there are critical sets; two changes
        within one step that undo one another are missed.

    Returns
    -------
    SlowPortrait

    Raises
    ------
    ValueError
        There is no slow variable `along`, the span is empty, or `count` is below 2.

    Examples
    --------
    >>> from codim2_core import slow_portrait
    >>> found = slow_portrait("ball_in_pool", "constant", along="z1", span=(-10, 10))
    >>> [(one.kind, round(one.high, 6)) for one in found.intervals]
    [('crossing', -6.867), ('sliding', 6.867), ('crossing', 10.0)]
    """
    if count < 2:
        raise ValueError(f"count is {count}; give at least 2 values of z, the ends of the span.")
    axis = slow_axis("along", along, system.m)
    low, high = (float(v) for v in span)
    if not (np.isfinite([low, high]).all() and low < high):
        raise ValueError(f"span is {span}; give (low, high) with low < high.")
    others = slow_values(z if np.size(z) else (0.0,) * system.m, system.m)
    line = _Line(system, psi, others, axis)
    pieces: list[StatePiece] = []
    even = np.linspace(low, high, count)
    outer, points = _split_net(line, np.union1d(even, _exchanges(line, even)), len)
    for values, sets in outer:  # where there are critical sets, however small that is, their kinds are looked at
        net = np.linspace(values[0], values[-1], count if sets[0] else 2)
        inner, changes = _split_net(line, net, _slow_kinds)
        pieces += inner
        points += changes
    branches: list[SlowBranch] = []
    intervals: list[SlowInterval] = []
    for values, sets in pieces:
        followed = _follow(values, sets)
        branches += followed
        kind = STABLE if any(b.stable for b in followed) else UNSTABLE if followed else CROSSING
        if intervals and intervals[-1].kind == kind:
            intervals[-1] = SlowInterval(intervals[-1].low, values[-1], kind, _SENTENCES[kind])
        else:
            intervals.append(SlowInterval(intervals[-1].high if intervals else low, values[-1], kind, _SENTENCES[kind]))
        for branch in followed:
            points += _equilibria(line, branch)
    intervals[-1] = replace(intervals[-1], high=high)  # what is there only at the end is no interval
    return SlowPortrait(tuple(branches), tuple(sorted(points, key=lambda p: p.z)), tuple(intervals))


def _slow_kind(C: CriticalSet) -> str:
    """Return its kind; at tr J = 0 within rounding ("centre (linear)") that of the sign of the trace."""
    if C.kind.startswith("centre"):
        return "stable focus" if C.trace < 0.0 else "unstable focus"
    return C.kind


def _slow_kinds(sets: Sequence[CriticalSet]) -> tuple[str, ...]:
    return tuple(sorted(map(_slow_kind, sets)))


def _exchanges(line: _Line, net: Array) -> list[float]:
    """Values of z at which a saddle and another critical set are nearest, so where they pass through each other."""

    def distance(z: float) -> float:
        sets = line(z)
        saddles = [C.e for C in sets if C.determinant < 0.0]
        others = [C.e for C in sets if C.determinant > 0.0]
        return min((math.dist(e, other) for e in saddles for other in others), default=0.0 if sets else math.inf)

    d = [distance(z) for z in net.tolist()]
    found: list[float] = []
    for i in range(1, len(net) - 1):
        near, far = d[i], max(d[i - 1], d[i + 1])
        if not (0.0 < near <= min(d[i - 1], d[i + 1]) and near <= SLOPING * far < math.inf):
            continue
        low, high = float(net[i - 1]), float(net[i + 1])
        for _ in range(THIRDS):
            one, two = low + (high - low) / 3.0, high - (high - low) / 3.0
            low, high = (low, two) if distance(one) <= distance(two) else (one, high)
        found.append(0.5 * (low + high))
    return found


StatePiece = tuple[list[float], list[tuple[CriticalSet, ...]]]


def _split_net(
    line: _Line, net: Array, state: Callable[[tuple[CriticalSet, ...]], Hashable]
) -> tuple[list[StatePiece], list[SlowPoint]]:
    """Split the net where the state of the critical sets, their number or their kinds, changes."""
    start = float(net[0])
    here = line(start)
    pieces: list[StatePiece] = [([start], [here])]
    points: list[SlowPoint] = []
    for end in net[1:].tolist():
        there = line(end)
        left, before = start, here
        for _ in range(8):  # changes within one step
            if state(before) == state(there):
                break
            a, b, after = left, end, there
            for _ in range(BISECTIONS):
                middle = 0.5 * (a + b)
                if middle in (a, b):
                    break
                sets = line(middle)
                if state(sets) == state(before):
                    a, before = middle, sets
                else:
                    b, after = middle, sets
            pieces[-1][0].append(a)
            pieces[-1][1].append(before)
            points.append(_change(0.5 * (a + b), before, after))
            pieces.append(([b], [after]))
            left, before = b, after
        if pieces[-1][0][-1] < end:
            pieces[-1][0].append(end)
            pieces[-1][1].append(there)
        start, here = end, there
    return _without_narrow(pieces, points, MIN_CHANGE_DISTANCE * float(net[-1] - net[0]))


def _without_narrow(
    pieces: list[StatePiece], points: list[SlowPoint], width: float
) -> tuple[list[StatePiece], list[SlowPoint]]:
    """Join the changes on both sides of a piece that is no wider than `width`; leave it out at the ends of the net."""
    kept, changes = pieces[:1], []
    for point, piece in zip(points, pieces[1:], strict=True):
        narrow = kept[-1]
        if narrow[0][-1] - narrow[0][0] > width:
            changes.append(point)
        else:
            kept.pop()
            if kept:
                changes[-1] = _pass_through(changes[-1], kept[-1][1][-1], narrow, piece[1][0])
        kept.append(piece)
    if len(kept) > 1 and kept[-1][0][-1] - kept[-1][0][0] <= width:
        return kept[:-1], changes[:-1]
    return kept, changes


def _pass_through(
    into: SlowPoint, before: Sequence[CriticalSet], narrow: StatePiece, after: Sequence[CriticalSet]
) -> SlowPoint:
    """Name what happens where the critical sets are those of `narrow` at one z only; `into` is how they become so."""
    z, at = 0.5 * (narrow[0][0] + narrow[0][-1]), narrow[1][0]
    if _slow_kinds(before) != _slow_kinds(after):
        return _change(z, before, after)
    if len(before) > len(at) > 0:
        flattest = min(at, key=lambda C: abs(C.determinant))
        return SlowPoint("fold", z, *_location_of(flattest), None, say("along: exchange"))
    return into


def _change(z: float, before: Sequence[CriticalSet], after: Sequence[CriticalSet]) -> SlowPoint:
    """Name what happens where the critical sets `before` become `after`."""
    more = max(before, after, key=len)
    if len(before) != len(after):
        outermost = max(more, key=lambda C: float(np.hypot(*C.e)))
        if np.hypot(*outermost.e) > 1.0 - EQUATOR_DISTANCE:
            sentence = say("along: equator")
            return SlowPoint("equator", z, *_location_of(outermost), None, sentence)
        flattest = min(more, key=lambda C: abs(C.determinant))
        return SlowPoint("fold", z, *_location_of(flattest), None, say("along: fold"))
    pairs = _match_sets(before, after)
    old, new = next(((p, q) for p, q in pairs if _slow_kind(p) != _slow_kind(q)), pairs[0])
    if {_slow_kind(old).split()[0], _slow_kind(new).split()[0]} == {"stable", "unstable"}:
        return SlowPoint("Hopf", z, *_location_of(new), None, say("along: Hopf", kind=_article(_slow_kind(new))))
    return SlowPoint(
        "node-focus", z, *_location_of(new), None, say("along: node-focus", kind=_article(_slow_kind(new)))
    )


def _article(kind: str) -> str:
    return f"an {kind}" if kind.startswith("unstable") else f"a {kind}"


def _location_of(C: CriticalSet) -> tuple[tuple[float, float], tuple[float, ...]]:
    return (float(C.e[0]), float(C.e[1])), tuple(C.slow_flow.tolist())


def _match_sets(before: Sequence[CriticalSet], after: Sequence[CriticalSet]) -> list[tuple[CriticalSet, CriticalSet]]:
    """Pair the critical sets at two neighbouring z, each with the one that moved least."""
    distance = [[float(np.hypot(*(p.e - q.e))) for q in after] for p in before]
    columns = assign(np.array(distance).reshape(len(before), len(after)))
    return [(p, after[j]) for p, j in zip(before, columns, strict=True)]


def _follow(values: list[float], sets: list[tuple[CriticalSet, ...]]) -> list[SlowBranch]:
    """Follow each critical set along a piece on which their number and kinds stay."""
    chains = [[C] for C in sets[0]]
    for after in sets[1:]:
        then = dict((id(p), q) for p, q in _match_sets([chain[-1] for chain in chains], after))
        for chain in chains:
            chain.append(then[id(chain[-1])])
    branches = []
    for chain in chains:
        columns = ([C.e for C in chain], [C.p for C in chain], [C.slow_flow for C in chain])
        e, p, flow = (np.array(column) for column in columns)
        arrays = (np.array(values), e, p, flow)
        for array in arrays:
            array.flags.writeable = False
        branches.append(SlowBranch(*arrays, _slow_kind(chain[len(chain) // 2])))
    return branches


def _equilibria(line: _Line, branch: SlowBranch) -> list[SlowPoint]:
    """Zeros of the slow flow along z on one branch, to rounding."""
    flow = branch.flow[:, line.axis]
    found = []
    for i in np.flatnonzero((flow[:-1] * flow[1:] < 0.0) | ((flow[:-1] == 0.0) & (flow[1:] != 0.0))):
        if flow[i] == 0.0 and i > 0 and flow[i - 1] * flow[i + 1] >= 0.0:
            continue  # it only touches zero

        def on_branch(z: float, i: int = int(i)) -> CriticalSet:
            share = (z - branch.z[i]) / (branch.z[i + 1] - branch.z[i])
            expected = (1.0 - share) * branch.e[i] + share * branch.e[i + 1]
            return min(line(z), key=lambda C: float(np.hypot(*(C.e - expected))))

        z = float(branch.z[i])
        if flow[i] != 0.0:
            flow_at = lambda z: float(on_branch(z).slow_flow[line.axis])
            z = root_between(flow_at, z, float(branch.z[i + 1]), 1e-15)
        falling = bool(flow[i + 1] < 0.0)
        way = "attracts" if falling else "repels"
        here = on_branch(z)
        alone = not np.delete(here.slow_flow, line.axis).any()
        sentence = say(f"along: {way}") if alone else say(f"along one: {way}", z=f"z{subscript(line.axis + 1)}")
        found.append(SlowPoint("equilibrium", z, *_location_of(here), falling, sentence))
    return found


@dataclass(frozen=True, eq=False)
class SlowPlane:
    """The slow flow on every critical set over a net of two slow variables; arrays are read-only."""

    # (k, 2) (z1, z2) of each critical set found: none where Sigma is crossed, several where sliding is not unique
    z: Array
    flow: Array  # (k, m) z' on it
    stable: NDArray[np.bool_]  # (k,) Whether the layer problem attracts to it


def slow_plane(
    system: AnySystem,
    psi: Psi,
    spans: tuple[tuple[float, float], tuple[float, float]],
    rest: ArrayLike = (),
    count: int = 15,
) -> SlowPlane:
    """Slow flow, (2.29), over a net in the plane of the first two slow variables, the others at `rest` (m - 2,)."""
    if system.m < 2:
        raise ValueError(f"the system has m = {system.m} slow variable(s); a plane needs two or more.")
    others = slow_values(rest, system.m - 2)
    nets = [np.linspace(low, high, count).tolist() for low, high in spans]
    found = [(z1, z2, C) for z2 in nets[1] for z1 in nets[0] for C in critical_sets(system, psi, (z1, z2, *others))]
    z = np.array([(z1, z2) for z1, z2, _ in found]).reshape(-1, 2)
    flow = np.array([C.slow_flow for *_, C in found]).reshape(-1, system.m)
    stable = np.array([C.kind.startswith("stable") for *_, C in found], bool)
    for array in (z, flow, stable):
        array.flags.writeable = False
    return SlowPlane(z, flow, stable)


@dataclass(frozen=True, eq=False)
class DirectionsAlong:
    """Limit directions over values of one slow variable; arrays (k,) are read-only."""

    z: Array  # (k,)
    theta: Array
    lambda_rho: Array
    lambda_theta: Array


def directions_along(
    system: AnySystem, span: tuple[float, float], z: ArrayLike = (), axis: int = 0, count: int = 121
) -> DirectionsAlong:
    """Limit directions (zeros of Theta on the equator) at even values of one slow variable, about z (m,)."""
    others = slow_values(z if np.size(z) else (0.0,) * system.m, system.m)
    columns: list[tuple[float, float, float, float]] = []
    for value in np.linspace(*span, count).tolist():
        found = equator_equilibria(system, (*others[:axis], value, *others[axis + 1 :]))
        columns += [(value, *row) for row in zip(found.theta, found.lambda_rho, found.lambda_theta, strict=True)]
    arrays = np.array(columns, float).reshape(-1, 4).T.copy()
    arrays.flags.writeable = False
    return DirectionsAlong(*arrays)
