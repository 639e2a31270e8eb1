"""General systems: what is read, frozen and differentiated, and that hostile text is refused quickly, nothing run."""

import pickle
import subprocess
import sys

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.formulas.expression import ExpressionError, parse
from codim2_core.systems.reading import LONGEST_KEY
from codim2_core.systems.typed import MOST_NAMES, MOST_NUMBERS, System
from tests.work import calls

CUBIC = ("-c*(c - chi(z)/2)*(c + chi(z)/2)", "-s/2")
CHI = {"chi(z)": "(1 + 2*z**2)/(1 + z**2)"}
inside = st.tuples(st.floats(-0.7, 0.7), st.floats(-0.7, 0.7))


def test_values_at_a_point():
    at = System(U=("2*c**2 - c - 1/2 + k*x", "-s*z2"), W=("-z", "c*y"), parameters={"k": 3}).at((0.5, 2.0))
    np.testing.assert_allclose(at.U((0.6, 0.8)), [0.72 - 0.6 - 0.5, -1.6], rtol=1e-15)
    np.testing.assert_allclose(at.U((0.6, 0.8), (2.0, 1.0)), [0.72 - 0.6 - 0.5 + 6.0, -1.6], rtol=1e-15)
    np.testing.assert_allclose(at.W((0.6, 0.8), (2.0, 1.5)), [-0.5, 0.9], rtol=1e-15)
    assert at.U(np.zeros((4, 3, 2))).shape == (4, 3, 2)
    assert at.DU(np.zeros((4, 3, 2))).shape == (4, 3, 2, 2)
    assert at.m == 2


@settings(max_examples=20)
@given(inside, st.floats(-3.0, 3.0))
def test_derivatives_are_those_of_50_digit_arithmetic(e, z):
    U = ("exp(c*s) + tanh(c/(2 + s)) - z*sqrt(2 + c)", "sin(3*s)*cos(c) + log(3 + c + s)**3 + abs(c + 2)**1.5")
    found = System(U=U).at(z).DU(e)
    mp = mpmath
    rows = (
        lambda c, s: mp.exp(c * s) + mp.tanh(c / (2 + s)) - z * mp.sqrt(2 + c),
        lambda c, s: mp.sin(3 * s) * mp.cos(c) + mp.log(3 + c + s) ** 3 + abs(c + 2) ** mp.mpf(1.5),
    )
    with mp.workdps(50):
        exact = [[float(mp.diff(row, e, n)) for n in ((1, 0), (0, 1))] for row in rows]
    np.testing.assert_allclose(found, exact, rtol=1e-13, atol=1e-13)


def test_definitions_may_be_called_or_named_and_may_use_earlier_ones():
    called = System(U=CUBIC, W=("-2*c + 1/4",), definitions=CHI)
    named = System(U=("-c*(c - chi/2)*(c + chi/2)", "-s/2"), W=("-2*c + 1/4",), definitions={"chi": CHI["chi(z)"]})
    nested = System(
        U=("-c*(c - half)*(c + half)", "-s/2"),
        W=("-2*c + 1/4",),
        definitions={"square": "z**2", "chi": "(1 + 2*square)/(1 + square)", "half": "chi(z)/2"},
    )
    for z in (0.0, 0.4, -1.7):
        e = np.array([[0.3, 0.4], [-0.5, 0.1]])
        chi = (1 + 2 * z**2) / (1 + z**2)
        expected = np.stack([-e[:, 0] * (e[:, 0] ** 2 - chi**2 / 4), -e[:, 1] / 2], axis=-1)
        for system in (called, named, nested):
            np.testing.assert_allclose(system.at(z).U(e), expected, rtol=0.0, atol=1e-16)


def test_rows_may_be_numbers_or_formulas():
    system = System(U=(np.float64(2.0), parse("c*mu + z", ("c", "mu", "z"))), W=(0,), parameters={"mu": 3.0})
    np.testing.assert_array_equal(system.at(0.5).U((2.0, 0.0)), [2.0, 6.5])
    with pytest.raises(ValueError, match="'nu', which is no variable"):
        System(U=(parse("nu*c", ("c", "nu")), "s"))


def test_evolve_changes_numbers_without_reading_again():
    system = System(U=("-c + p", "-s + q"), parameters={"p": 1.0, "q": 2.0})
    other = system.evolve(q=5)
    assert other.U is system.U
    np.testing.assert_array_equal(other.at().U((0.0, 0.0)), [1.0, 5.0])
    np.testing.assert_array_equal(system.at().U((0.0, 0.0)), [1.0, 2.0])
    assert other.evolve(U=("q", "p")).at().U((0.0, 0.0)).tolist() == [5.0, 1.0]
    with pytest.raises(ValueError, match="'r' is no parameter of this system; it has p, q, U"):
        system.evolve(r=1.0)


def test_the_key_is_the_portrait():
    system = System(U=("-c + p - q", "-s"), W=("c + r",), parameters={"p": 1.0, "q": 2.0, "r": 0.0})
    at = system.at(0.3)
    assert at.key == system.evolve(r=9.0).at(-4.0).key
    assert at.slow_key != system.evolve(r=9.0).at(0.3).slow_key
    assert at.key != system.evolve(p=2.0).at(0.3).key
    # the same formulas with p = 2, q = 1 and the parameters listed the other way round
    swapped = System(U=("-c + p - q", "-s"), W=("c + r",), parameters={"q": 1.0, "p": 2.0, "r": 0.0})
    assert at.key != swapped.at(0.3).key
    assert hash(pickle.loads(pickle.dumps(at)).key) == hash(at.key)


def test_slow_variables_are_counted():
    assert System(U=("c", "s")).m == 0
    assert System(U=("c + z3", "s")).m == 3
    assert System(U=("c", "s"), W=("z", "0")).m == 2
    with pytest.raises(ValueError, match="U1 names z2, but W has 1 row: use z, or give W 2 rows"):
        System(U=("c + z2", "s"), W=("0",))
    with pytest.raises(ValueError, match="m = 1"):
        System(U=("c + z", "s")).at((1.0, 2.0))
    with pytest.raises(ValueError, match="z is"):
        System(U=("c + z", "s")).at(np.nan)


@pytest.mark.parametrize("U", [("1/c", "s"), ("log(c)", "s"), ("c", "exp(1000*s)"), ("sqrt(s)", "c")])
def test_a_field_that_is_not_finite_on_the_hemisphere_is_refused(U):
    with pytest.raises(ValueError, match=r"at e = \(.*must be finite"):
        System(U=U).at()


def test_messages_point_at_the_column():
    with pytest.raises(ExpressionError, match=r"U2: .*at column 5") as caught:
        System(U=("c", "s + foo*c"))
    assert caught.value.column == 5
    with pytest.raises(ExpressionError, match=r"definition g: .*column 3"):
        System(U=("c", "s"), definitions={"g": "1+*2"})
    # a call of a definition keeps its length, so that what follows keeps its column
    with pytest.raises(ExpressionError, match="at column 12"):
        System(U=("chi( z ) + $", "s"), definitions=CHI)


# more of each kind: tests/core/formulas/test_reading.py
CODE = [
    "().__class__.__bases__[0].__subclasses__()",
    "__import__('os').system('true')",
    "lambda: 1",
    "c; s",
    "c == s",
    "c[0]",
]
BIG = [
    "9**9**9**9", "c**1e9", "(" * 100_000 + "c" + ")" * 100_000, "c+" * 500_000 + "c", "c" * 1_000_000,
    "chi" + " " * 1_000_000, "chi(" * 250_000, "1" * 1_000_000, "\x00" * 1_000_000,
]  # fmt: skip
STRANGE = ["ｃ", "с", "c\u200b", "c\u202es", "𝐜", "２*c", "π", "\ufeffc"]


def refused_at_once(**arguments):
    def refused():
        with pytest.raises(ValueError, match=r".") as caught:
            System(**arguments)
        assert len(str(caught.value)) < 2000

    assert calls(refused) < 3000  # however long the text, and however many the names


@pytest.mark.parametrize("text", CODE + BIG + STRANGE, ids=lambda text: ascii(text[:30]))
@pytest.mark.parametrize("where", ["U", "W", "definition"])
def test_hostile_text_is_refused_at_once(text, where):
    arguments = {
        "U": {"U": (text, "s"), "definitions": CHI},
        "W": {"U": ("c", "s"), "W": (text,), "definitions": CHI},
        "definition": {"U": ("g", "s"), "definitions": {**CHI, "g": text}},
    }[where]
    refused_at_once(**arguments)


HOSTILE_KEYS = [
    *STRANGE, "__class__", "a.b", "1a", "", "lambda", "sin", "a" * 1_000_000, "a(" + " " * 1_000_000, 3, None,
]  # fmt: skip


@pytest.mark.parametrize("key", HOSTILE_KEYS, ids=lambda key: ascii(key)[:30])
@pytest.mark.parametrize("where", ["parameters", "definitions"])
def test_hostile_names_are_refused_at_once(key, where):
    refused_at_once(U=("c", "s"), **{where: {key: 1.0}})


@pytest.mark.parametrize("name", ["c", "s", "x", "y", "z", "z1", "z16"])
def test_variables_cannot_be_redefined(name):
    with pytest.raises(ValueError, match=r"variables|something else"):
        System(U=("c", "s"), parameters={name: 1.0})
    with pytest.raises(ValueError, match="something else"):
        System(U=("c", "s"), definitions={name: "1"})


@pytest.mark.parametrize(
    "arguments",
    [
        {"U": ("c",)}, {"U": ("c", "s", "c")}, {"U": "c"}, {"U": None}, {"U": 5}, {"U": object()},
        {"U": (None, "s")}, {"U": (np.nan, "s")}, {"U": (10**400, "s")}, {"U": ("c", "s"), "W": ("0",) * 17},
        {"U": ("c", "s"), "parameters": {"p": np.nan}}, {"U": ("c", "s"), "parameters": {"p": 10**400}},
        {"U": ("c", "s"), "parameters": {"p": "x" * 1_000_000}}, {"U": ("c", "s"), "parameters": 7},
        {"U": ("c", "s"), "definitions": "chi"}, {"U": ("c", "s"), "definitions": {"g": ["c"]}},
        {"U": ("c", "s"), "parameters": {f"p{i}": 1.0 for i in range(MOST_NAMES + 1)}},
        {"U": ("c", "s"), "parameters": {f"p{i}": 1.0 for i in range(200_000)}},
    ],
)  # fmt: skip
def test_wrong_shapes_and_values_are_refused(arguments):
    refused_at_once(**arguments)


def test_limits_are_reachable():
    parameters = {f"p{i}": 1.0 for i in range(MOST_NUMBERS)}
    System(U=("+".join(parameters), "s"), parameters=parameters).at()
    with pytest.raises(ValueError, match=f"at most {MOST_NUMBERS}"):
        System(U=("+".join(parameters) + "+z", "s"), parameters=parameters)
    System(U=("g", "s"), definitions={"g(" + "a," * (LONGEST_KEY // 2 - 3) + "a)": "c"})


def test_definitions_that_double_their_size_stay_small_or_are_refused():
    definitions = {"d0": "c + s"}
    definitions.update({f"d{i}": f"d{i - 1}*d{i - 1} + d{i - 1}" for i in range(1, 40)})
    assert calls(lambda: System(U=("d39", "s"), definitions=definitions)) < 150_000


def test_e_linear_systems_need_no_compiler():
    """Only systems typed as text, and trajectories, are run by compiled code: it takes seconds to load."""
    code = """if True:
        import sys, codim2_core as c2
        from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches
        system, psi = c2.ELinear(-1.0, 0.3, -1.5, (-0.1, 0.05)), c2.psi.tanh()
        c2.critical_sets(system, psi), c2.equator_equilibria(system), c2.equator_cycle(system)
        c2.limit_cycles(system, psi)
        c2.classify(system, psi), c2.nullclines(system, psi)
        equilibrium_branches(system, psi, "b", (-0.4, 0.4))
        c2.System(U=("a*c", "-s"), parameters={"a": 1.0}).at()
        sys.exit("numba" in sys.modules)
    """
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_system_is_written_as_its_equations():
    assert str(c2.ELinear(-2, 0.5, "mu", (-0.5, 0), g=(1e-7,), parameters={"mu": 2})) == (
        "x′ = -2*c - 0.5*s - 0.5\ny′ = 0.5*c + mu*s\nz1′ = 1e-07\nmu = 2"
    )
    assert str(c2.System(U=("K*c - 2e-3", "-s"), W=("z - c",), definitions={"K": "1+c"})) == (
        "x′ = (1 + c)*c - 0.002\ny′ = -s\nz1′ = z1 - c"
    )
