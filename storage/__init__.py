"""Records: the catalogue of jobs and the store of their results."""
