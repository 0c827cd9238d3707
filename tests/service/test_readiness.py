"""A service is ready if it can store what it computes."""

import os
import tempfile
from contextlib import closing
from pathlib import Path

import pytest

from jointplay.service.readiness import Readiness
from jointplay.service.vital import VitalThreads
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.installation import require_own_files
from jointplay.storage.settings import Settings
from tests.service.processes.test_writable import NOBODY, without_root


def test_who_cannot_write_results_is_not_ready() -> None:
    """As where their disk has become read-only, and the data folder has another."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        disk = folder / "disk"
        settings = Settings(data=folder / "data", results_url=f"file:{disk}")
        settings.data.mkdir()
        disk.mkdir()
        with closing(Catalogue(settings.catalogue_url)) as catalogue:
            catalogue.migrate()
            require_own_files(settings, catalogue)
            if os.geteuid() == 0:
                for path in (folder, *folder.rglob("*")):
                    os.chown(path, NOBODY, -1)
            ready = Readiness(catalogue, settings, VitalThreads())
            with without_root():
                ready.prove()
                disk.chmod(0o500)
                with pytest.raises(PermissionError):
                    ready.prove()
                disk.chmod(0o700)
                ready.prove()
