"""``/v1/jobs/{id}/...``: what a finished job computed."""
