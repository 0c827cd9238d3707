"""``/v1/jobs/{id}/events``: streams of what happens to jobs."""
