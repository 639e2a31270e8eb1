"""Connections of saddles over two parameters: loops, cycles and single connections."""
