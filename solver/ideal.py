"""The ideal mechanism: nothing moves freely, so kinematics and inverse dynamics suffice.

Many instants at once: the same constraint rows as everywhere, on arrays of instants. Newton's
iteration starts from a neighbouring instant; the mechanism repeats after a period.
"""

from __future__ import annotations

import io
import math
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from solver.admission import Admission, section_offset
from solver.assembly import ASSEMBLED, assemble, shortest_link
from solver.drive import characteristic_time
from solver.errors import SimulationFailed
from solver.extremes import refine_extreme
from solver.lanes.clock import product_difference
from solver.mechanics.absolute import AbsoluteMechanism, Row
from solver.mechanics.motion import BodyMotion, Motion
from solver.mechanics.observe import channel_values
from solver.mechanics.reactions import joint_reactions
from solver.mechanics.view import view
from solver.results import IMPACT, Floats, Peak, Slice, Summary
from solver.scene.document import Scene

INSTANTS_A_PERIOD = 96
"""Poses solved one after the other; all others start from the nearest of them."""
MOST_ITERATIONS = 25
SCAN_A_PERIOD = 2000
"""Instants at which extremes are first sought; parabolas and re-evaluation refine them."""
SAMPLES_A_SLICE = 4000


class IdealRun:
    """A run of a scene whose drivers leave no freedom."""

    def __init__(self, admission: Admission, scene: Scene) -> None:
        self.admission = admission
        self.scene = scene
        self.numbers = view(scene)
        self.mechanism = AbsoluteMechanism(scene, self.numbers, close_play=True)
        self.length = shortest_link(scene)
        self.unit = admission.period or characteristic_time(scene, self.length)
        self.names = [channel.name for channel in admission.channels]
        self.samples_done = 0
        self.seconds = 0.0
        self.table: Floats = np.empty((0, 0))
        self.start = assemble(scene)

    def slices(self) -> Iterator[Slice]:
        """See `Simulation.slices`."""
        job, samples = self.admission.job, self.admission.samples
        while self.samples_done < samples:
            begun = time.perf_counter()
            first = self.samples_done
            last = min(first + SAMPLES_A_SLICE, samples)
            index = np.arange(first, last, dtype=np.float64)
            times = index * job["output_step"]
            local = self._local(index, job["output_step"])
            if last == samples:
                times[-1] = job["duration"]
                local[-1] = self._local(np.ones(1), job["duration"])[0]
            values = self.channels(times, local)
            section_times: Floats = np.empty(0, np.float64)
            offset = 0.0
            if last == samples and self.admission.period is not None:
                offset = section_offset(
                    self.scene, self.admission.period, job["section"]["crank_angle"]
                )
                section_times = offset + self.admission.period * np.arange(
                    self.admission.sections, dtype=np.float64
                )
            sections = self.channels(section_times, np.full(len(section_times), offset))
            self.samples_done = last
            self.seconds += time.perf_counter() - begun
            yield Slice(
                float(times[-1]),
                last / samples,
                first,
                times,
                values,
                0,
                section_times,
                sections,
                np.zeros(0, dtype=IMPACT),
            )

    def checkpoint(self) -> bytes:
        """See `Simulation.checkpoint`."""
        buffer = io.BytesIO()
        np.save(buffer, np.array([self.samples_done, self.seconds]))
        return buffer.getvalue()

    def restore(self, checkpoint: bytes) -> None:
        """Continue from a checkpoint."""
        done, self.seconds = np.load(io.BytesIO(checkpoint), allow_pickle=False)
        self.samples_done = int(done)

    def summary(self) -> Summary:
        """See `Simulation.summary`; extremes are found on the exact motion."""
        duration = self.admission.job["duration"]
        span = min(duration, self.unit) if self.admission.period else duration
        count = max(math.ceil(SCAN_A_PERIOD * span / self.unit), 16)
        times = np.linspace(0.0, span, min(count, 200_000) + 1)
        peaks = self._peaks(times)
        if duration > span:  # angles that go on turning are extreme in the last period
            for name, late in self._peaks(times + (duration - span)).items():
                early = peaks[name]
                low = min(early, late, key=lambda peak: peak.minimum)
                high = max(early, late, key=lambda peak: peak.maximum)
                peaks[name] = Peak(low.minimum, low.minimum_time, high.maximum, high.maximum_time)
        statistics: dict[str, Any] = {
            "steps": 0,
            "rejections": 0,
            "onsets": 0,
            "smallest_step": None,
            "solver_seconds": self.seconds,
            "energy": None,
        }
        return Summary(peaks, statistics)

    def _peaks(self, times: Floats) -> dict[str, Peak]:
        values = self.channels(times)
        peaks = {}
        for c, name in enumerate(self.names):
            column = values[:, c]
            if column.min() == column.max():
                peaks[name] = Peak(float(column[0]), 0.0, float(column[0]), 0.0)
                continue
            low_time, low = refine_extreme(self._channel(c), times, column, -1.0)
            high_time, high = refine_extreme(self._channel(c), times, column, 1.0)
            peaks[name] = Peak(low, low_time, high, high_time)
        return peaks

    def channels(self, times: Floats, local: Floats | None = None) -> Floats:
        """Return (instants, channels) at times in s; `local` is the time within the period."""
        if not len(times):
            return np.empty((0, len(self.names)))
        if local is None:
            local = self._local(np.ones(len(times)), times)
        values = channel_values(self.numbers, self.motion(times, local))
        columns = [np.broadcast_to(values[name], times.shape) for name in self.names]
        return np.stack(columns, axis=1)

    def _channel(self, column: int) -> Callable[[Floats], Floats]:
        return lambda times: self.channels(times)[:, column]

    def motion(self, times: Floats, local: Floats) -> Motion:
        """Return the mechanism's motion and all forces at times in s, local within the period."""
        driven = self._driven(local)
        q, turned = self._poses(times, local, driven)
        n = q.shape[1]
        still = np.zeros_like(q)
        rows = self.mechanism.rows(_columns(q), _columns(still), driven)
        jacobian = _jacobian(rows, len(times), n)
        rates = np.stack([np.broadcast_to(row.rate, times.shape) for row in rows], axis=1)
        v = _solve(jacobian, -rates)
        rows = self.mechanism.rows(_columns(q), _columns(v), driven)
        gamma = np.stack([np.broadcast_to(row.gamma, times.shape) for row in rows], axis=1)
        a = _solve(jacobian, gamma)
        force = self._inertia_and_gravity(a)
        multipliers = _solve(jacobian.transpose(0, 2, 1), force)
        bodies = {
            name: BodyMotion(
                (q[:, 3 * i], q[:, 3 * i + 1]),
                q[:, 3 * i + 2] + turned[:, 3 * i + 2],
                (v[:, 3 * i], v[:, 3 * i + 1]),
                v[:, 3 * i + 2],
                (a[:, 3 * i], a[:, 3 * i + 1]),
                a[:, 3 * i + 2],
            )
            for i, name in enumerate(self.mechanism.bodies)
        }
        forces, efforts = joint_reactions(
            self.scene, self.mechanism, rows, list(_columns(multipliers))
        )
        speeds = {name: driver.speed for name, driver in self.numbers.drivers.items()}
        return Motion(list(_columns(a)), bodies, {}, forces, efforts, speeds)

    def _inertia_and_gravity(self, accelerations: Floats) -> Floats:
        """Return g - M q̈ of eq. (23), which the multipliers balance."""
        gx, gy = self.numbers.gravity
        force = np.empty_like(accelerations)
        for i, name in enumerate(self.mechanism.bodies):
            body = self.numbers.bodies[name]
            force[:, 3 * i] = body.mass * (gx - accelerations[:, 3 * i])
            force[:, 3 * i + 1] = body.mass * (gy - accelerations[:, 3 * i + 1])
            force[:, 3 * i + 2] = -body.inertia * accelerations[:, 3 * i + 2]
        return force

    def _local(self, count: Floats, step: float | Floats) -> Floats:
        """Return count * step less whole periods, with the rounding of both products undone."""
        period = self.admission.period
        times = count * step
        if period is None:
            return times
        local = product_difference.py_func(count, step, np.floor(times / period), period)
        return np.asarray(local, np.float64)

    def _driven(self, local: Floats) -> dict[str, Floats]:
        return {
            name: driver.position + driver.speed * local
            for name, driver in self.scene.drivers.items()
        }

    def _poses(
        self, times: Floats, local: Floats, driven: dict[str, Floats]
    ) -> tuple[Floats, Floats]:
        """Return poses within a period, and the whole turns that angles have made before."""
        if not self.table.size:
            self.table = self._follow()
        spacing = self.unit / INSTANTS_A_PERIOD
        period = self.admission.period
        nearest = np.clip(np.rint(local / spacing).astype(int), 0, len(self.table) - 1)
        poses = self._newton(self.table[nearest], driven, times)
        turned = np.zeros_like(poses)
        if period is not None:  # angles go on turning; trigonometry does not need to know
            turns = np.rint((self.table[-1] - self.table[0]) / (2.0 * math.pi))
            turned = 2.0 * math.pi * np.rint((times - local) / period)[:, None] * turns
        return poses, turned

    def _follow(self) -> Floats:
        """Solve poses along the motion, each from the one before."""
        span = self.unit if self.admission.period else self.admission.job["duration"]
        count = math.ceil(span / self.unit * INSTANTS_A_PERIOD) + 1
        poses = np.empty((count, len(self.start.pose)))
        pose, before = self.start.pose, self.start.pose
        for k in range(count):
            moment = np.array([k * self.unit / INSTANTS_A_PERIOD])
            driven = {
                name: driver.position + driver.speed * moment
                for name, driver in self.scene.drivers.items()
            }
            guess = 2.0 * pose - before if k > 1 else pose
            before, pose = pose, self._newton(guess[None, :], driven, moment)[0]
            poses[k] = pose
        return poses

    def _newton(self, guess: Floats, driven: dict[str, Floats], times: Floats) -> Floats:
        q = guess.copy()
        n = q.shape[1]
        still = np.zeros_like(q)
        scale = np.tile([self.length, self.length, 1.0], n // 3)
        for _ in range(MOST_ITERATIONS):
            rows = self.mechanism.rows(_columns(q), _columns(still), driven)
            values = np.stack([np.broadcast_to(row.value, times.shape) for row in rows], axis=1)
            step = _solve(_jacobian(rows, len(times), n), -values)
            q += step
            largest = float(np.abs(step / scale).max())
            if not np.isfinite(largest) or largest < 1e-13:
                break
        if not largest < ASSEMBLED:
            lost = float(times[int(np.abs(step / scale).max(axis=1).argmax())])
            raise SimulationFailed(
                "assembly-lost",
                f"The ideal mechanism cannot be closed near t = {lost:.6g} s: it passes a dead"
                " point or its links do not reach. Change lengths, driver positions or speeds.",
                lost,
            )
        return q


def _columns(array: Floats) -> list[Floats]:
    return [array[:, i] for i in range(array.shape[1])]


def _jacobian(rows: list[Row], count: int, n: int) -> Floats:
    jacobian = np.zeros((count, len(rows), n))
    for i, row in enumerate(rows):
        for k, entry in row.jacobian.items():
            jacobian[:, i, k] = entry
    return jacobian


def _solve(matrix: Floats, right: Floats) -> Floats:
    solution = np.linalg.solve(matrix, right[..., None])[..., 0]
    return np.asarray(solution, np.float64)
