"""Shapes, colours and words: glyphs, polylines, formulas, the Bokeh figure, SVG, HoloViews."""
