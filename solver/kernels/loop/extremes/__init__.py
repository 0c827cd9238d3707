"""Extremes of channels, sought inside the steps: see README.md."""
