"""Methods that know no system: zeros of functions, intervals, one implicit integrator."""
