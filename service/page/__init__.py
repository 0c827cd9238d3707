"""``/``: the page for browsers, its files, and the reference of the API at ``/docs``."""
