"""Methods that know no system: zeros of functions, intervals, curves of zeros, one implicit integrator."""
