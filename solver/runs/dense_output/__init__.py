"""Trajectories read at any time: accepted steps made again, and evaluated inside."""
