"""Along one parameter, and over two: bifurcation diagrams and maps of classes."""
