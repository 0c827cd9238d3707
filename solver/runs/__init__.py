"""Runs of a mechanism: simulations, studies, ideal mechanisms, certificates."""
