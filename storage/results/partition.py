"""Partition of a table's rows into chunks and shards."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Partition:
    """Bounds for cutting a table; the defaults suit histories of any length.

    Parameters
    ----------
    chunk_rows
        Rows that are compressed together. 16 384 doubles are 128 KiB, which the compressor
        takes as one block: with several blocks its output would depend on its threads.
    shard_chunks
        Most chunks in one file.
    buffer_bytes
        Most bytes of one table that wait in memory for their shard to fill.
    pyramid_above
        A history of more samples gets a pyramid of extremes.
    bucket
        Samples of the finest extremes.
    level_rows
        Extremes of a level in one file, a multiple of 16.
    """

    chunk_rows: int = 16_384
    shard_chunks: int = 32
    buffer_bytes: int = 32 * 2**20
    pyramid_above: int = 16_384
    bucket: int = 64
    level_rows: int = 1024

    def cut(self, capacity: int | None, row_bytes: int) -> tuple[int, int]:
        """Give rows of a chunk and of a shard; a shard is a whole number of chunks.

        Parameters
        ----------
        capacity
            Rows of the complete table; None if that is not known beforehand.
        row_bytes
            Bytes of one row over all columns.
        """
        if capacity is not None and capacity <= self.chunk_rows:
            return max(capacity, 1), max(capacity, 1)
        fitting = self.buffer_bytes // row_bytes
        if fitting < self.chunk_rows:
            if fitting > self.bucket:
                fitting -= fitting % self.bucket
            return max(fitting, 1), max(fitting, 1)
        chunks = min(fitting // self.chunk_rows, self.shard_chunks)
        if capacity is not None:
            chunks = min(chunks, -(-capacity // self.chunk_rows))
        return self.chunk_rows, chunks * self.chunk_rows
