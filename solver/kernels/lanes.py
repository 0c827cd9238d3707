"""Number of lanes that kernels advance at once."""

LANES = 8
"""Runs side by side in a vector register."""
