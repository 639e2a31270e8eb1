"""Nullclines on the hemisphere and outside it: closed conics, or traced curves."""
