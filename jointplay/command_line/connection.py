"""The service that commands talk to."""

from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from jointplay.client import Client

URL = Annotated[
    str,
    typer.Option("--url", envvar="JOINTPLAY_URL", help="Address of the service."),
]
DEFAULT_URL = "http://127.0.0.1:8000"  # jointplay.client's, without loading it


def connect(url: str) -> "Client":
    """Return a client of the service at ``url``; nothing is sent yet."""
    from jointplay.client import Client

    return Client(url)
