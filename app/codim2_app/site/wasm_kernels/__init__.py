"""The core's kernels, as Numba compiles them, in WebAssembly: for pages that compute where the visitor is."""
