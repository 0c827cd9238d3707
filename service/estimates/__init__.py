"""``/v1/estimates``: what a job will cost, before anything is queued."""
