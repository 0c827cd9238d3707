"""URL of a Redis that is reached through a socket in a folder of any name."""

from pathlib import Path
from urllib.parse import quote


def socket_url(path: Path) -> str:
    """Return a URL that Celery and redis-py take; what URLs reserve in the path is quoted."""
    return f"unix://{quote(str(path))}"
