"""Everyone's way to carry 64 seeds to T: ours, SciPy, Numba-LSODA, diffrax, heyoka, on the same formulas.

A method is ``prepare(problem) -> run(tolerance) -> p at T, (64, 2)``; compiling belongs to prepare, or to the first
run. What is not installed raises ImportError, and the report says so.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.integrate import solve_ivp
from scipy.sparse import block_diag

from codim2_core.portrait.orbits.trajectories import trajectories

from .problems import COUNT, Problem, slow

Array = np.ndarray
Run = Callable[[float], Array]
LANES = 8  # of heyoka: one AVX-512 register
ALONE = 4  # SciPy one trajectory at a time: so many are run, and the time multiplied


@dataclass(frozen=True)
class Method:
    """One competitor."""

    name: str
    prepare: Callable[[Problem], Run]
    tolerances: tuple[float, ...]  # from loose to tight
    share: float = 1.0  # part of the work that a run does; its time is divided by it


def powers(*exponents: int) -> tuple[float, ...]:
    """10^-k."""
    return tuple(10.0**-k for k in exponents)


def ours(problem: Problem) -> Run:
    """The compiled stepping, without early ends."""
    at = problem.system.at(slow(problem))

    def run(tolerance: float) -> Array:
        options = {"t_max": problem.t_end, "rtol": tolerance, "atol": max(tolerance, 1e-15), "capture": 1e-15}
        return trajectories(at, problem.psi, problem.seeds, samples="ends", **options).ends[:, :2]

    return run


def _scope(module: object, positive: Callable) -> dict[str, object]:
    return {name: getattr(module, name) for name in ("sqrt", "exp", "tanh", "sin", "cos")} | {"positive": positive}


def _function(problem: Problem, scope: dict[str, object]) -> Callable:
    exec(problem.text(problem.polar), scope)
    return scope["field"]  # type: ignore[return-value]


def _array_field(problem: Problem) -> Callable[[float, Array], Array]:
    """The field of NumPy arrays, of all components of each trajectory one after the other (narrow bands)."""
    field = _function(problem, _scope(np, lambda h: np.maximum(h, 1e-300)))
    P = problem.numbers

    def right(t: float, q: Array) -> Array:
        q = q.reshape(-1, 2)
        out = np.empty_like(q)
        out[:, 0], out[:, 1] = field(*q.T, P)
        return out.ravel()

    return right


def _scalar_field(problem: Problem) -> Callable[[float, Array], tuple[float, ...] | Array]:
    """The field of floats: the fastest that Python has for one trajectory."""
    field = _function(problem, _scope(math, lambda h: max(h, 1e-300)))
    careful, P = _array_field(problem), problem.numbers

    def right(t: float, q: Array) -> tuple[float, ...] | Array:
        try:
            return field(*q.tolist(), P)
        except (ArithmeticError, ValueError):  # Python raises where IEEE arithmetic goes on
            with np.errstate(all="ignore"):
                return careful(t, q)

    return right


def _absolute(problem: Problem, tolerance: float) -> Array:
    """Return atol of both variables: that of ebar is below its size, which starts at 1e-6."""
    return np.array([tolerance, 1e-4 * tolerance if problem.polar else tolerance])


def stacked(method: str) -> Callable[[Problem], Run]:
    """One solve_ivp for all trajectories; implicit methods are told of the blocks."""

    def prepare(problem: Problem) -> Run:
        right, start = _array_field(problem), problem.start
        options: dict[str, object] = {}
        if method == "Radau":
            options["jac_sparsity"] = block_diag([np.ones((2, 2))] * COUNT, format="csc")
        if method == "LSODA":
            options |= {"lband": 1, "uband": 1}

        def run(tolerance: float) -> Array:
            atol = np.tile(_absolute(problem, tolerance), COUNT)
            with np.errstate(all="ignore"):
                done = solve_ivp(
                    right, (0.0, problem.t_end), start.ravel(), method=method, rtol=max(tolerance, 3e-14), atol=atol,
                    **options,
                )  # fmt: skip
            return problem.disc(done.y[:, -1].reshape(COUNT, 2))

        return run

    return prepare


def alone(method: str) -> Callable[[Problem], Run]:
    """One solve_ivp for each trajectory: four of the 64, the others filled in by their exact ends."""

    def prepare(problem: Problem) -> Run:
        right, start, end = _scalar_field(problem), problem.start, problem.end
        chosen = range(0, COUNT, COUNT // ALONE)

        def run(tolerance: float) -> Array:
            result = end.copy()
            for i in chosen:
                done = solve_ivp(
                    right, (0.0, problem.t_end), start[i], method=method, rtol=max(tolerance, 3e-14),
                    atol=_absolute(problem, tolerance),
                )  # fmt: skip
                result[i] = problem.disc(done.y[:, -1:].T)[0]
            return result

        return run

    return prepare


@lru_cache(maxsize=64)
def _cfunc(text: str) -> object:
    import numba
    from numbalsoda import lsoda_sig

    scope = _scope(math, numba.njit(lambda h: max(h, 1e-300)))
    exec(text, scope)
    scope["inner"] = numba.njit(error_model="numpy")(scope["field"])
    lines = ["def right(t, u, du, data):", "    du[0], du[1] = inner(u[0], u[1], carray(data, (6,)))"]
    scope["carray"] = numba.carray
    exec("\n".join(lines), scope)
    return numba.cfunc(lsoda_sig)(scope["right"])


@lru_cache(maxsize=1)
def _lsoda_loop() -> Callable:
    import numba
    from numbalsoda import lsoda

    @numba.njit
    def loop(address, start, times, data, rtol, atol):
        result = np.empty((len(start), 2))
        for i in range(len(start)):
            u, _ = lsoda(address, start[i].copy(), times, data, rtol=rtol, atol=atol, mxstep=100000)
            result[i] = u[-1, :2]
        return result

    return loop


def numba_lsoda(problem: Problem) -> Run:
    """numbalsoda: LSODA in C++, the field and the loop over trajectories compiled by Numba."""
    function, loop = _cfunc(problem.text(problem.polar)), _lsoda_loop()
    start, times, data = problem.start, np.array([0.0, problem.t_end]), np.array(problem.numbers)

    def run(tolerance: float) -> Array:
        # one atol for all components: that of ebar where it is followed
        atol = tolerance * (1e-4 if problem.polar else 1.0)
        return problem.disc(loop(function.address, start, times, data, tolerance, atol))

    return run


@lru_cache(maxsize=64)
def _jax_solver(text: str, family: str) -> Callable:
    os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1")
    import diffrax
    import jax

    jax.config.update("jax_enable_x64", True)
    import jax.numpy as jnp

    scope = _scope(jnp, lambda h: jnp.maximum(h, 1e-300))
    exec(text, scope)
    field = scope["field"]

    def right(t, q, P):
        return jnp.stack(field(q[0], q[1], P))  # type: ignore[operator]

    def solve(seed, t_end, P, rtol, atol):
        done = diffrax.diffeqsolve(
            diffrax.ODETerm(right), getattr(diffrax, family)(), 0.0, t_end, None, seed, args=P,
            stepsize_controller=diffrax.PIDController(rtol=rtol, atol=atol), saveat=diffrax.SaveAt(t1=True),
            max_steps=20_000, adjoint=diffrax.ForwardMode(), throw=False,
        )  # fmt: skip
        return done.ys[0]

    return jax.jit(jax.vmap(solve, in_axes=(0, None, None, None, None)))


def diffrax(family: str) -> Callable[[Problem], Run]:
    """diffrax: vmap over trajectories, jit, float64; coefficients are arguments, so that a field compiles once."""

    def prepare(problem: Problem) -> Run:
        solver = _jax_solver(problem.text(problem.polar), family)
        start, P = problem.start, np.array(problem.numbers)

        def run(tolerance: float) -> Array:
            atol = _absolute(problem, tolerance)
            return problem.disc(np.asarray(solver(start, problem.t_end, P, tolerance, atol)))

        return run

    return prepare


def heyoka(batch: bool) -> Callable[[Problem], Run]:
    """heyoka: Taylor's method, compiled for each tolerance; its numbers are constants of the code."""

    def prepare(problem: Problem) -> Run:
        import heyoka as hy

        variables = hy.make_vars("x", "y")
        right = _function(problem, _scope(hy, lambda h: h))(*variables, problem.numbers)
        system = list(zip(variables, [hy.expression(part) for part in right], strict=True))
        start, width = problem.start, LANES if batch else 1
        shape = (2, LANES) if batch else (2,)
        made: dict[float, object] = {}

        def run(tolerance: float) -> Array:
            if tolerance not in made:
                make = hy.taylor_adaptive_batch if batch else hy.taylor_adaptive
                made[tolerance] = make(system, np.zeros(shape), tol=tolerance)
            solver = made[tolerance]
            result = np.empty((COUNT, 2))
            for k in range(0, COUNT, width):
                if batch:
                    solver.set_time(0.0)
                    solver.state[:] = start[k : k + width].T
                    solver.propagate_until(problem.t_end)
                    result[k : k + width] = solver.state.T
                else:
                    solver.time = 0.0
                    solver.state[:] = start[k]
                    solver.propagate_until(problem.t_end)
                    result[k] = solver.state
            return problem.disc(result)

        return run

    return prepare


OURS = Method("ours", ours, (*powers(*range(2, 14)), 1e-14))
METHODS = (
    Method("SciPy RK45, alone", alone("RK45"), powers(3, 5, 7, 9, 11), ALONE / COUNT),
    Method("SciPy DOP853, alone", alone("DOP853"), powers(3, 5, 7, 9, 11, 13), ALONE / COUNT),
    Method("SciPy LSODA, alone", alone("LSODA"), powers(4, 6, 8, 10, 12), ALONE / COUNT),
    Method("SciPy Radau, alone", alone("Radau"), powers(3, 5, 7, 9), ALONE / COUNT),
    Method("SciPy RK45, stacked", stacked("RK45"), powers(3, 5, 7, 9, 11)),
    Method("SciPy DOP853, stacked", stacked("DOP853"), powers(3, 5, 7, 9, 11, 13)),
    Method("SciPy LSODA, stacked", stacked("LSODA"), powers(4, 6, 8, 10, 12)),
    Method("SciPy Radau, stacked", stacked("Radau"), powers(3, 5, 7)),
    Method("numbalsoda", numba_lsoda, powers(2, 4, 6, 8, 10, 12, 13)),
    Method("diffrax Tsit5", diffrax("Tsit5"), powers(2, 4, 6, 8, 10)),
    Method("diffrax Dopri8", diffrax("Dopri8"), powers(2, 4, 6, 8, 10, 12, 13)),
    Method("heyoka, single", heyoka(False), powers(2, 8, 15)),
    Method("heyoka, batch of 8", heyoka(True), powers(1, 4, 8, 12, 15)),
)
QUICK = ("SciPy DOP853, stacked", "SciPy LSODA, alone", "numbalsoda", "diffrax Dopri8", "heyoka, batch of 8")
