"""The layer problem: critical sets, the equator, the charts of the hemisphere."""
