"""Sentences about a degenerate setting: what has met, vanished or become neutral."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "neutral closed equator": Sentence(
        "The equator is a closed orbit with exponent 0: to first order it neither attracts nor repels.",
        "exponent 0 within rounding",
    ),
    "two have met": Sentence(
        "Θ has a double zero: two limit directions meet here (Figure 20). They are counted once.", "multiplicity 2"
    ),
    "one splits, D2": Sentence(
        (
            "Θ has a triple zero with λ_θ = 0: one limit direction splits into three here (degenerate case D2). "
            "It is counted once."
        ),
        "multiplicity 3, b = 0",
    ),
    "four have met": Sentence(
        "Θ has a fourfold zero: all four limit directions meet here. They are counted once.", "multiplicity 4, e-linear"
    ),
    "cusp": Sentence(
        "Θ has a triple zero: two saddle-nodes of limit directions meet in a cusp. They are counted once.",
        "multiplicity 3, not symmetric",
    ),
    "nothing turns": Sentence(
        "a = d, b = 0 and f = 0: Θ ≡ 0, every direction is a limit direction (the ball at z = 0).",
        "a = d, b = 0, f = 0",
    ),
    "linear centre": Sentence(
        (
            "tr J = 0 within rounding: to first order C is a centre of the layer problem. Nonlinear terms decide "
            "whether it is a centre or a focus, as at a Hopf bifurcation."
        ),
        "tr J = 0 within rounding, one critical set",
    ),
    "true centre": Sentence(
        "C is a centre of the layer problem, surrounded by closed orbits, whatever Ψ is.",
        "a = d = 0, or a = −d and |f₁| = |f₂|",
    ),
    "between the cases": Sentence(
        "{which}: the system lies on the border between Case I and Cases II, III (Table 1).", "a = 0 or d = 0"
    ),
    "one splits": Sentence(
        "Θ has a triple zero: one limit direction splits into three here. It is counted once.",
        "multiplicity 3, symmetric",
    ),
    "four directions have met": Sentence(
        "Θ has a fourfold zero: four limit directions meet here. They are counted once.", "multiplicity 4"
    ),
    "no turning": Sentence("Θ ≡ 0: every direction is a limit direction.", "Θ vanishes identically"),
    "arc of directions": Sentence(
        (
            "Θ vanishes on an arc: every direction from θ = {first:.4g} to {last:.4g} is a limit direction. Only "
            "the others are counted."
        ),
        "Θ vanishes between two of its kinks",
    ),
    "many have met": Sentence("{count} limit directions meet here. They are counted once.", "multiplicity above 4"),
    "everything at rest": Sentence("U ≡ 0: every point of the hemisphere is an equilibrium.", "U vanishes identically"),
    "curve of zeros": Sentence("U = 0 along a whole curve of the hemisphere.", "zeros of U are not isolated"),
    "zero on the equator": Sentence("U = 0 on the equator: a critical set reaches it here (Figure 19).", "U = 0 there"),
    "sets have met": Sentence("det J = 0: two critical sets meet here. They are counted once.", "a double zero of U"),
    "more sets have met": Sentence(
        "det J = 0: three or more critical sets meet here. They are counted once.",
        "a zero of higher order, of index not 0",
    ),
    "corner": Sentence(
        (
            "U is not differentiable at a critical set, and its sides disagree. A linearisation cannot decide "
            "whether it attracts, repels or is a saddle."
        ),
        "U has a kink at a critical set",
    ),
    "linear centre, one of them": Sentence(
        (
            "tr J = 0 within rounding: to first order a critical set is a centre. Nonlinear terms decide whether "
            "it is a centre or a focus, as at a Hopf bifurcation."
        ),
        "tr J = 0 within rounding",
    ),
    "undecided somewhere": Sentence(
        "It is undecided whether U = 0 somewhere on the hemisphere. Check that U is smooth and finite there.",
        "the search is not proven",
    ),
    "index mismatch": Sentence(
        (
            "The indices of the critical sets add up to {indices}, but U turns {degree} times on the equator. A "
            "critical set or a limit direction is missing."
        ),
        "indices and degree differ",
    ),
    "exists once": Sentence(
        "There is one critical set, since |A⁻¹f| < 1 (Theorem 4.1).", "the status of the closed form"
    ),
    "exists not": Sentence(
        "There is no critical set, since |A⁻¹f| > 1 (Theorem 4.1).", "the status of the closed form"
    ),
    "exists on the equator": Sentence(
        "|A⁻¹f| = 1 within rounding: the critical set lies on the equator (transcritical, Figure 19).",
        "the status of the closed form",
    ),
    "singular, none": Sentence(
        "det A = 0 within rounding and f is not in the range of A, so there is no critical set.",
        "the status of the closed form",
    ),
    "singular, a line": Sentence(
        "det A = 0 within rounding and f is in the range of A, so the line A e = −f consists of equilibria.",
        "the status of the closed form",
    ),
    "singular, outside": Sentence(
        "det A = 0 within rounding and the line A e = −f misses the hemisphere, so there is no critical set.",
        "the status of the closed form",
    ),
    "everything, e-linear": Sentence(
        "A = 0 and f = 0, so every point of the hemisphere is an equilibrium of the layer problem.", "A = 0 and f = 0"
    ),
    "nearer": Sentence(
        "In double precision it cannot be told from a setting within {within} of {of}.", "within rounding"
    ),
}
