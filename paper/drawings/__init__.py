"""The figures that compare runs; all of column width, drawn on the page of `jointplay.figures`.

One figure a file, each with a function that takes the folder of stores and returns PNG bytes.
"""
