"""Folders in memory: these tests write thousands of small files, and only bytes count."""

import tempfile
from pathlib import Path

import pytest
from made_up_runs import MEMORY


@pytest.fixture
def tmp_path():
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        yield Path(folder)
