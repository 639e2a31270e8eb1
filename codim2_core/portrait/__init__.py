"""One phase portrait: its name, nullclines, separatrices, where orbits end."""
