"""What the plots show, in words; written by hand after a full run, and to be read again after the next."""

WORDS = """Run time against error: the lower left corner is best. Ours is the heavy blue curve. All ran on one thread,
in turns; ratios are medians of ratios within a turn. Of SciPy one by one, four of the 64 trajectories ran. A method's
loosest setting is often better than what was asked, so that its cost at a large error is flat.

Trajectories. 64 of them, on 24 problems, from 1e-3 to 1e-12: ours is 300 to 2500 times faster than SciPy one by one, 20
to 200 times faster than SciPy with all stacked in one system, 6 to 25 times faster than Numba-LSODA and diffrax, and
about twice as fast as heyoka's Taylor method in batches of eight, by far the best of the others. Not good: ours has
the fixed order eight, so heyoka, whose order grows with the tolerance, comes level at 1e-12 where Ψ = 1, and is a
fifth faster there on so(2,1), the one problem in which no orbit comes to rest and no step may grow. A Taylor method in
our SIMD lanes for Ψ = 1, where the field is a cubic, would remove that. Past a saddle, where errors grow ten thousand
times, ours stops at 2e-12: that is the rounding of more and shorter steps than heyoka's; sums with compensation would
help. Compiling is not counted: heyoka compiles each system at each tolerance (about a second), diffrax each formula
(seconds), ours once.

Limit directions. All methods have the digits; what differs is the count. Sampling misses pairs near a saddle-node, as
it must; numpy.roots is right until the pair is closer than the square root of rounding; ours is never wrong, and pays
up to half a millisecond with exact integers there. Away from saddle-nodes it costs two thirds of numpy.roots. For a
general system an interpolation with numpy.roots, its degree guessed, takes half the time of ours, which proves its
count. For one e-linear critical set numpy.linalg.solve is five times faster: it gives e, ours gives the point, its
eigenvalues and its kind.

Cycles and separatrices. One call finds the cycle, its period to 14 digits and its multiplier in the time in which
SciPy, told where the cycle is, gets five digits. Separatrices take two milliseconds at any error, a quarter to a
thirtieth of SciPy's time.

Motions. A motion that is long, or whose system comes again, is followed compiled; its first few hundred steps are
taken in Python, which costs less than compiling. On the ball and on sliding that is not unique, the best of SciPy with
a compiled right-hand side takes 1.5 to 9 times as long at equal error, and least at loose tolerances, where our error
is better than was asked. Compiling a system's formulas takes about a second and is not counted. In the nonsmooth limit
SciPy, told by hand where the event is and what follows, is ten times faster than `simulate_nonsmooth`, which finds
that out. The distance of the regularised motion from the limit is proportional to eps, until an exit through the
equator, after which its power depends on Psi.

Scene. A new default frame takes one and a half milliseconds, 40 percent of it trajectories; these grow linearly with
their number, and by a factor of three from rtol 1e-2 to 1e-12; the pixel and the view hardly matter. In Case III the
search for cycles takes two thirds of a frame of seven milliseconds: the one layer that dominates."""
