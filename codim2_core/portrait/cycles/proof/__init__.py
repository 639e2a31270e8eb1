r"""Proofs of portraits: limit directions, critical sets, and just so many limit cycles, as certificates to be checked.

U is a polynomial of degree n in e = (c, s), with the numbers as they are in the computer; formulas are multiplied out
exactly. In kappa_2 let ``F = q U``, ``q = sqrt(s + Psi(s))``, s = |x2|^2: the orbits of the layer problem, with time
changed by q > 0. e = x2 / q, |e| < 1, and ``beta = 1 + Psi'(s)``, a function of |e|. Psi falls, so x2 -> e is one to
one and keeps the orientation; critical sets are the zeros of U. With D = D_e U,

    div F = tr D + beta (e.U - e.D e),    q' = q beta e.U,    (e, 1)' = (U, beta e.U) up to a multiple of (e, 1),

and at a critical set J = D (I - beta e e^T) / q, so that its trace is (tr D - beta e.D e) / q.

1. *Limit directions.* On arcs that cover the equator, Theta = e x U is not 0, or its derivative is not, nor is e.U: by
their values in the middle and bounds of their slopes. Then zeros are the changes of sign, and all are hyperbolic.

2. *Critical sets.* About each place U is expanded exactly. With M the inverse of D there, |I - M D| < 1 in a square: U
is one to one in it, and has a zero next to the place. Where the disc is not in such a square, U1 or U2 has one sign on
squares, by their Bernstein coefficients: there is no other zero. A closed orbit surrounds one that is no saddle, since
their indices add up to 1: without such there is no cycle.

3. *The function of Dulac and Cherkas.* For a smooth function P on the closed disc |e| <= 1, numbers k < 0, mu < 2,
and a linear form l(e) > 0 there, let

    Phi = F.grad P + k P (div F - (1 - n) (ln q)' - mu (ln(q l))'),  so that  div(B F) = B Phi / (k P)
    with  B = q^(n - 1) (q l)^-mu |P|^(1/k).

A certificate is P with Phi > 0 on the closed disc (Cherkas 1997; Grin and Schneider 2007). Where P = 0, F.grad P > 0:
orbits cross from P < 0 to P > 0. So W = {P = 0} is of smooth curves that no closed orbit meets. A closed one, an
*oval*, is crossed to one side: it surrounds a critical set that is no saddle. The others end on the equator.

- *At most as many cycles as ovals.* Take what is within a cycle, and within none of the cycles in it. If no oval were
  there, P would have one sign (what of W ends on the equator is not within a cycle), and the integral of div(B F) over
  it would be 0 (Green), but has one sign. By its sign along a cycle this is hyperbolic, stable where P > 0.
- *Ways.* From each critical set a way leads to the equator, or to another one. P keeps its sign along all of them but
  one, which leads from the *core*, the critical sets joined without a change of sign, out to the equator. Those that
  are not of the core are within no oval; so all ovals surround the core, and there are at most as many as changes of
  sign on that one way: O_1, ..., O_N, from the inside to the outside.
- Between O_i and O_(i+1) there is no critical set, and orbits enter from both sides, or leave to both: there is a
  cycle (Poincare and Bendixson).
- Beyond O_N there is one if the orbits that enter there (P > 0; in reversed time if P < 0) cannot tend to the equator,
  nor to a critical set. If all of these are of the core, that is so if ``sign(P) e.U < 0`` at all limit directions
  where P has this sign: near them q falls, and an orbit on the equator takes arbitrarily long past them. If there are
  no limit directions it is so by itself: along the equator
  ``(1 + n - mu) int e.U dt = int Phi / (k P) dt`` has the sign of -P. It is also so if all orbits cross a closed
  polygon to its left (if P < 0: to its right) that goes once round the core, not round any other critical set, and
  round a place that is not within O_N: how often it goes round an orbit never falls, so that the orbit of that place
  stays away from the equator, and beyond O_N.

So there are N cycles, and no other.

4. *The polynomials.* Let N be a matrix, (x, y, w) = N (X, Y, 1), e = (x, y) / w: a chart (X, Y), in which the disc lies
in the square |X|, |Y| <= 1, with C next to the middle if there is one critical set (projective maps of the disc onto
itself are those). With (u, v) = w^n U, of degree n, and ``V = N^-1 (w u, w v, beta (x u + y v))``, orbits are those of
``H = (V1 - X V3, V2 - Y V3)``, and with q l = q / w

    w^n Phi = H.grad P + k P (w (du/dx + dv/dy) + beta (x du/dw + y dv/dw) - mu V3).

If P is a polynomial in X and Y this is one of them, of degree 0 or 1 in beta: no derivative of beta enters. beta is
enclosed by lines, beta = alpha + sigma |e|^2 up to an error; times w^2 all is a polynomial on each small square, whose
Bernstein coefficients bound it: sums that are exact in integers, then halved with rounding far below what is requested.

5. *The number of ovals* is at most that of the changes of sign of the Bernstein coefficients of P along the way
(Descartes). It is at least what is seen on a net of squares: all squares on which P may have the sign that it has in
the core, from there on; if none of them meets the equator, an oval is around them; then all on which P may have the
other sign; and so on.

Only what `check.py` shows is proved; it relies on NumPy's exp and powers being right to 1e-13 of the value. How P
was found, by linear programming in `search`, proves nothing.
"""
