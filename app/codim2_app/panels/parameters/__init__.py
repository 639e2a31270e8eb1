"""Panels over one or two parameters: atlas, diagram, planes, and the axes along which these run."""
