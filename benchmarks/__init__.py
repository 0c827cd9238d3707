"""Measurements of this machine: `make bench`, or a module of its own by name."""
