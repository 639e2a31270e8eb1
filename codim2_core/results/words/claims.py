"""Sentences about the paper's claims: each in short, why it does not apply, and what is found."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "case1(b)": Sentence(
        "Case I, |A⁻¹f| > 1: there is no critical set, and there are 2 or 4 limit directions.", "the claim"
    ),
    "case1(c)": Sentence("Case I has five generic portraits: CM0, CM2, CM4, NCM2 and NCM4.", "the claim"),
    "not Case I": Sentence("This is not Case I: a and d are not of one sign.", "why it does not apply"),
    "count not generic": Sentence(
        "The equator is degenerate here, so the number of directions is not generic.", "the finding"
    ),
    "none, on a border": Sentence(
        ("There is no critical set, and there are {count} limit directions: on the border between the generic counts."),
        "the finding",
    ),
    "none, generic": Sentence("There is no critical set, and there are {count} limit directions.", "the finding"),
    "portrait not generic": Sentence("The portrait is not a generic one: {names}.", "why it does not apply"),
    "this one": Sentence("This portrait is {name}.", "the finding"),
    "case2(b)": Sentence(
        "Case II, |A⁻¹f| > 1: there is no critical set, and there are 2 or 4 limit directions.", "the claim"
    ),
    "not Case II": Sentence("This is not Case II: a and d of opposite sign with det A < 0.", "why it does not apply"),
    "one for each separatrix": Sentence(
        "There is one limit direction for each separatrix of the saddle.", "the finding"
    ),
    "geneps0(a)": Sentence("Where Θ(θ) = 0 the equator of the hemisphere has an equilibrium.", "the claim"),
    "all are equilibria": Sentence("Θ ≡ 0: every point of the equator is an equilibrium.", "the finding"),
    "no equilibrium": Sentence("Θ has no zero here: the equator is a closed orbit (see (c)).", "the finding"),
    "geneps0(b)": Sentence(
        "At an equilibrium of the equator the rates outwards and up the hemisphere are λ_ρ and −λ_ρ.", "the claim"
    ),
    "none isolated": Sentence("There are no isolated equilibria on the equator.", "why it does not apply"),
    "goes on up": Sentence(
        ("Trajectories that arrive from outside continue up the hemisphere along the same direction, and vice versa."),
        "the finding",
    ),
    "geneps0(c)": Sentence(
        "Without limit directions the equator is a closed orbit; ∫ λ_ρ/|Θ| dθ decides its stability.", "the claim"
    ),
    "there are directions": Sentence("There are limit directions.", "why it does not apply"),
    "equator ends": Sentence("The equator {ends} outside and {other} on the hemisphere.", "the finding"),
    "geneps1: z": Sentence("On the hemisphere z stays constant.", "the claim"),
    "geneps1: z, why": Sentence(
        "z′ = ρ W in the fast time T, and ρ = 0 on the hemisphere, so this holds for every system.", "the finding"
    ),
    "one set": Sentence("There is exactly one critical set if |A⁻¹f| < 1, and otherwise none.", "the claim"),
    "no inverse": Sentence("det A = 0 within rounding: A has no inverse.", "why it does not apply"),
    "border of existence": Sentence("|A⁻¹f| = {length:.6g}: the critical set is on the equator.", "the finding"),
    "slow flow of C": Sentence("The slow flow is −B A⁻¹f + g, as in the Filippov convention.", "the claim"),
    "W not e-linear": Sentence("W is not e-linear.", "why it does not apply"),
    "no isolated critical set": Sentence("There is no isolated critical set.", "why it does not apply"),
    "no slow variable": Sentence("There is no slow variable (m = 0).", "why it does not apply"),
    "no sliding flow": Sentence("The sliding flow is not defined.", "why it does not apply"),
    "all combinations agree": Sentence(
        "Every convex combination of two limit vectors that is tangent to Σ gives this same vector.", "the finding"
    ),
    "index": Sentence(
        "The indices of the critical sets add up to the number of turns of U along the equator.", "the claim"
    ),
    "index not defined": Sentence(
        "U vanishes on the equator, or the critical sets are not isolated.", "why it does not apply"
    ),
    "none is missing": Sentence("No critical set is missing.", "the finding"),
    "mean over a cycle": Sentence(
        "Along a limit cycle of the layer problem the reduced flow is −B A⁻¹f + g; the mean of e_Ψ is −A⁻¹f.",
        "the claim",
    ),
    "no cycle given": Sentence("No limit cycle was given.", "why it does not apply"),
    "no slow variable, no mean": Sentence(
        "There is no slow variable (m = 0), and no mean of e_Ψ was given.", "why it does not apply"
    ),
    "mean is that of C": Sentence("The mean of e_Ψ over the cycle is that of the critical set.", "the finding"),
    "U not e-linear": Sentence("U is not e-linear.", "why it does not apply"),
    "rotation": Sentence("A rotation brings A into the form [[a, −b], [b, d]], whatever A is.", "the claim"),
    "D1": Sentence(
        "For a = d there are 2 limit directions if |b| < |f|, sin(θ − arg f) = b/|f|, and none if |b| > |f|.",
        "the claim",
    ),
    "every direction, b = 0": Sentence("b = 0 and f = 0: every direction is a limit direction.", "the finding"),
    "D1, here": Sentence("|b| = {b:.6g}, |f| = {f:.6g}.", "the finding"),
    "D2": Sentence(
        (
            "For b = 0 and f₂ = 0 (or f₁ = 0) two limit directions lie on an axis. Two more, θ = ±arccos(f₁/(d − "
            "a)), exist if |f₁| < |d − a|."
        ),
        "the claim",
    ),
    "not D2": Sentence("b ≠ 0, or neither component of f is zero.", "why it does not apply"),
    "nothing turns at f = 0, D2": Sentence(
        "a = d, b = 0 and f = 0: every direction is a limit direction.", "why it does not apply"
    ),
    "ball": Sentence(
        (
            "The ball sticks and rolls if |f| < |a|, so |z| is below a critical value. It is on a stable node "
            "with z′ = 5f/7."
        ),
        "the claim",
    ),
    "not the ball": Sentence("This is not the ball at the bottom of a pool.", "why it does not apply"),
    "ball, on the border": Sentence("|z| has its critical value: the critical set is on the equator.", "the finding"),
    "attracting and repelling": Sentence(
        (
            "All six limit directions (i − 1)π/3 attract radially except Q₁. For every Ψ, C₊ is a saddle and C₋ "
            "a stable node."
        ),
        "the claim",
    ),
    "not attracting and repelling": Sentence(
        "This is not the example with attracting and repelling directions.", "why it does not apply"
    ),
    "within a third": Sentence(
        "Trajectories that arrive within π/3 of θ = 0 cross, and all others slide.", "the finding"
    ),
    "non-unique": Sentence(
        (
            "C₁ and C₃, at c = ∓χ/2, are stable nodes for every Ψ, and C₂ is a saddle. Their slow flows ±χ + 1/4 "
            "differ, so sliding is not unique."
        ),
        "the claim",
    ),
    "not non-unique": Sentence(
        "This is not the example with a non-unique sliding vector field.", "why it does not apply"
    ),
    "two slow flows": Sentence(
        "z′ = {first:.4g} on C₁ and {third:.4g} on C₃. There are 8 limit directions while χ² < 2.", "the finding"
    ),
    "lem:ePsi(a)": Sentence("e_Ψ is equivariant under rotations: e_Ψ(R(φ)(x, y)) = R(φ) e_Ψ(x, y).", "the claim"),
    "through the square": Sentence("Ψ enters through x² + y² only.", "the finding"),
    "lem:ePsi(b)": Sentence("e_Ψ(kx, ky; kε) = e_Ψ(x, y; ε) for k > 0: it is homogeneous of degree 0.", "the claim"),
    "one scale": Sentence("So ε only sets the scale: the picture in κ₂ is the same for all ε.", "the finding"),
    "lem:ePsi(c)": Sentence("e_Ψ(x, y; 1) is one-to-one: |e_Ψ| increases with ζ = |(x₂, y₂)|.", "the claim"),
    "one place": Sentence(
        "Every e in the open disc has one place (x₂, y₂), so a critical set is one point of the chart.", "the finding"
    ),
    "complement": Sentence("1 − |e_Ψ|² = Ψ/(ζ² + Ψ), and Ψ > 0.", "the finding"),
    "lem:ePsi(e)": Sentence("D e_Ψ is positive definite: its trace and its determinant are positive.", "the claim"),
    "saddle stays": Sentence(
        "So a saddle of U stays a saddle for every Ψ, and every orbit turns in the sense of U.", "the finding"
    ),
    "stands still": Sentence(
        "Where U((c, s)) = 0 inside the disc, the layer problem has an equilibrium in the scaling chart.", "the claim"
    ),
    "vanishes there": Sentence("U vanishes there when it is put into the equations of the chart.", "the finding"),
    "sign of the determinant": Sentence(
        "A critical set is a saddle, whatever Ψ is, if det D U < 0; a node or focus if det D U > 0.", "the claim"
    ),
    "independent of Ψ": Sentence("The slow flow on a critical set does not depend on Ψ.", "the claim"),
    "elsewhere in the chart": Sentence(
        "Each Ψ moves the critical set in the chart, but its slow flow is always the same.", "the finding"
    ),
    "slow manifold": Sentence(
        ("A slow manifold C_ε lies within O(ε) of a normally hyperbolic C; to first order its flow is that on C."),
        "the claim",
    ),
    "m = 0, an equilibrium": Sentence(
        "There is no slow variable (m = 0): C is an equilibrium.", "why it does not apply"
    ),
    "frozen": Sentence("The system is frozen at one z, so C is unknown at other z.", "why it does not apply"),
    "up to second order": Sentence(
        "x₂* + ε J⁻¹ Dx₂* W satisfies the equations of the slow manifold up to ε².", "the finding"
    ),
    "case1(a)": Sentence(
        (
            "Case I, |A⁻¹f| < 1: all orbits reach a unique critical set (backwards in time for a, d > 0). There "
            "are 0, 2 or 4 limit directions."
        ),
        "the claim",
    ),
    "case2(a)": Sentence(
        (
            "Case II, |A⁻¹f| < 1: C is a saddle for every Ψ. There are exactly four limit directions, each a "
            "saddle of the radial and angular flow."
        ),
        "the claim",
    ),
    "one sign": Sentence(
        "The divergence is {sign} everywhere, so there is no limit cycle, and C is {kind}.", "the finding"
    ),
    "vanishes in one": Sentence("Θ vanishes in one direction, up to rounding.", "the finding"),
    "vanishes in": Sentence("Θ vanishes in {count} directions, up to rounding.", "the finding"),
    "one set here": Sentence("|A⁻¹f| = {length:.6g}, so there is one critical set.", "the finding"),
    "no set here": Sentence("|A⁻¹f| = {length:.6g}, so there is no critical set.", "the finding"),
    "condition number": Sentence(
        "The condition number of A is {number:.1e}: double precision cannot check A⁻¹f.",
        "why it does not apply",
    ),
    "no cycle there": Sentence("There is no limit cycle.", "why it does not apply"),
    "D2, at the pitchfork": Sentence(
        "|f| = {f:.6g} and |d − a| = {spread:.6g}: exactly the pitchfork |f| = |d − a|.", "the finding"
    ),
    "D2, here": Sentence("|f| = {f:.6g} and |d − a| = {spread:.6g}. The pitchfork is at |f| = |d − a|.", "the finding"),
    "no rotation": Sentence("It already has this form.", "the finding"),
    "rotated": Sentence("The axes are turned by {phi:.6g}.", "the finding"),
    "ball sticks": Sentence("Σ slides: the ball sticks and rolls, and z decays.", "the finding"),
    "ball slips": Sentence("Nothing slides along Σ: the ball slips.", "the finding"),
    "lem:ePsi(d)": Sentence("|e_Ψ|² < 1.", "the claim"),
    "one sign of two determinants": Sentence(
        "det J = det D U · det D e_Ψ, and the second factor is positive for every Ψ. {which}.", "the finding"
    ),
    "not hyperbolic": Sentence("{which} is not normally hyperbolic here.", "why it does not apply"),
    "not hyperbolic, several": Sentence("{which} are not normally hyperbolic here.", "why it does not apply"),
    "a and d differ": Sentence("a ≠ d.", "why it does not apply"),
}
