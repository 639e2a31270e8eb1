"""The gain of Psi compiled: ``e_Psi = gain p``, ``gain = 1/sqrt(|p|^2 + w^2 Psi(|p|^2/w^2))``, (2.19).

Outside, where w is rho, ``gain = 1/|p|``. A family brings its gain as a plain function of scalars (`Family.gain`). It
is inlined into the fields of e-linear systems, and made into a function of all lanes at an address, which the field
of general systems calls. The formula of a typed Psi is interpreted.

Everything is free of branches and of library calls, so that it runs in vector registers.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ...formulas.jit import (
    SCRATCH_SIZE,
    ahead,
    bits_of_double,
    carray,
    compile_address,
    compile_with_gain,
    contracted_kernel,
    double_of_bits,
    inlined_fast_kernel,
    scratch,
)
from ...formulas.packed import BOUND, ROWS, at_address, result, row, run_packed
from ...systems.psi.families.record import UNDERFLOW_BOUND
from ...systems.psi.function import Psi
from .layout import (
    LANES,
    PARAMETERS,
    PSI,
    ROW_WIDTH,
    SIDE_SIGN,
)

LOG2_E, LN2_HIGH, LN2_LOW = 1.4426950408889634, 0.6931471803691238, 1.9082149292705877e-10


@contracted_kernel
def expm1(x):
    """exp(x) - 1 to an ulp or two, |x| <= 700: Cody and Waite's reduction, a Taylor polynomial on |r| <= ln(2)/2."""
    k = math.floor(x * LOG2_E + 0.5)
    r = (x - k * LN2_HIGH) - k * LN2_LOW
    q = 1.0 / 6227020800.0
    q = q * r + 1.0 / 479001600.0
    q = q * r + 1.0 / 39916800.0
    q = q * r + 1.0 / 3628800.0
    q = q * r + 1.0 / 362880.0
    q = q * r + 1.0 / 40320.0
    q = q * r + 1.0 / 5040.0
    q = q * r + 1.0 / 720.0
    q = q * r + 1.0 / 120.0
    q = q * r + 1.0 / 24.0
    q = q * r + 1.0 / 6.0
    q = q * r + 0.5
    scale = double_of_bits((int(k) + 1023) << 52)
    return scale * (q * r * r + r) + (scale - 1.0)


@contracted_kernel
def log(x):
    """Natural logarithm of a normal positive double, to an ulp or two: 2 artanh((m - 1)/(m + 1)) and the exponent."""
    # Shifting by the bits of 1/sqrt(2) makes the mantissa m fall in [1/sqrt(2), sqrt(2)).
    bits = bits_of_double(x)
    exponent = (bits - 0x3FE6A09E667F3BCD) >> 52
    m = double_of_bits(bits - (exponent << 52))
    k = float(exponent)
    f = (m - 1.0) / (m + 1.0)
    g = f * f
    q = 1.0 / 23.0
    q = q * g + 1.0 / 21.0
    q = q * g + 1.0 / 19.0
    q = q * g + 1.0 / 17.0
    q = q * g + 1.0 / 15.0
    q = q * g + 1.0 / 13.0
    q = q * g + 1.0 / 11.0
    q = q * g + 1.0 / 9.0
    q = q * g + 1.0 / 7.0
    q = q * g + 1.0 / 5.0
    q = q * g + 1.0 / 3.0
    return k * LN2_HIGH + (2.0 * f + (2.0 * f * g * q + k * LN2_LOW))


@inlined_fast_kernel
def arguments(S, P, lane):
    """``|p|^2`` and ebar (0 outside) in one lane: what a gain depends on."""
    x, y = S[lane], S[lane + LANES]
    return x * x + y * y, S[lane + 2 * LANES] * (0.5 - 0.5 * P[lane + SIDE_SIGN])


def _unit_gain(r2, w, parameter):  # noqa: ARG001 (a gain is called with all three)
    return 1.0


# What a function of all lanes calls; `Variant.make` puts a family's own in their place.
gain, kind = _unit_gain, float


@inlined_fast_kernel
def _shape_argument(T, r2, w2):
    """Return the s at which a typed Psi is evaluated; 0 from where it is lost or has saturated."""
    return r2 / w2 if r2 < T[BOUND] * w2 else 0.0


@inlined_fast_kernel
def _gain_of_shape(T, r2, w2, psi):
    """Return the gain from a value of a typed Psi; that of the nonsmooth field where the formula leaves R1."""
    shape = w2 * psi
    if not (r2 < T[BOUND] * w2 and 0.0 <= shape < math.inf):
        shape = 0.0
    return 1.0 / math.sqrt(max(r2 + shape, UNDERFLOW_BOUND))


def typed_gain(r2, w, parameter):
    """Return the gain of a typed Psi, whose parameter is the address of its packed formula."""
    T, R = at_address(int(parameter)), scratch()
    row(R, 0, 1, 1)[0] = _shape_argument(T, r2, w * w)
    run_packed(T, R, 1, 1)
    return _gain_of_shape(T, r2, w * w, result(T, R, 0, 1, 1)[0])


@inlined_fast_kernel
def write_typed_gains(state, out, parameters, address):
    """Write the gains of a typed Psi, whose packed formula is at an address, in all lanes."""
    T, R = at_address(int(address)), scratch()
    width = min(LANES, SCRATCH_SIZE // int(T[ROWS]))
    for block in range((LANES + width - 1) // width):
        first = block * width
        count = min(width, LANES - first)
        S, D = carray(ahead(state, first), (ROW_WIDTH,)), carray(ahead(out, first), (count,))
        P = carray(ahead(parameters, first), (SIDE_SIGN + LANES,))
        s, psi = row(R, 0, width, count), result(T, R, 0, width, count)
        for j in range(count):
            r2, w = arguments(S, P, j)
            s[j] = _shape_argument(T, r2, w * w)
        run_packed(T, R, width, count)
        for j in range(count):
            r2, w = arguments(S, P, j)
            D[j] = _gain_of_shape(T, r2, w * w, psi[j])


@dataclass(frozen=True)
class GainVariant:
    """The compiled code of a Psi: one for a family, two with `Family.gain_whole`."""

    key: Callable[..., Any]  # the gain as its family gives it; `typed_gain` of a formula
    whole: bool = False  # the parameter is read as an int
    cached: bool = False  # the disk cache holds it: so for the families of this package

    def make(self, lanes: Callable[..., None]) -> Any:
        """Compile a function of all lanes, which calls ``gain(r2, w, kind(P[PSI]))``, with this gain in its place."""
        # next to math's, these run in vector registers
        return compile_with_gain(lanes, self.key, self.whole, self.cached, expm1=expm1, log=log)


ONE = GainVariant(_unit_gain, cached=True)  # of Psi = 1 where the sphere |p|^2 + w^2 = 1 is kept to


def variant(psi: Psi, smooth: bool, whole: bool = True) -> GainVariant:
    """Say what is compiled for a Psi."""
    record = psi.record
    if record.identity and smooth:
        return ONE
    if record.gain is None:
        return GainVariant(typed_gain, cached=True)
    whole = whole and record.uses_gain_whole(psi.parameter)
    key = record.gain_whole if whole and record.gain_whole is not None else record.gain
    return GainVariant(key, whole, cached=key.__module__.startswith(__name__.split(".")[0] + "."))


def gain_parameter(psi: Psi) -> float:
    """Return the parameter of Psi as its gain reads it: of a typed one the address of its formula, which Psi keeps."""
    return float(psi.packed.ctypes.data) if psi.record.gain is None else psi.parameter


class GainVariants:
    """The compiled variants of a function of all lanes."""

    def __init__(self, lanes: Callable[..., None], typed: Callable[..., None] | None = None) -> None:
        self._lanes, self._typed_lanes = lanes, typed
        self._made: dict[GainVariant, Any] = {}

    def __contains__(self, asked: GainVariant) -> bool:
        return asked.cached or asked in self._made

    def get(self, asked: GainVariant) -> Any:
        """Return a variant, compiling it or loading it from the disk cache the first time."""
        found = self._made.get(asked)
        if found is None:
            typed = self._typed_lanes if asked.key is typed_gain else None
            found = self._made[asked] = asked.make(self._lanes) if typed is None else compile_address(typed)
        return found


def _gains(state, out, parameters):
    S, D, P = carray(state, (ROW_WIDTH,)), carray(out, (ROW_WIDTH,)), carray(parameters, (PARAMETERS,))
    parameter = kind(P[PSI])
    for lane in range(LANES):
        r2, w = arguments(S, P, lane)
        D[lane] = gain(r2, w, parameter)


def _typed_gains(state, out, parameters):
    write_typed_gains(state, out, parameters, carray(parameters, (PARAMETERS,))[PSI])


_compiled = GainVariants(_gains, _typed_gains)


def gains(psi: Psi, smooth: bool) -> Any:
    """Return the compiled gain of all lanes, whose `address` a general system's field calls."""
    return _compiled.get(variant(psi, smooth))


def _one_gain(state, out, parameters):
    S, D, P = carray(state, (2,)), carray(out, (1,)), carray(parameters, (PARAMETERS,))
    D[0] = gain(S[0], S[1], kind(P[PSI]))


_compiled_one = GainVariants(_one_gain)


def one_gain(psi: Psi) -> Any:
    """Return the compiled gain at one place: by its `address`, from (|p|^2, w)."""
    return _compiled_one.get(variant(psi, False))
