"""Sentences about the equator as a whole: its equilibria, and whether all are known."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "closed orbit, neutral": Sentence(
        "The equator is a closed orbit ({turn}), neutral: orbits beside it neither approach nor leave.", "exponent 0"
    ),
    "closed orbit": Sentence(
        "The equator is a closed orbit ({turn}), {outside} from outside and {inside} from the hemisphere.",
        "Θ has no zero",
    ),
    "at most four": Sentence(
        "Θ has at most 4 zeros, a closed form. Their number is decided by its discriminant, where rounding could "
        "blur that in exact arithmetic: none is missing.",
        "e-linear",
    ),
    "Q at": Sentence("{Q} at θ = {theta:.4g}: {kind}.", "one equilibrium"),
    "every direction of the equator": Sentence(
        "Every direction is a limit direction: Θ vanishes identically.", "Θ ≡ 0"
    ),
    "no equilibria": Sentence("No equilibria on the equator: it is a closed orbit.", "Θ has no zero"),
    "no equilibria found": Sentence(
        "No equilibria were found on the equator; that there are none is not proved.", "none, `proven` is False"
    ),
    "no more proved": Sentence("That there are no more is not proved.", "`proven` is False"),
    "equilibria": Sentence("{count} {noun} on the equator.", "all simple"),
    "equilibria, some degenerate": Sentence(
        "{count} {noun} on the equator, {some} of them degenerate.", "a multiple zero"
    ),
    "on a net": Sentence(
        "Θ is not smooth: between its kinks its zeros are looked for on a net of {net} directions. No proof that "
        "none was missed.",
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
        "Bounds from its derivatives and Σ k⁴|c_k| show |Θ| > 0 on every arc without a zero, and Θ monotone on "
        "every arc with one: none is missing.",
        "proven",
    ),
    "close to a multiple zero": Sentence("Close to a multiple zero the count could not be decided.", "not proven"),
}
