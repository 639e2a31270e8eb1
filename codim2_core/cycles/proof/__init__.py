r"""Proofs that an e-linear layer problem has just so many limit cycles, as certificates that anyone can check.

In kappa_2 let ``F = q U = A x2 + q f``, ``q = sqrt(s + Psi(s))``, s = |x2|^2: the orbits of the layer problem, with
time changed by q > 0. Psi falls, so x2 -> e_Psi is one to one and keeps the orientation; with det A > 0 there is at
most one equilibrium C, of index 1. A closed orbit G is a simple closed curve of index 1: it surrounds C. (That there
is a C, |e_C| < 1, need not be checked: without it there is no G, and by 1 below no polygon either.)

Places are homogeneous, (X, Y, W), W = 0 or 1, x2 = (X, Y)/W: a place with W = 0 lies on the equator, and edges are
straight in x2. A certificate holds

- *walks*: polygons all of whose edges U crosses from the right to the left, or all from the left to the right;
- *rings*: triangles between two polygons, the inner one part of one walk and the outer one of another, with a number h
  at each corner, linear between. All triangles go round to the left, so a place P lies in wind(outer, P) -
  wind(inner, P) of them. Seen from a place that the ring names, both polygons go once round, always to the left: they
  are simple.

1. *A polygon of a ring goes round C.* U is nowhere along it, so U turns as often as the polygon does on the way round,
   once; this is the sum of the indices inside.
2. *A walk lies inside each G, or outside it, as a whole*, even where it crosses itself: where it meets G it passes
   from one and the same side of G to the other; but closed, or led from the equator to the equator, it must pass as
   often back. So it never meets G.
3. *No cycle near C.* The first ring is a fan about a place c, bounded by a polygon P of the first walk that is seen
   from c as above, and its weighted divergence ``div F + F.grad h``, that of exp(h) F over exp(h), has one sign. Were
   P outside some G, P would go round all of G and its inside as it goes round C: once (1). So they lie in the fan, and
   the divergence, integrated over the inside of G, would be 0 (Green), which it is not. The first walk is inside G.
4. *One cycle in a ring*, if the inner and the outer polygon I, O are crossed into the ring, or both out of it, and its
   weighted divergence has one sign. As wind(O, .) - wind(I, .) is nowhere negative, I lies in O, and each place between
   them in one triangle: h is one function there, continuous. C is inside I. So the ring holds a closed orbit (Poincare
   and Bendixson). Two would both go round C, one inside the other, and over what is between them the divergence would
   be 0 (Green, Dulac). So there is exactly one; by the same sign it is hyperbolic.
5. *No other.* The first walk is inside each G. The last one comes from the equator, outside all G; or the last ring
   reaches up to the equator. Let I be inside some G and O outside, or on the equator. Then wind(I, .) is 0 on G and
   wind(O, .) is 1, that of C: each place of G lies in one triangle of the ring. If ``ln h - 2 ln q``, h now of degree 1
   in (X, Y, W), rises along all orbits there, or falls, there is no such G; if the weighted divergence has one sign, by
   4 there is one at most. Could G have O of a later ring inside, and I outside? Its places would lie in -1 triangles.
   So each G belongs to one ring, and each ring that is counted has one.

Only what is here counted on the fingers stands proved: `check.py` looks at each edge and triangle with intervals that
are rounded outwards: what a component of U is on it is bounded by its value at one place, and slopes from there to the
corners. How the certificate was found, by the other modules, proves nothing.
"""
