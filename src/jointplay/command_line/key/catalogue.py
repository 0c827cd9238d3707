"""The catalogue that keys are in, and how a key is shown."""

from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

if TYPE_CHECKING:
    from jointplay.storage.catalogue.catalogue import Catalogue
    from jointplay.storage.catalogue.keys import Key

DATA = Annotated[
    Path | None,
    typer.Option(
        "--data",
        metavar="FOLDER",
        help="Of the service; by default JOINTPLAY_DATA. JOINTPLAY_CATALOGUE_URL counts, too.",
    ),
]
HERE: Final = None


@contextmanager
def catalogue_at(data: Path | None) -> Iterator["Catalogue"]:
    """Open the catalogue of a service, which need not run."""
    from jointplay.service.processes.supervisor import settings_of
    from jointplay.storage.catalogue.catalogue import Catalogue

    catalogue = Catalogue(settings_of(data).catalogue_url)
    try:
        catalogue.migrate()
        yield catalogue
    finally:
        catalogue.close()


def shown(key: "Key") -> dict[str, Any]:
    """Return the document of a key, without its digest."""
    times = ("created", "expires", "revoked", "last_used")
    document = {"id": key.id, "owner": key.owner, "scopes": sorted(key.scopes), "note": key.note}
    return document | {name: _moment(getattr(key, name)) for name in times}


def _moment(seconds: float | None) -> str | None:
    if seconds is None:
        return None
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="seconds")
