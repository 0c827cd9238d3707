"""Periodic orbits of driven mechanisms, followed over a parameter."""
