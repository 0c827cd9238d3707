"""``/v1/jobs/{id}/bifurcation`` and its siblings: many points of a study, also while it runs."""
