"""Studies to be stored: noise, because any bit may matter, in the order in which lanes compute."""

from dataclasses import replace

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.coarse_to_fine import coarse_to_fine
from jointplay.records.point import PointEnd, SectionRows, StudySlice
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.store import create, seal
from tests.stores import packed, target


def made_up_layout(points=20, record=7, blocks=None, observables=2, channels=3, attributes=None):
    return StudyLayout(
        parameters=(Channel("clearance", "m", "radial clearance"),),
        values=np.linspace(1e-4, 1e-3, points)[:, None],
        observables=tuple(
            Channel(f"slider7.q{index}", "m", f"coordinate {index}")
            for index in range(observables if record else 0)
        ),
        record=record,
        channels=tuple(Channel(f"A.force{index}", "N", "force") for index in range(channels)),
        blocks=octets(points) if blocks is None else blocks,
        attributes={"job": {"kind": "bifurcation"}, "verdicts": ["undecided", "periodic"]}
        if attributes is None
        else attributes,
        outputs={"energy_residual": Channel("energy_residual", "J", "what the ledger lacks")},
    )


def made_up_map(rows, columns, **fields):
    """Return the layout of points over two axes, coarse to fine; the first axis falls."""
    points = rows * columns
    y, x = np.geomspace(0.2, 0.1, rows), np.linspace(-3.0, 3.0, columns)
    values = np.column_stack([np.repeat(y, columns), np.tile(x, rows)])
    values = values[coarse_to_fine((rows, columns))]
    (clearance,) = made_up_layout(points=points).parameters
    parameters = (Channel("friction", "1", "coefficient of friction"), clearance)
    plain = made_up_layout(points=points, **fields)
    return replace(plain, parameters=parameters, values=values, shape=(rows, columns))


def octets(points):
    return tuple((first, min(8, points - first)) for first in range(0, points, 8))


class MadeUpStudy:
    """Everything that the blocks of a study would hand over.

    Points fail that are in `failing`; every third one has fewer sections than the others.
    """

    def __init__(self, layout, failing=(3,), seed=0):
        random = np.random.default_rng(seed)
        self.layout = layout
        points, record = layout.points, layout.record
        self.failing = set(failing) & set(range(points))
        self.counts = np.full(points, record)
        self.counts[::3] = random.integers(0, record + 1, len(self.counts[::3]))
        self.sections = random.normal(size=(points, record, len(layout.observables)))
        self.times = np.arange(points * record, dtype=float).reshape(points, record)
        for point, count in enumerate(self.counts):
            self.sections[point, count:] = self.times[point, count:] = np.nan
        self.peaks = random.normal(size=(points, len(layout.channels), 4))
        self.steps = random.integers(1, 100, points).astype(float)
        self.exponents = random.normal(size=points)

    def slices(self, index, step=None, lanes=8):
        """Compute a block as lanes do: several points at a time, each at its own pace."""
        step = step or max(3, self.layout.record // 50)
        first, count = self.layout.blocks[index]
        waiting = list(range(first, first + count))
        reached = {}
        ended = 0
        while waiting or reached:
            started = []
            while waiting and len(reached) < lanes:
                started.append(waiting.pop(0))
                reached[started[-1]] = 0
            rows, ends = [], []
            for point, known in list(reached.items()):
                stop = min(known + step + point % 2, self.counts[point])
                if stop > known:
                    rows.append(self.rows(point, known, stop))
                reached[point] = stop
                if stop == self.counts[point]:
                    ends.append(self.end(point))
                    del reached[point]
            ended += len(ends)
            yield StudySlice(ended / count, tuple(started), tuple(rows), tuple(ends))

    def rows(self, point, first, stop):
        rows = slice(first, stop)
        return SectionRows(point, first, self.times[point, rows], self.sections[point, rows])

    def end(self, point):
        failed = point in self.failing
        return PointEnd(
            point,
            "step-size-underflow" if failed else "",
            f"point {point} cannot go on" if failed else "",
            0.1 * point,
            self.peaks[point],
            {"steps": self.steps[point], "energy_residual": -1e-9},
            {} if failed else {"lyapunov": self.exponents[point], "verdict": 1.0},
            "" if failed else f"point {point} recurs",
        )

    def write_block(self, folder, index):
        block = StudyBlock(folder, self.layout, index)
        for piece in self.slices(index):
            block.take(piece)
        block.finish()

    def write(self, folder):
        """Store and seal the whole study, block after block."""
        create(folder, self.layout)
        for index in range(len(self.layout.blocks)):
            self.write_block(folder, index)
        seal(folder, self.layout, target(folder))
        return packed(folder)
