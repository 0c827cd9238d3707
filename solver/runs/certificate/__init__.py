"""Certificates of trajectories: errors and horizons from seven companions in the bundle."""
