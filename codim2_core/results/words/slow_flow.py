"""Sentences about sliding along Σ: along one slow variable, and by convex combinations."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "along: sliding": Sentence("There is a stable critical set: Σ slides.", "an interval of z"),
    "along: unstable": Sentence(
        "There is no stable critical set: it slides only on an unstable one, or on a limit cycle around it.",
        "an interval of z",
    ),
    "along: crossing": Sentence("There is no critical set: nothing slides.", "an interval of z"),
    "along: exchange": Sentence("det J = 0: critical sets meet and exchange their kinds.", "kinds exchange at one z"),
    "along: equator": Sentence(
        "A critical set passes through the equator (transcritical, Figure 19).",
        "the number of critical sets changes on the equator",
    ),
    "along: fold": Sentence(
        "det J = 0: two critical sets meet in a fold and vanish.", "the number of critical sets changes inside"
    ),
    "along: Hopf": Sentence("tr J = 0: the critical set becomes {kind}.", "stable becomes unstable"),
    "along: node-focus": Sentence("Δ(J) = 0: the critical set becomes {kind}.", "a node becomes a focus, or back"),
    "affine: none single": Sentence(
        "det A = 0 within rounding: no unique affine combination of limit vectors is tangent to Σ.", "det A = 0"
    ),
    "Filippov: unique": Sentence(
        "All convex combinations of the limit vectors that are tangent to Σ are one vector: Filippov sliding is "
        "unique.",
        "one vector",
    ),
    "Filippov: not unique": Sentence(
        "The convex combinations of the limit vectors that are tangent to Σ form a whole set: the Filippov sliding "
        "vector is not unique.",
        "a whole set",
    ),
    "Filippov: touches": Sentence(
        (
            "Σ only touches the hull of the limit vectors, within 10⁻¹⁰: it is undecided whether a combination "
            "is tangent."
        ),
        "Σ on the boundary of the hull",
    ),
    "Filippov: none": Sentence(
        "No convex combination of the limit vectors is tangent to Σ: crossing, by the Filippov convention.",
        "Σ outside the hull",
    ),
    "affine: convex": Sentence(
        (
            "The plane of affine combinations of limit vectors meets Σ in one point (×), a convex combination, "
            "so there is sliding."
        ),
        "|A⁻¹f| < 1",
    ),
    "affine: not convex": Sentence(
        (
            "The plane of affine combinations of limit vectors meets Σ in one point (×). It is not a convex "
            "combination, so there is crossing."
        ),
        "|A⁻¹f| > 1",
    ),
    "affine: limit vector": Sentence(
        (
            "The plane of affine combinations of limit vectors meets Σ in one point (×). Within rounding it is a "
            "limit vector: between sliding and crossing."
        ),
        "|A⁻¹f| = 1 within rounding",
    ),
    "along: attracts": Sentence(
        "z′ = 0: this point attracts along the critical set.", "a zero of the slow flow, m = 1"
    ),
    "along: repels": Sentence("z′ = 0: this point repels along the critical set.", "a zero of the slow flow, m = 1"),
    "along one: attracts": Sentence("{z}′ = 0: along {z} alone it attracts; the other slow variables move.", "m > 1"),
    "along one: repels": Sentence("{z}′ = 0: along {z} alone it repels; the other slow variables move.", "m > 1"),
}
