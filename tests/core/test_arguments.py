"""Wrong values at every parameter of every public function: a sentence that names the parameter, or a valid result."""

import inspect
import re
import signal
import types
from contextlib import contextmanager

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.formulas.expression import ExpressionError

SYSTEM = c2.ELinear("-2 + 0*z", 0.0, -1.0, (-0.5, 0.0), [[1, 0]], ("-z",))
PSI = c2.psi.tanh()
AT = SYSTEM.at(0.1)
PLANE = {"system": SYSTEM, "psi": PSI, "z": 0.1}
MATRIX = {"system": c2.ELinear(-2.0, 0.3, -1.0)}
BAD_MATRIX = {"system": c2.ELinear(172.0, 186.0, -200.0)}
DRIVEN = c2.System(U=("-z1 - f1*c + cos(2*z3)", "-z2 - f1*s + sin(2*z3)"), W=("x", "y", "1"), parameters={"f1": 0.5})
BLOCK = c2.mechanics.Mechanism(np.eye(2), np.eye(2), (0, 0), 0.3, 1, ("vx", "vy"))
MOTION = {"system": SYSTEM, "psi": PSI, "state0": (1.0, 0.2, 0.1), "t_span": (0.0, 0.3)}

#: For each public function, arguments with which it is quick: what is not there keeps its default.
GOOD = {
    c2.approach_outcomes: PLANE,
    c2.atlas: {**PLANE, "ranges": {"f1": (-2, 2), "f2": (-2, 2)}},
    c2.basins: {**PLANE, "n": 32},
    c2.branches: {**PLANE, "along": "f1", "span": (-0.6, -0.4)},
    c2.census: {"psi": PSI, "count": 1000},
    c2.certificates: PLANE,
    c2.classify: PLANE,
    c2.compare_laws: {"system": SYSTEM, "laws": {"tanh": (PSI, 1e-3)}, "z": 0.1},
    c2.contact_events: {"mechanism": BLOCK, "state0": (1.0, 0.2)},
    c2.critical_sets: PLANE,
    c2.delays: {**PLANE, "ranges": {"z1": (-1.0, 1.0)}},
    c2.equator_cycle: {"system": SYSTEM, "z": 0.1},
    c2.equator_equilibria: {"system": SYSTEM, "z": 0.1},
    c2.filippov_sliding: {"system": SYSTEM, "z": 0.1},
    c2.limit_cycles: PLANE,
    c2.lyapunov_exponents: {"system": DRIVEN, "psi": PSI, "state0": (0.0, -0.55, -0.28, 0.07, 0.0), "period": np.pi,
                            "count": 16, "transient": 0},
    c2.nullclines: PLANE,
    c2.response_curve: {"system": DRIVEN, "state0": (0.0, -0.55, -0.28, 0.07, 0.0), "period": np.pi,
                        "along": "f1", "span": (0.49, 0.51), "psi": PSI},
    c2.periodic_motion: {"system": SYSTEM, "psi": PSI, "state0": (1.0, 0.2, 0.1), "period": 0.3},
    c2.prove_portrait: PLANE,
    c2.separatrices: PLANE,
    c2.simulate: {**MOTION, "eps": 1e-3},
    c2.simulate_nonsmooth: MOTION,
    c2.sliding_flow: {"system": SYSTEM, "z": 0.1},
    c2.slow_portrait: {**PLANE, "along": "z1", "span": (-1.0, 1.0), "count": 11},
    c2.trajectories: {**PLANE, "seeds": [(0.2, 0.3)]},
    c2.psi.constant: {},
    c2.psi.custom: {"text": "1/(1+s)"},
    c2.psi.engine: {"name": "ipc"},
    c2.psi.engine_eps: {"name": "ipc"},
    c2.psi.exponential: {},
    c2.psi.from_text: {"text": "hill:3"},
    c2.psi.hill: {"n": 3},
    c2.psi.make: {"family": "hill", "parameter": 3.0, "text": "1/(1+s)"},
    c2.psi.rational: {},
    c2.psi.register: {"family": None},
    c2.psi.tanh: {},
    c2.psi.unregister: {"name": "nothing"},
    c2.bifurcations.closed_equator: MATRIX,
    c2.bifurcations.critical_boundary: MATRIX,
    c2.bifurcations.cycle_folds: {**BAD_MATRIX, "psi": PSI},
    c2.bifurcations.heteroclinic: {**BAD_MATRIX, "psi": PSI},
    c2.bifurcations.hill_changes: {"system": SYSTEM, "z": 0.1},
    c2.bifurcations.hopf: {**BAD_MATRIX, "psi": PSI},
    c2.bifurcations.node_focus: {**BAD_MATRIX, "psi": PSI},
    c2.bifurcations.parameter_changes: {**PLANE, "psi": c2.psi.hill(2)},
    c2.bifurcations.regions: MATRIX,
    c2.bifurcations.saddle_node: MATRIX,
    c2.examples.register: {"example": None},
    c2.examples.unregister: {"key": "nothing"},
    **{example.mechanism or example.make: {} for example in c2.examples.catalogue.values()},
    c2.mechanics.contact: {
        "M": np.eye(2), "J": np.eye(2), "force": (0.3, 0), "mu": 0.2, "normal": 1.0, "velocities": ("u", "v"),
    },
    c2.mechanics.stribeck: {"static": 0.6, "kinetic": 0.4, "speed": 0.05},
    c2.mechanics.contacts: {
        "M": np.eye(2), "contacts": [(np.eye(2), 0.2, 1.0)], "force": (0.3, 0), "velocities": ("u", "v"),
    },
    c2.mechanics.fit: {
        "system": c2.ELinear("-mu", 0.0, "-mu", parameters={"mu": 3.0}),
        "times": np.linspace(0.0, 0.1, 5),
        "velocities": np.linspace((1.0, 0.5), (0.8, 0.41), 5),
    },
    c2.hemisphere.disc_from_entry: {"epsilon_1": 0.5, "theta": 0.1},
    c2.hemisphere.disc_from_scaling: {"x2": (1.0, 2.0)},
    c2.hemisphere.e_psi: {"psi": PSI, "p": (0.1, 0.2)},
    c2.hemisphere.entry_from_scaling: {"x2": (1.0, 2.0)},
    c2.hemisphere.flow: {"coefficients": AT, "psi": PSI, "p": (0.1, 0.2)},
    c2.hemisphere.height: {"p": (0.1, 0.2)},
    c2.hemisphere.outside_flow: {"coefficients": AT, "theta": 0.1},
    c2.hemisphere.scaling_from_disc: {"p": (0.1, 0.2)},
}  # fmt: skip
SLOW = {c2.bifurcations.cycle_folds, c2.bifurcations.heteroclinic, c2.response_curve}  # seconds
LONG = {
    c2.census: ("10**9",),
    c2.periodic_motion: ("10**9", "10**30"),
    c2.response_curve: ("10**9", "10**30"),
    c2.lyapunov_exponents: ("10**9", "10**30"),
}  # right: minutes, and eight seconds each
LONGEST = 240.0  # seconds: where nothing is compiled yet, kernels are, in turn with other processes

NAN, INF = float("nan"), float("inf")
WRONG = {
    "None": None, "an object": object(), "text": "x", "no text": "", "bytes": b"1", "nan": NAN, "inf": INF,
    "-inf": -INF,
    "10**400": 10**400, "1e200": 1e200, "complex": 1j, "a class": c2.ELinear, "a function": c2.psi.tanh,
    "a builder": c2.examples.ball_in_pool, "a list of text": ["a", "b"], "nan in a list": [NAN, 1.0],
    "a ragged list": [[1, 2], [3]], "deep": np.zeros((1, 2, 3, 4)), "a dict": {"a": 1}, "a set": {1, 2},
    "-1": -1, "10**9": 10**9, "10**30": 10**30, "1.5": 1.5, "large in a list": [(1e200, 0.0)],
    "complex in a list": [1j, 2.0],
    "a Psi": PSI, "a system": SYSTEM, "5": 5,
}  # fmt: skip


def public():
    for module in (c2, *(getattr(c2, name) for name in c2.__all__ if isinstance(getattr(c2, name), types.ModuleType))):
        for name in module.__all__:
            if inspect.isfunction(getattr(module, name)):
                yield getattr(module, name)


PAIRS = [(function, name) for function in public() for name in inspect.signature(function).parameters]


@contextmanager
def bounded(seconds):
    """Stop what does not end."""

    def late(*_):
        raise AssertionError(f"no answer within {seconds} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_every_public_function_is_tried():
    assert set(public()) == set(GOOD)


@pytest.mark.parametrize(("function", "name"), PAIRS, ids=[f"{f.__name__}-{name}" for f, name in PAIRS])
def test_a_wrong_value_is_told_by_the_name_of_its_parameter(function, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a text may be the right name of a file
    for words, value in WRONG.items():
        if function in SLOW and words in ("-1", "10**9", "10**30", "1.5", "5", "a Psi"):
            continue
        if words in LONG.get(function, ()) or (name in ("draw", "progress", "events") and callable(value)):
            continue  # right ones: a function of the user fails in its own words
        told = None
        try:
            with bounded(LONGEST):
                function(**{**GOOD[function], name: value})
        except (ValueError, TypeError) as error:
            told = error
        if told is not None:
            said, called = str(told), {"parameter": "n", "events": "events?", "name": "(family|engine)"}.get(name, name)
            assert isinstance(told, ExpressionError) or re.search(rf"\b{called}\b", said), (words, said)
            assert len(said) < 400, (words, said)
            assert said.endswith((".", "…", "?")), (words, said)


@pytest.mark.parametrize("function", list(public()), ids=lambda f: f.__name__)
def test_wrong_names_and_counts_of_arguments_are_told(function):
    for given, named in (((), {"nonsense": 1}), ((1,) * 40, {})):
        with pytest.raises(TypeError, match=function.__name__):
            function(*given, **named)


def test_what_is_given_rightly_is_not_refused():
    for words, value in (
        ("integer", 1),
        ("NumPy float", np.float64(0.5)),
        ("NumPy int", np.int64(1)),
        ("a string", (0.1,)),
    ):
        assert c2.classify(SYSTEM, PSI, value).name, words
    assert c2.trajectories(SYSTEM, PSI, np.array([[0.1, 0.2]]), [0.1], t_max=np.float32(1.0)).points
    assert c2.simulate_nonsmooth(SYSTEM, [1, 0, 0], [0, 1]).phases
    assert c2.approach_outcomes(SYSTEM, PSI, 0.1, compare=[PSI]) is not None


CLASSES = {
    "a": lambda v: c2.ELinear(v, 0.0, -1.0),
    "f": lambda v: c2.ELinear(-1.0, 0.0, -1.0, v),
    "B": lambda v: c2.ELinear(-1.0, 0.0, -1.0, B=v),
    "parameters of an ELinear": lambda v: c2.ELinear(-1.0, 0.0, -1.0, parameters=v),
    "A": c2.ELinear.from_matrix,
    "U": lambda v: c2.System(U=v),
    "W": lambda v: c2.System(U=("c", "s"), W=v),
    "parameters of a System": lambda v: c2.System(U=("c", "s"), parameters=v),
    "definitions": lambda v: c2.System(U=("c", "s"), definitions=v),
    "system of a Scene": lambda v: c2.Scene(v, PSI),
    "psi of a Scene": lambda v: c2.Scene(AT, v),
    "z of a Scene": lambda v: c2.Scene(SYSTEM, PSI, v),
    "an Event": c2.Event,
}


@pytest.mark.parametrize("make", CLASSES.values(), ids=list(CLASSES))
def test_classes_tell_wrong_values_too(make):
    for words, value in WRONG.items():
        said = "."
        try:
            with bounded(LONGEST):
                make(value)
        except (ValueError, TypeError) as error:
            said = str(error)
        assert len(said) < 600, (words, said)


PLAIN = c2.ELinear(-1.0, 0.0, -1.5, (-0.3, 0.0))
SIZES = {
    "trajectories, pixel": lambda v: c2.trajectories(PLAIN, c2.psi.tanh(), [[0.1, 0.2], [1.2, 0.0]], pixel=v),
    "trajectories, view": lambda v: c2.trajectories(PLAIN, c2.psi.tanh(), [[0.1, 0.2], [1.2, 0.0]], view=v),
    "trajectories, t_max": lambda v: c2.trajectories(PLAIN, c2.psi.tanh(), [[0.1, 0.2], [1.2, 0.0]], t_max=v),
    "trajectories, seeds": lambda v: c2.trajectories(PLAIN, c2.psi.tanh(), [[v, 0.2]]),
    "separatrices, pixel": lambda v: c2.separatrices(PLAIN, c2.psi.tanh(), pixel=v),
    "separatrices, tolerance": lambda v: c2.separatrices(PLAIN, c2.psi.tanh(), tolerance=v),
    "nullclines, view": lambda v: c2.nullclines(PLAIN, c2.psi.tanh(), view=v),
    "scene, pixel": lambda v: c2.Scene(PLAIN, c2.psi.tanh(), pixel=v)["separatrices"],
    "scene, view": lambda v: c2.Scene(PLAIN, c2.psi.tanh(), view=v)["nullclines_outside"],
    "scene, count": lambda v: c2.Scene(PLAIN, c2.psi.tanh(), count=v)["inside"],
    "simulate, eps": lambda v: c2.simulate(PLAIN, c2.psi.tanh(), (0.1, 0.2), (0.0, 1.0), eps=v),
    "simulate, time": lambda v: c2.simulate(PLAIN, c2.psi.tanh(), (0.1, 0.2), (0.0, v), eps=1e-3),
    "simulate_nonsmooth, time": lambda v: c2.simulate_nonsmooth(PLAIN, (0.1, 0.2), (0.0, v)),
    "hill": lambda v: c2.limit_cycles(c2.presets["case3-n2"].system, c2.psi.hill(v)),
    "basins": lambda v: c2.basins(PLAIN, c2.psi.tanh(), n=v),
    "slow_portrait": lambda v: c2.slow_portrait(c2.examples.nonunique_sliding(), c2.psi.tanh(), "z1", (-v, v)),
    "psi": c2.psi.tanh(),
    "psi.modulus": c2.psi.tanh().modulus,
    "psi.radius": c2.psi.tanh().radius,
}


@pytest.mark.parametrize("name", SIZES)
@pytest.mark.parametrize(
    "size",
    [1e-300, 1e99, -1e99, np.nan, np.inf, 10**18, 10**400],
    ids=["tiny", "1e99", "-1e99", "nan", "inf", "1e18", "beyond"],
)
def test_a_size_without_measure_is_answered_or_refused_in_one_sentence(name, size):
    told = "."
    with bounded(LONGEST):
        try:
            SIZES[name](size)
        except ValueError as error:
            told = str(error)
    assert len(told) < 300
    assert told.endswith((".", "…", "?"))
