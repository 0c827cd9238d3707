"""Where services of tests keep what they have: in files, or in PostgreSQL and a bucket."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import pytest

from jointplay.storage.settings import Settings
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store

BACKENDS = ["folder", pytest.param("bucket", marks=pytest.mark.long)]
"""SQLite and a folder; PostgreSQL and a bucket."""


@contextmanager
def backends(kind: str) -> Iterator[dict[str, str]]:
    """Yield the variables that tell a service its catalogue and object store, which are empty."""
    if kind == "folder":
        yield {}
        return
    with running_server() as server, running_store() as endpoint:
        yield {
            "JOINTPLAY_CATALOGUE_URL": server.new(),
            "JOINTPLAY_RESULTS_URL": f"s3://{BUCKET}/lab?endpoint={endpoint}",
        }


def settings_at(data: Path, variables: Mapping[str, str]) -> Settings:
    """Return the settings of a service that has these variables."""
    return Settings(
        data=data,
        catalogue_url=variables.get("JOINTPLAY_CATALOGUE_URL", ""),
        results_url=variables.get("JOINTPLAY_RESULTS_URL", ""),
    )
