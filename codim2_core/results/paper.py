"""Printed names of the paper's labels.

Docstrings name sections, theorems and equations as the paper prints them: (2.7) is an equation. The attribute `label`
of results gives labels of the paper's source. `tests/paper` numbers these by the rules of the paper's class.
"""

from __future__ import annotations

import re

from .special_kinds import SPECIAL_KINDS

#: Label, what it is called, and its title (of sections the paper's, of the others what it shows, in a few words).
PRINTED: dict[str, tuple[str, str]] = {
    "fig:friction": ("Figure 1", "Coulomb friction with one and with two degrees of freedom"),
    "fig:codim1vcodim2": ("Figure 2", "an isolated codimension-2 discontinuity set"),
    "fig:generic_nonuniqueness_of_sliding": ("Figure 3", "Filippov sliding is not unique"),
    "sec:prelims": ("Section 2", "Preliminaries"),
    "fig:straight": ("Figure 4", "straightening of Σ, and e"),
    "sec:nonsmoothdynamics": ("Section 2.1", "Dynamics near the discontinuity set"),
    "sec:regularisation": ("Section 2.2", "Regularisation"),
    "def:Psi": ("Definition 2.3", "regularisation functions Ψ"),
    "def:MPsi": ("Definition 2.4", ""),
    "fig:component": ("Figure 5", "the smooth step L"),
    "lem:ePsi": ("Lemma 2.6", "properties of the regularised e"),
    "sec:gen": ("Section 3", "Blowup for the general regularised system"),
    "fig:onesphere": ("Figure 6(a)", ""),
    "fig:manyspheres": ("Figure 6(b)", ""),
    "fig:insert_sphere": ("Figure 6", "the blowup"),
    "sec:geneps0": ("Section 3.1", "Entry chart κ₁: dynamics near the discontinuity set"),
    "thm:geneps0": ("Theorem 3.1", "limit directions and the closed equator"),
    "fig:side_of_sphere": ("Figure 7", "orbits up the side of the sphere"),
    "fig:eps0": ("Figure 8", "dynamics in the entry chart"),
    "sec:geneps1": ("Section 3.2", "Scaling chart κ₂: dynamics on the discontinuity set"),
    "rem:jaco_properties": ("Remark 3.2", "properties of the Jacobian"),
    "thm:geneps1": ("Theorem 3.3", "critical sets and sliding"),
    "fig:eps1_combi": ("Figure 9", "dynamics in the scaling chart"),
    "fig:epsboth_cubic": ("Figure 10(c)", ""),
    "fig:epsboth": ("Figure 10", "dynamics after the blowup"),
    "fig:epsboth_3D": ("Figure 11", "hemispheres along z"),
    "sec:lin": ("Section 4", "Classification of the e-linear system"),
    "fig:whylinear": ("Figure 12", "sliding and crossing in the e-linear system"),
    "fig:intersections": ("Figure 13", "hyperbola and circle"),
    "thm:lineps1": ("Theorem 4.1", "the critical set of the e-linear system"),
    "prop:LC": ("Proposition 4.2", "the slow flow on a limit cycle"),
    "fig:ellipse": ("Figure 14", "the ellipse |A⁻¹h| = 1"),
    "sec:cases": ("Section 4.3", "Cases"),
    "tab:cases": ("Table 1", "the three cases"),
    "thm:case1": ("Theorem 4.3", "Case I"),
    "fig:CM0": ("Figure 15(a)", ""),
    "fig:CM2": ("Figure 15(b)", ""),
    "fig:CM4": ("Figure 15(c)", ""),
    "fig:NCM2": ("Figure 15(d)", ""),
    "fig:NCM4": ("Figure 15(e)", ""),
    "fig:sketches": ("Figure 15", "the five portraits of Case I"),
    "fig:CM4_saddle": ("Figure 16(a)", ""),
    "fig:NCM2_saddle": ("Figure 16(b)", ""),
    "fig:NCM4_saddle": ("Figure 16(c)", ""),
    "fig:3cases": ("Figure 16", "the three portraits of Case II"),
    "thm:case2": ("Theorem 4.4", "Case II"),
    "sec:case3": ("Section 4.3.3", "Case III"),
    "fig:bads": ("Figure 17", "what Ψ changes in Case III"),
    "fig:bad_sketches": ("Figure 18", "portraits of Case III"),
    "sec:bifurcations": ("Section 4.4", "Bifurcations"),
    "fig:transcrit": ("Figure 19", "a critical set reaches the equator"),
    "fig:SNBIF": ("Figure 20", "saddle-node on the equator"),
    "sec:examples": ("Section 5", "Examples"),
    "sec:ballpool": ("Section 5.1", "Ball at bottom of a pool"),
    "fig:ballpool": ("Figure 21", "the ball"),
    "fig:ballpool3d": ("Figure 22", "the ball, along z"),
    "sec:mateslidecross": ("Section 5.2", "System with attracting and repelling directions"),
    "fig:ex4p5": ("Figure 23", "attracting and repelling directions"),
    "sec:nonunique": ("Section 5.3", "System with non-unique sliding vector field"),
    "lem:normalform": ("Lemma B.1", "the normal form"),
    "sec:numCaseI": ("Appendix C", "Numerical examples for Case I"),
    "fig:simCM0": ("Figure 24(a)", ""),
    "fig:simCM2": ("Figure 24(b)", ""),
    "fig:simCM4": ("Figure 24(c)", ""),
    "fig:simNCM2": ("Figure 24(d)", ""),
    "fig:simNCM4": ("Figure 24(e)", ""),
    "fig:sim_5cases": ("Figure 24", "Case I, computed"),
    "eq:vf": ("(2.7)", ""),
    "eq:polar_gen_odes_desing": ("(2.12)", ""),
    "eq:equator_equilibria": ("(2.15)", ""),
    "eq:ePsi": ("(2.19)", ""),
    "eq:RPCM": ("(2.29)", ""),
    "eq:RPSF": ("(2.30)", ""),
    "eq:blowup_def": ("(3.3)", ""),
    "eq:entrychart": ("(3.6)", ""),
    "eq:scalingchart": ("(3.7)", ""),
    "eq:coordinatechange": ("(3.8)", ""),
    "eq:xi": ("(3.10)", ""),
    "eq:critical_set": ("(3.22)", ""),
    "eq:scjaco": ("(3.23)", ""),
    "eq:LP": ("(3.26)", ""),
    "eq:ode_normal_form": ("(4.1)", ""),
    "eq:matrix_normal_form": ("(4.2)", ""),
    "eq:lin_limit_vector": ("(4.3)", ""),
    "eq:lin_limit_plane": ("(4.4)", ""),
    "eq:Fsigma": ("(4.5)", ""),
    "eq:equator_zeros": ("(4.9)", ""),
    "eq:conic11": ("(4.10)", ""),
    "eq:conic12": ("(4.11)", ""),
    "eq:tangencies": ("(4.12)", ""),
    "eq:lincriticalset": ("(4.15)", ""),
    "eq:linslowflow": ("(4.17)", ""),
    "eq:linLP": ("(4.19)", ""),
    "eq:bad_reg": ("(4.28)", ""),
    "eq:ex4p5": ("(5.12)", ""),
    "eq:exmult": ("(5.16)", ""),
}
#: What changes along a parameter and on curves of an atlas, each kind once: where the paper has it (`label_of`).
CHANGES: dict[str, str] = {
    "saddle-node": "fig:SNBIF, eq:tangencies",
    "pitchfork": "fig:SNBIF",
    "cusp": "fig:SNBIF, eq:tangencies",
    "exchange of limit directions": "eq:equator_zeros",
    "all directions": "eq:equator_zeros",
    "transcritical": "fig:ellipse, fig:transcrit",
    "touching the equator": "fig:transcrit",
    "fold of critical sets": "eq:scjaco",
    "pitchfork of critical sets": "eq:scjaco",
    "change of critical sets": "eq:critical_set",
    "det A = 0": "thm:lineps1",
    "line of equilibria": "thm:lineps1",
    "tr J = 0": "sec:case3",
    "neutral equator": "thm:geneps0",
    "degenerate": "thm:geneps0",
    "undefined": "U has no value",
    "fold of cycles": "sec:case3",
    "homoclinic loop": "sec:case3",
    "heteroclinic cycle": "sec:case3",
    "saddle connection": "sec:case3",
}


def label_of(kind: str) -> str:
    """Return where the paper has a kind of change."""
    return next((row.label for row in SPECIAL_KINDS if row.kind == kind), None) or CHANGES[kind]


_LABEL = re.compile(r"((?:fig|sec|thm|prop|lem|tab|def|rem|eq):\w+)(\(\w\))?")


def cite(labels: str, *, titled: bool = False) -> str:
    """Return labels of the paper's source as a reader of the paper finds them.

    Parameters
    ----------
    labels : str
        Text with labels such as "thm:geneps0(b)"; all else is kept.
    titled : bool
        Whether the title of the first is added.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        A label is none of the paper's that are listed.

    Examples
    --------
    >>> cite("thm:geneps0(b)"), cite("fig:CM0, fig:simCM0")
    ('Theorem 3.1(b)', 'Figure 15(a), Figure 24(a)')
    >>> cite("sec:ballpool", titled=True)
    'Section 5.1: Ball at bottom of a pool'
    """

    def print_label(match: re.Match[str]) -> str:
        if match[1] not in PRINTED:
            raise ValueError(f"{match[1]!r} is no label that is listed; choose one of {', '.join(PRINTED)}.")
        return PRINTED[match[1]][0] + (match[2] or "")

    text = _LABEL.sub(print_label, labels)
    first = _LABEL.search(labels)
    title = PRINTED[first[1]][1] if titled and first else ""
    return f"{text}: {title}" if title else text
