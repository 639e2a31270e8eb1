"""One phase portrait: its name, separatrices, where orbits end."""
