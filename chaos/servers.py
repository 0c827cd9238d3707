"""Servers that an installation under faults is given: a database, and a store behind a gate each.

Without any it has a file and a folder of its own.
"""

from typing import Final
from urllib.parse import parse_qs, urlencode, urlsplit

from sqlalchemy import make_url

from jointplay.chaos.gate import Gate
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.object_stores import object_store_at

_PORT: Final = 5432  # of PostgreSQL, where the address names none


class NotEmpty(Exception):
    """A server's store that a campaign was given is somebody's, or cannot be reached."""


def require_empty(catalogue_url: str, results_url: str) -> None:
    """Refuse a database that has tables, and an object store that has objects, with NotEmpty."""
    if catalogue_url:
        catalogue = Catalogue(catalogue_url)
        found = ", ".join(catalogue.flaws()) or "has tables"
        catalogue.close()
        if not found.startswith("has no tables"):
            raise NotEmpty(f"--catalogue {found}; give the address of an empty database")
    if results_url and any(True for _ in object_store_at(results_url).list("")):
        raise NotEmpty("--results has objects; give the address of an empty one")


def database_behind_gate(url: str) -> tuple[str, Gate | None]:
    """Return the address of a gate before a database, and the gate; none before a file."""
    parsed = make_url(url or "sqlite://")
    if parsed.get_backend_name() != "postgresql" or not parsed.host:
        return url, None
    gate = Gate(parsed.host, parsed.port or _PORT)
    through = parsed.set(host="127.0.0.1", port=gate.port)
    return through.render_as_string(hide_password=False), gate


def store_behind_gate(url: str) -> tuple[str, Gate | None]:
    """Return the address of a gate before a store, and the gate; none where TLS would notice."""
    parts = urlsplit(url)
    options = {name: value for name, (value, *_) in parse_qs(parts.query).items()}
    endpoint = urlsplit(options.get("endpoint", ""))
    if endpoint.scheme != "http" or not endpoint.hostname:
        return url, None
    gate = Gate(endpoint.hostname, endpoint.port or 80)
    options["endpoint"] = f"http://127.0.0.1:{gate.port}"
    return parts._replace(query=urlencode(options)).geturl(), gate
