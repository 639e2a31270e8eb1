"""Branches of limit cycles along one parameter."""
