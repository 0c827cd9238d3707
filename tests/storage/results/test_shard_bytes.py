"""The bytes of a shard follow from its rows alone."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numcodecs import blosc

from jointplay.storage.errors import CorruptStore
from jointplay.storage.results import shards
from jointplay.storage.results.layout import Partition

LONG = 32 * 16_384  # a whole shard of the default partition


@pytest.mark.parametrize("chunk_rows", [16_384, LONG])
def test_threads_do_not_show_in_the_bytes(chunk_rows):
    rows = np.cumsum(np.random.default_rng(0).normal(size=LONG))
    here = shards.encode(rows, chunk_rows, LONG)
    with ThreadPoolExecutor(1) as elsewhere:
        assert elsewhere.submit(shards.encode, rows, chunk_rows, LONG).result() == here
    before = blosc.get_nthreads()
    blosc.set_nthreads(1 if before > 1 else 4)
    try:
        assert shards.encode(rows, chunk_rows, LONG) == here
    finally:
        blosc.set_nthreads(before)


def test_a_chunk_that_says_it_has_more_values_is_not_decoded():
    bomb = shards.compress(np.zeros(2**24))
    assert len(bomb) < 2**20
    with pytest.raises(CorruptStore, match="134217728 bytes of values instead of 131072"):
        shards.decompress(bomb, np.dtype("<f8"), 16_384)
    sound = shards.compress(np.arange(16_384.0))
    assert shards.decompress(sound, np.dtype("<f8"), 16_384)[-1] == 16_383.0
    for cut in (sound[:10], sound[:-1], sound[:16] + b"\xff" * (len(sound) - 16)):
        with pytest.raises(CorruptStore):
            shards.decompress(cut, np.dtype("<f8"), 16_384)


@pytest.mark.parametrize(
    ("capacity", "columns", "cut"),
    [
        (0, 96, (1, 1)),
        (2001, 96, (2001, 2001)),  # the default history is one chunk
        (20_000, 96, (16_384, 32_768)),
        (10_000_000, 96, (16_384, 32_768)),  # 25 MB wait for their shard
        (10_000_000, 7, (16_384, 32 * 16_384)),
        (10_000_000, 2000, (2048, 2048)),  # whole buckets of the pyramid
        (None, 6, (16_384, 32 * 16_384)),
    ],
)
def test_tables_are_cut_within_the_bounds(capacity, columns, cut):
    partition = Partition()
    chunk_rows, shard_rows = partition.cut(capacity, 8 * columns)
    assert (chunk_rows, shard_rows) == cut
    assert shard_rows % chunk_rows == 0
    assert shard_rows * 8 * columns <= partition.buffer_bytes
