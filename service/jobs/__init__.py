"""``/v1/jobs``: submit, list, look at and cancel jobs."""
