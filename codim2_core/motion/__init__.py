"""Motions in time: regularised (eps > 0) and nonsmooth (eps -> 0), of one contact or several; periodic ones."""
