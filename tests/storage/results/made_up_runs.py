"""Rows to be stored: noise, because any bit may matter, with every kind of row."""

import os
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.records.run_rows import RunRows
from jointplay.storage.results.layout import Partition, ResultLayout
from jointplay.storage.results.writer import ResultWriter
from tests.stores import packed, target

# many small stores: there fsync costs nothing, and it is their bytes that count
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None

SMALL_FILES = Partition(chunk_rows=4, shard_chunks=3, buffer_bytes=2**20)
PLAIN_FILES = Partition(chunk_rows=4, shard_chunks=1, buffer_bytes=2**20)


def made_up_layout(samples, sections, channels=2, partition=SMALL_FILES, attributes=None, steps=()):
    return ResultLayout(
        channels=tuple(
            Channel(f"slider7.q{index}", "m", f"coordinate {index}") for index in range(channels)
        ),
        samples=samples,
        sections=sections,
        joints=("A", "B"),
        attributes={"job": {"kind": "simulate"}} if attributes is None else attributes,
        partition=partition,
        steps=steps,
        steps_period=0.5 if steps else 0.0,
    )


@dataclass
class MadeUpRun:
    """Everything that a run would hand over, to be appended in slices."""

    layout: ResultLayout
    impacts: np.ndarray
    seed: int = 0

    def __post_init__(self):
        random = np.random.default_rng(self.seed)
        width = len(self.layout.channels)
        self.time = np.linspace(0.0, 2.0, self.layout.samples)
        self.samples = random.normal(size=(self.layout.samples, width))
        self.section_time = np.arange(float(self.layout.sections))
        self.sections = random.normal(size=(self.layout.sections, width))
        self.steps = random.normal(size=(3 * self.layout.samples, len(self.layout.steps)))
        self.peaks = {
            channel.name: Peak(*random.normal(size=4)) for channel in self.layout.channels
        }

    def append(self, writer, start, stop):
        """Append the part from one fraction of the run to another."""
        rows = slice(cut(start, len(self.time)), cut(stop, len(self.time)))
        sections = slice(cut(start, len(self.section_time)), cut(stop, len(self.section_time)))
        steps = slice(cut(start, len(self.steps)), cut(stop, len(self.steps)))
        impacts = slice(cut(start, len(self.impacts)), cut(stop, len(self.impacts)))
        writer.append(
            RunRows(
                first_sample=rows.start,
                sample_time=self.time[rows],
                samples=self.samples[rows],
                first_section=sections.start,
                section_time=self.section_time[sections],
                sections=self.sections[sections],
                impacts=self.impacts[impacts],
                steps=self.steps[steps],
            )
        )

    def write(self, folder, fractions=(0.0, 1.0)):
        """Store the whole run, sliced at the given fractions, and seal it; return the file."""
        writer = ResultWriter.create(folder, self.layout)
        for start, stop in pairwise(fractions):
            self.append(writer, start, stop)
        writer.seal(target(folder), peaks=self.peaks, summary={"steps": 3})
        return packed(folder)


def made_up_impacts(count, seed=1):
    random = np.random.default_rng(seed)
    impacts = np.empty(count, IMPACT)
    impacts["joint"] = random.integers(0, 2, count)
    for name in IMPACT.names[1:]:
        impacts[name] = random.normal(size=count)
    return impacts


def cut(fraction, rows):
    return round(fraction * rows)
