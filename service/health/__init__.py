"""``/healthz`` and ``/readyz``: for the service's supervisor."""
