"""``/healthz`` and ``/readyz``: for whoever supervises the service."""
