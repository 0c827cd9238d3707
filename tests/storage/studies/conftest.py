"""Made-up studies of several shapes, in memory: of thousands of small files only bytes count."""

import os
import tempfile
from pathlib import Path

import pytest
from made_up_studies import MadeUpStudy, made_up_layout

MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
SHAPES = {
    "a chunk a block": made_up_layout(),
    "one chunk for all blocks": made_up_layout(points=10, blocks=((0, 5), (5, 3), (8, 2))),
    "chunks on boundaries": made_up_layout(points=20, record=3000, blocks=((0, 11), (11, 9))),
    "more sections than a chunk": made_up_layout(points=10, record=9000, blocks=((0, 8), (8, 2))),
}
STEP = {"more sections than a chunk": 1000, "chunks on boundaries": 500}


@pytest.fixture
def tmp_path():
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        (Path(folder) / "test").mkdir()  # stores are sealed beside their folders
        yield Path(folder) / "test"


@pytest.fixture(params=SHAPES)
def shape(request):
    return request.param


@pytest.fixture
def study(shape):
    return MadeUpStudy(SHAPES[shape])


@pytest.fixture
def step(shape):
    return STEP.get(shape, 2)


@pytest.fixture
def undisturbed(tmp_path, study):
    return study.write(tmp_path / "undisturbed").read_bytes()
