r"""Proofs that an e-linear layer problem has just so many limit cycles, as certificates that anyone can check.

In kappa_2 let ``F = q U = A x2 + q f``, ``q = sqrt(s + Psi(s))``, s = |x2|^2: the orbits of the layer problem, with
time changed by q > 0. As det A > 0, there is at most one equilibrium C, of index 1, and each closed orbit G surrounds
it. Places are homogeneous, (X, Y, W), x2 = (X, Y)/W: a place with W = 0 lies on the equator, and edges are straight in
x2. A certificate holds

- *walks*: polygons all of whose edges U crosses from the right to the left, or all from the left to the right. A walk
  meets G from one side of G only; if it is closed, or comes from the equator and goes to it, it meets G as often
  inwards as outwards: never. So a walk lies inside each G or outside, as a whole, even where it crosses itself.
- *rings*: triangles between two closed polygons, with a number h at each corner, linear between. All triangles go
  round to the left, so a place P lies in as many as the outer polygon goes more often round P than the inner one.

*No cycle about C.* The first ring is a fan of triangles about a place, and its outer polygon is part of the first
walk. Its weighted divergence ``div F + F.grad h``, that of exp(h) F over exp(h), has one sign, so no closed orbit lies
in it (Green). If that walk were outside some G, then G and its inside would lie in the fan: the first walk is inside.

*One cycle in a ring.* The inner polygon is part of one walk, the outer one of another, and U goes into the ring across
both, or out of it. The zeros of U in the ring would have indices that add up to 0, its Euler number, so there are none:
there is a closed orbit (Poincare and Bendixson), none goes round nothing, and two would bound a part of the ring into
which the weighted divergence, of one sign, cannot be integrated to 0 (Green, Dulac). So there is exactly one.

*No other.* The last walk comes from the equator, outside all G; or the last ring reaches up to the equator with
``ln h - 2 ln q``, h now of degree 1, rising, or falling, along all orbits: none is closed. All polygons go once round
the place in the fan, which lies inside all G. Let G have the walk before a ring inside and that behind it outside.
Then places of G lie once in the ring, so G is a closed orbit of it. Were G inside a later walk again, those of a ring
between them would lie less than 0 times in it. So each G is the one cycle of one ring.

Only what is here counted on the fingers stands proved: `check.py` looks at each edge and triangle with intervals that
are rounded outwards: what a component of U is on it is bounded by its value at one place, and slopes from there to the
corners. How the certificate was found, by the other modules, proves nothing.
"""
