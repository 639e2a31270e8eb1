"""Sentences about the equator as a whole: its equilibria, and whether all are known."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "closed orbit, neutral": Sentence(
        "The equator is a closed orbit ({turn}) and neutral: nearby orbits neither approach nor leave it.", "exponent 0"
    ),
    "closed orbit": Sentence(
        "The equator is a closed orbit ({turn}), {outside} from outside and {inside} from the hemisphere.",
        "Θ has no zero",
    ),
    "at most four": Sentence(
        (
            "Θ has at most 4 zeros, in closed form, and none is missing. Its discriminant decides their number, "
            "in exact arithmetic where rounding matters."
        ),
        "e-linear",
    ),
    "Q at": Sentence("{Q} at θ = {theta:.4g}: {kind}.", "one equilibrium"),
    "every direction of the equator": Sentence(
        "Every direction is a limit direction: Θ vanishes identically.", "Θ ≡ 0"
    ),
    "no equilibria": Sentence("The equator has no equilibria: it is a closed orbit.", "Θ has no zero"),
    "no equilibria found": Sentence(
        "No equilibria were found on the equator, but it is not proved that there are none.", "none, `proven` is False"
    ),
    "no more proved": Sentence("It is not proved that there are no others.", "`proven` is False"),
    "equilibria": Sentence("The equator has {count} {noun}.", "all simple"),
    "equilibria, some degenerate": Sentence("The equator has {count} {noun} ({some} degenerate).", "a multiple zero"),
    "on a net": Sentence(
        (
            "Θ is not smooth: its zeros between kinks are found on a net of {net} directions. It is not proved "
            "that none is missed."
        ),
        "a kink of Θ",
    ),
    "exact series": Sentence(
        "Θ is a trigonometric polynomial of degree {degree}, Σ c_k exp(ikθ).", "recognised as one"
    ),
    "series": Sentence(
        "Θ agrees to machine precision, on a net twice as fine as needed, with a trigonometric polynomial of degree "
        "{degree}, Σ c_k exp(ikθ).",
        "interpolated",
    ),
    "bounds": Sentence(
        (
            "Bounds from its derivatives and Σ k⁴|c_k| prove that no zero is missing: on each arc Θ has one sign "
            "or is monotone."
        ),
        "proven",
    ),
    "close to a multiple zero": Sentence("The number of zeros close to a multiple zero is undecided.", "not proven"),
}
