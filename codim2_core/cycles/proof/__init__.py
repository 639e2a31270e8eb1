r"""Proofs that an e-linear layer problem has just so many limit cycles, as certificates that anyone can check.

In kappa_2 let ``F = q U = A x2 + q f``, ``q = sqrt(s + Psi(s))``, s = |x2|^2: the orbits of the layer problem, with
time changed by q > 0. e = x2 / q, |e| < 1, and ``beta = 1 + Psi'(s)``, a function of |e|. Psi falls, so x2 -> e is one
to one and keeps the orientation; with det A > 0, C is the only equilibrium, of index 1, where ``A e + f = 0``. Then

    div F = tr A + beta f.e,    q' = q beta e.U,    (e, 1)' = (U, beta e.U) up to a multiple of (e, 1).

1. *The function of Dulac and Cherkas.* For a smooth function P on the closed disc |e| <= 1, numbers k < 0, mu < 2,
and a linear form l(e) > 0 there, let

    Phi = F.grad P + k P (div F - mu (ln(q l))'),  so that  div(B F) = B Phi / (k P)  with  B = (q l)^-mu |P|^(1/k).

A certificate is P with Phi > 0 on the closed disc (Cherkas 1997; Grin and Schneider 2007). Where P = 0, F.grad P > 0:
orbits cross from P < 0 to P > 0. So W = {P = 0} is of smooth curves that no closed orbit meets. A closed one, an
*oval*, is crossed to one side and surrounds C; the others end on the equator. Let O_1, ..., O_N be the ovals, from the
inside to the outside. P is not 0 at C, nor at a limit direction, nor on the equator if that is a closed orbit.

- Within O_1, and everywhere if N = 0, there is no cycle: no part of W would be inside it, and the integral of div(B F)
  over its inside would be 0 (Green), but has one sign.
- Between O_i and O_(i+1) there is just one: orbits enter from both sides, or leave to both (Poincare and Bendixson);
  between two the integral of div(B F) would be 0. By its sign along the cycle it is hyperbolic, stable where P > 0.
- Beyond O_N there is at most one, for the same reason (what of W ends on the equator is not between two cycles), and
  there is one if the orbits that enter there (P > 0; in reversed time if P < 0) cannot tend to the equator. That is so
  if ``sign(P) e.U < 0`` at all limit directions where P has this sign: beside them q falls, and an orbit on the equator
  takes arbitrarily long past them. If there are no limit directions it is so by itself: along the equator
  ``(2 - mu) int e.U dt = int Phi / (k P) dt`` has the sign of -P. It is also so if all orbits cross a closed polygon to
  its left (if P < 0: to its right) that goes once round C, and round a place that is not within O_N: how often it goes
  round an orbit never falls, so that the orbit of that place stays away from the equator, and beyond O_N.

So there are N cycles, and no other.

2. *The polynomials.* Let N be a matrix, (x, y, w) = N (X, Y, 1), e = (x, y) / w: a chart (X, Y), in which C is next to
the middle and the disc lies in the square |X|, |Y| <= 1 (projective maps of the disc onto itself are those). With
``V = N^-1 (w u, w v, beta (x u + y v))``, (u, v) = A (x, y) + w f, orbits are those of ``H = (V1 - X V3, V2 - Y V3)``,
and with q l = q / w

    w Phi = H.grad P + k P (w tr A + beta f.(x, y) - mu V3).

If P is a polynomial in X and Y this is one of them, of degree 0 or 1 in beta: no derivative of beta enters. beta is
enclosed by lines, beta = alpha + sigma |e|^2 up to an error; times w^2 all is a polynomial on each small square, whose
Bernstein coefficients bound it: sums that are exact in integers, then halved with rounding far below what is asked for.

3. *The number of ovals* is at most that of the zeros of P on one way from C to the edge of the square, which is at most
that of the changes of sign of its Bernstein coefficients (Descartes). It is at least what is seen on a net of squares:
all squares on which P may have the sign of C, from there on; if none of them meets the equator, an oval is around
them; then all on which P may have the other sign; and so on.

Only what `check.py` shows stands proved; it relies on NumPy's exp and powers being right to 1e-13 of the value. How P
was found, by linear programming in `search`, proves nothing.
"""
