"""``/v1/scenes``: the mechanisms that a job can name."""
