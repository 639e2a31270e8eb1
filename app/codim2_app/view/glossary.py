"""The page's own texts: the paper that it shows, the equations, and its terms, a sentence each."""

from __future__ import annotations

#: Authors, title, and where it is found: Crossref knows papers by title. Nothing is asked until a reader clicks.
PAPER = (
    "N. Cheesman, K. Uldall Kristiansen and S. J. Hogan",
    "Regularisation of isolated codimension-2 discontinuity sets",
    "https://search.crossref.org/search/works?q=Regularisation+of+isolated+codimension-2+discontinuity+sets",
)
_SLOW = '<mo>,</mo><mspace width="1em"/>'
_OPEN, _CLOSE, _BAR = (f'<mo stretchy="false">{c}</mo>' for c in "()|")
_PRIME = '<mo lspace="0" rspace="0.2em">′</mo>'
_XY = f"{_OPEN}<mi>x</mi><mo>,</mo><mi>y</mi>{_CLOSE}"
_E = f'<mi class="of-psi">e</mi><mo>=</mo>{_XY}<mo>/</mo>{_BAR}{_XY}{_BAR}'
#: The equation of motion, for the page's head: of the e-linear system, and of any other. Colours are of the controls.
EQUATION = (
    f'<math class="equation normal-only" aria-label="(x, y)′ = A e + f + z k, e = (x, y)/|(x, y)|"><mrow>'
    f'{_XY}{_PRIME}</mrow><mo>=</mo><mi class="of-A">A</mi><mi class="of-psi">e</mi><mo>+</mo>'
    f'<mi class="of-f">f</mi><mo>+</mo><mi class="of-z">z</mi><mi class="of-f">k</mi>{_SLOW}{_E}</math>'
    f'<math class="equation other-only" aria-label="(x, y)′ = U(e, z), z′ = W(e, z), e = (x, y)/|(x, y)|"><mrow>'
    f'{_XY}{_PRIME}</mrow><mo>=</mo><mi>U</mi>{_OPEN}<mi class="of-psi">e</mi><mo>,</mo>'
    f'<mi class="of-z">z</mi>{_CLOSE}{_SLOW}{_E}</math>'
)
#: Term and meaning, in the paper's words, in the order in which a reader of the picture meets them.
GLOSSARY: tuple[tuple[str, str], ...] = (
    ("Σ", "the discontinuity set x = y = 0, on which e = (x, y)/|(x, y)| has no value; z runs along it"),
    ("The circle", "the equator of the hemisphere that each point of Σ is blown up to: directions e = (cos θ, sin θ)"),
    ("Inside", "the layer problem on that hemisphere, from above: the regularised system at |(x, y)| of order ε"),
    ("Outside", "the system without regularisation: (x, y) in direction θ at the radius 1 + |(x, y)|"),
    ("ε, Ψ", "the regularisation: e becomes (x, y)/√(x² + y² + ε²Ψ((x² + y²)/ε²)), smooth for ε > 0"),
    ("Limit direction Q", "a direction in which trajectories reach or leave Σ: an equilibrium on the equator"),
    (
        "λ_ρ, λ_θ",
        "eigenvalues of a limit direction: negative attracts radially (filled), angularly (circle)",
    ),
    ("Critical set C", "an equilibrium inside: there the motion slides along Σ, with the slow flow z′ at C"),
    ("⊙, ⊗", "the slow flow of the first slow variable: out of the page (growing), into the page"),
    ("Slide, cross", "stay on Σ near a critical set or limit cycle; or pass through Σ and leave it"),
    ("Case I, II, III", "a and d of one sign; det A < 0; a and d of opposite sign with det A > 0, where Ψ matters"),
    ("CM, NCM", "names of this explorer: critical set, no critical set; the number counts limit directions"),
    ("τ, T", "fast times: dT = dt/|(x, y, ε)| in the picture, dt = ε dτ for the periods of limit cycles"),
)
#: How the picture is read, next to it: a mark (a path in a square of 14, its classes, or text) and what it means.
MARKS: tuple[tuple[str, str, str], ...] = (
    ("M7 1A6 6 0 1 0 7 13A6 6 0 1 0 7 1Z", "m ink", "equator: inside the layer problem, outside radius 1 + ρ"),
    ("M1 7H9M5 3L10 7L5 11Z", "m ink fill", "time"),
    ("M7 2.4A4.6 4.6 0 1 0 7 11.6A4.6 4.6 0 1 0 7 2.4Z", "m attr fill", "Q filled: attracts radially,"),
    ("M7 2.4A4.6 4.6 0 1 0 7 11.6A4.6 4.6 0 1 0 7 2.4Z", "m rep", "hollow: repels;"),
    ("M7 2.4A4.6 4.6 0 1 0 7 11.6A4.6 4.6 0 1 0 7 2.4Z", "m ink", "circle: attracts along θ,"),
    ("M7 1.5L12 7L7 12.5L2 7Z", "m ink", "repels,"),
    ("M7 2L12.5 12H1.5Z", "m ink", "degenerate"),
    ("M2.5 2.5H11.5V11.5H2.5Z", "m crit fill", "C: square node, circle focus, cross saddle; filled: stable"),
    ("⊙ ⊗", "", "z increases (out of the page) or decreases (into it)"),
    ("M0 7H4M7 7H11", "m separatrix", "dashed separatrices arrive, full ones leave"),
    ("M0 7H14", "m lines-in", "U₁ = 0, U₂ = 0 inside,"),
    ("M0 7H14", "m lines-out", "outside"),
)
#: Below the list of portraits while none is chosen.
OPENING = "Move a slider, or pick an example below."
