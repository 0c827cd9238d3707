"""Folders in memory: these tests write thousands of small files, and only bytes count."""

import os
import tempfile
from pathlib import Path

import pytest

MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


@pytest.fixture
def tmp_path():
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        (Path(folder) / "test").mkdir()  # stores are sealed beside their folders
        yield Path(folder) / "test"
