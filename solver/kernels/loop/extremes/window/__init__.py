"""Extremes in a window of time, sought in its stored steps."""
