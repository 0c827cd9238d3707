"""Why results that a worker hands in are not taken."""


class NotTheJobs(Exception):
    """Results are not those of the block that they were handed in for, and it is taken back."""
