"""The conditions R1 to R5 of Definition 2.3: by mathematics for the built-in families, by probing for typed text."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ...formulas.expression import Expression, parse
from .condition import Condition, PsiCheck
from .families.record import VECTOR, Family, Kernel
from .typed import NEGLIGIBLE, PROBES, Array, first_not_positive, refine

PROBED = "as far as probing s from 0 to 1e16 can tell"
# exp(-s) and its like: beyond some s a formula of size 1 is rounding only
VALUE_ROUNDING = 1e-11
JUST_BEFORE = 1e-6  # of the s at which |e_Psi| reaches 1: so far before it a derivative is read


@lru_cache(maxsize=64)
def check(family: Family, parameter: float, text: str, expression: Expression | None, kernel: Kernel) -> PsiCheck:
    """Decide the five conditions for one Psi; see `Psi.check`."""
    if expression is not None:
        return _probe(expression, kernel)
    found = {
        "R1": Condition("R1", True, None, f"Ψ = {text} is smooth for all s ≥ 0."),
        "R2": Condition("R2", True, None, "Ψ(0) = 1."),
        "R3": Condition("R3", True, None, "Ψ(s) > 0 for all s ≥ 0."),
        "R4": Condition("R4", True, None, "Ψ′(s) ≤ 0 for all s ≥ 0."),
        "R5": Condition("R5", True, None, f"Ψ(1/s) is smooth down to s = 0, where it is {kernel.limit:g}."),
    }
    if family.broken is not None:
        found |= {condition.name: condition for condition in family.broken(parameter, text)}
    return PsiCheck(**found)


def _probe(expression: Expression, kernel: Kernel) -> PsiCheck:
    derivatives = [expression]
    for _ in range(4):
        try:
            derivatives.append(derivatives[-1].derivative("s"))
        except ValueError:  # too long to differentiate again
            break
    values = kernel.value(VECTOR, PROBES)
    scale = _scale(values, kernel.limit)
    return PsiCheck(
        _smooth(derivatives, values, scale, kernel.saturation),
        _starts_at_one(float(values[0])),
        _check_positivity(expression, values, kernel.saturation),
        _never_rises(derivatives[1], values, kernel.saturation),
        _smooth_at_infinity(expression, kernel, 1.0 / scale),
    )


def _scale(values: Array, limit: float) -> float:
    """Find the s at which Psi has gone half its way, which sets the scale of every probe near 0 and infinity."""
    if not math.isfinite(limit):
        return 1.0
    way = np.abs(values - limit)
    half = way <= 0.5 * way[0]
    return float(PROBES[int(np.argmax(half))]) if half.any() and not half[0] else 1.0


def _starts_at_one(value: float) -> Condition:
    if abs(value - 1.0) <= 1e-12:
        return Condition("R2", True, None, "Ψ(0) = 1.")
    mend = f"dividing Ψ by {value:.6g} mends it" if value > 0.0 else "it must be positive"
    return Condition("R2", False, 0.0, f"Ψ(0) = {value:.6g}, not 1; {mend}.")


def _check_positivity(expression: Expression, values: Array, saturation: float) -> Condition:
    if saturation < math.inf:
        return Condition(
            "R3", False, saturation,
            f"Ψ reaches 0 at s = {saturation:.6g} and stays there: |e_Ψ| = 1 from ζ = {math.sqrt(saturation):.6g} on. "
            "e_Ψ is one-to-one, and D e_Ψ invertible, inside that circle only; outside it the layer problem is the "
            "nonsmooth system.",
        )  # fmt: skip
    place = first_not_positive(expression, values)
    if place is None:
        return Condition("R3", True, None, f"Ψ(s) > 0, {PROBED}.")
    return Condition("R3", False, place, f"Ψ(s) ≤ 0 at s = {place:.6g}.")


def _never_rises(rate: Expression, values: Array, saturation: float) -> Condition:
    scale = float(np.max(np.abs(values)))

    def falls(s: Array) -> Array:
        # a change of relative size ROUNDING over the scale s + 1 is rounding
        slope = rate.evaluate({"s": s})
        return ~(slope * (1.0 + s) > VALUE_ROUNDING * scale) | (s >= saturation)

    good = falls(PROBES)
    if good.all():
        return Condition("R4", True, None, f"Ψ′(s) ≤ 0, {PROBED}.")
    i = int(np.argmin(good))
    # a sign change, so refined by the sign alone
    where = 0.0
    if i:
        where = refine(lambda s: not rate.evaluate({"s": s}) > 0.0, float(PROBES[i - 1]), float(PROBES[i]))
    slope = rate.evaluate({"s": float(PROBES[i])})
    return Condition(
        "R4", False, where,
        f"Ψ rises from s = {where:.6g} on (Ψ′ = {slope:.3g} at s = {PROBES[i]:.6g}). "
        "D e_Ψ keeps a positive determinant, but a critical set may lose the properties proved for falling Ψ.",
    )  # fmt: skip


def _smooth(derivatives: list[Expression], values: Array, scale: float, saturation: float) -> Condition:
    for order, expression in enumerate(derivatives):
        # an infinite value, or 0/0 in a formula such as cosh(sqrt(s)), which is smooth all the same
        if not math.isfinite(expression.evaluate({"s": 0.0})) and _diverges(expression, order, scale):
            return _rough(0.0, order, "is not finite")
    for order, expression in enumerate(derivatives[:4]):
        place = _jump(expression, values, scale * _NEAR[order][0])
        if place is not None:
            return _rough(place, order, "jumps or is undefined")
        before = derivatives[order].evaluate({"s": (1.0 - JUST_BEFORE) * saturation}) if saturation < math.inf else 0.0
        if abs(before) * saturation**order > math.sqrt(JUST_BEFORE):
            return _rough(saturation, order, "jumps")
    return Condition("R1", True, None, f"Ψ is smooth, {PROBED}.")


def _rough(s: float, order: int, what: str) -> Condition:
    which = "Ψ" if order == 0 else f"the derivative of order {order}"
    return Condition("R1", False, s, f"Ψ is not smooth at s = {s:.6g}: {which} {what} there.")


def _jump(expression: Expression, values: Array, least: float) -> float | None:
    """Return where a function jumps, or None: the ten steepest cells are bisected towards the larger change."""
    keep = np.isfinite(values) & (values > NEGLIGIBLE * PROBES) & (least <= PROBES)
    s = PROBES[keep]
    if not len(s):  # where it matters at all is below the probes
        return None
    y = expression.evaluate({"s": s})
    # formulas of large s may overflow in their higher derivatives: inf/inf up to the end says nothing
    defined = np.isfinite(y)
    end = len(y) - int(np.argmax(defined[::-1]))
    s, y = s[:end], y[:end]
    if len(s) < 3:
        return None
    undefined = ~np.isfinite(y)
    if undefined.any():
        return float(s[int(np.argmax(undefined))])
    change = np.abs(np.diff(y))
    size = float(np.max(np.abs(y * (1.0 + s)), initial=0.0))
    # steep against the neighbouring cells: a smooth function on this dense grid never is by much
    neighbours = np.maximum(np.append(change[1:], 0.0), np.append(0.0, change[:-1]))
    steep = change * (1.0 + s[1:]) > 1e-9 * size
    cells = np.argsort(np.where(steep, change / (neighbours + 1e-300), 0.0))[-10:]
    lo, hi, y_lo, y_hi = s[cells], s[cells + 1], y[cells], y[cells + 1]
    first = change[cells]
    for _ in range(60):
        middle = 0.5 * (lo + hi)
        inside = (middle > lo) & (middle < hi)
        if not inside.any():
            break
        y_mid = expression.evaluate({"s": middle})
        if not np.isfinite(y_mid).all():
            return float(middle[~np.isfinite(y_mid)][0])
        left = np.abs(y_mid - y_lo) >= np.abs(y_hi - y_mid)
        up, down = inside & ~left, inside & left
        lo, hi = np.where(up, middle, lo), np.where(down, middle, hi)
        y_lo, y_hi = np.where(up, y_mid, y_lo), np.where(down, y_mid, y_hi)
    last = np.abs(y_hi - y_lo)
    jumps = steep[cells] & (last > 1e-3 * first) & (last > 1e-9 * size / (1.0 + hi))
    return float(np.min(hi[jumps])) if jumps.any() else None


def _smooth_at_infinity(expression: Expression, kernel: Kernel, scale: float) -> Condition:
    """R5 by the growth of derivatives of Ψ(1/σ) as σ falls to 0: a bounded one grows by no power of 1/σ."""
    if kernel.saturation < math.inf:
        return Condition("R5", True, None, "Ψ(1/s) is 0 near s = 0.")
    limit = kernel.limit
    late = expression.evaluate({"s": PROBES[PROBES >= 1e12]})
    known = math.isfinite(expression.evaluate({"s": math.inf}))  # 1/(1+log(1+s)) tends to 0, though slowly
    if not math.isfinite(limit) or (not known and float(np.ptp(late)) > 1e-3 * max(float(np.max(late)), 1e-6)):
        return Condition("R5", False, math.inf, "Ψ(s) has no finite limit as s grows, as far as s = 1e16 can tell.")
    inverse = expression.substitute("s", parse("1/s", ("s",)))
    for order in (1, 2, 3):
        try:
            inverse = inverse.derivative("s")
        except ValueError:
            break
        if _diverges(inverse, order, scale):
            return Condition(
                "R5", False, math.inf,
                f"Ψ(s) tends to {limit:.6g} as s grows, but Ψ(1/s) is not smooth at s = 0: "
                f"its derivative of order {order} grows without bound.",
            )  # fmt: skip
    return Condition("R5", True, None, f"Ψ(1/s) is smooth down to s = 0, where it is {limit:.6g}, {PROBED}.")


# Higher derivatives cancel more digits, so they are read less near to 0.
_NEAR = {0: (1e-12, 1e-8), 1: (1e-9, 1e-5), 2: (1e-5, 1e-3), 3: (1e-4, 1e-2), 4: (1e-3, 1e-1)}


def _diverges(expression: Expression, order: int, scale: float) -> bool:
    """Whether a derivative of this order grows without bound as its argument falls to 0."""
    near, far = _NEAR[order]
    sizes = np.abs(expression.evaluate({"s": scale * np.geomspace(near, far, 9)})) * scale**order
    if not np.isfinite(sizes).all():
        return bool(np.isinf(sizes[:3]).any())
    low, high = float(np.median(sizes[:3])), float(np.median(sizes[-3:]))
    decades = math.log10(far / near) * 6.0 / 8.0
    return low > 1e-6 and low > high * 10.0 ** (0.05 * decades) and _keeps_growing(sizes)


def _keeps_growing(sizes: Array) -> bool:
    """Whether the growth towards σ = 0 (the first entry) has not levelled off."""
    with np.errstate(all="ignore"):
        steps = np.diff(np.log(sizes))
    return bool(steps[0] < 0.0 and steps[:2].mean() < min(0.5 * steps[-2:].mean(), -1e-3))
