"""The one-parameter diagram of a general system: at single values, by bisection between them, and named."""
