"""``/v1/jobs/{id}/...``: results, as far as the job has committed them."""
