"""Figures that compare runs, all of column width, drawn on the page of `jointplay.figures`.

Each member draws one kind of figure from stores and returns the bytes of a PNG file.
"""
