"""Runs an admitted job, in slices that each return to Python within a quarter of a second."""

from __future__ import annotations

import io
import json
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from solver.admission import Admission, section_offset
from solver.assembly import assemble
from solver.compile_loop import compile_loop_aside
from solver.compiler.kernel import LEDGER, Kernel, compile_kernel
from solver.errors import SimulationFailed
from solver.ideal.run import IdealRun
from solver.integrators import METHODS
from solver.lanes.bundle import Bundle, LaneProblem
from solver.lanes.prescribed import prescribed_peaks
from solver.lanes.state import Counter, Setting, Status
from solver.mechanics.tree import spanning_tree
from solver.results import IMPACT, Floats, Peak, Slice, Summary
from solver.scene.document import Scene

SLICE_SECONDS = 0.1
"""Aimed-at time in kernels between returns to Python; the limit is a quarter of a second."""
FIRST_BUDGET = 2000
LARGEST_BUDGET = 200_000
"""Attempted steps a call."""
MOST_STEPS = 4_000_000_000
"""Accepted steps of one run: days of computing."""
PACE_STEPS, SLOWEST_PACE = 200_000, 1e-5
"""Fewer periods than SLOWEST_PACE in PACE_STEPS steps are no progress: the run ends."""
LANE = 0
"""The lane that a single run uses; the seven others idle, and its bits do not depend on them."""


class Simulation:
    """One trajectory: `slices` computes it, `checkpoint` between slices restarts it bit for bit."""

    def __init__(self, admission: Admission, checkpoint: bytes | None = None) -> None:
        """Compile or load the kernel and set the start, or the checkpoint.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        self.admission = admission
        scene = Scene.model_validate(admission.scene)
        self._run: _Run = (
            IdealRun(admission, scene)
            if assemble(scene).freedom_with_play == 0
            else DynamicRun(admission, scene)
        )
        if checkpoint is not None:
            self._run.restore(checkpoint)

    def slices(self) -> Iterator[Slice]:
        """Yield what each slice computed, until the run is over.

        Raises
        ------
        SimulationFailed
            After everything that was computed has been yielded.
        """
        return self._run.slices()

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        return self._run.checkpoint()

    def summary(self) -> Summary:
        """Return extremes and statistics of what has been computed so far."""
        return self._run.summary()


class DynamicRun:
    """A run of a scene that moves freely somewhere: lane 0 of a bundle."""

    def __init__(self, admission: Admission, scene: Scene) -> None:
        self.admission = admission
        job = admission.job
        tree = spanning_tree(scene)
        aside = compile_loop_aside()
        self.kernel: Kernel = compile_kernel(scene, tree, job["formulation"], METHODS["tsitouras5"])
        if aside is not None:
            aside.wait()
        offset = 0.0
        if admission.period is not None:
            angle = job["section"]["crank_angle"]
            offset = section_offset(scene, admission.period, angle)
        problem = LaneProblem(
            scene,
            job["duration"],
            admission.tolerance,
            job["output_step"],
            admission.samples,
            admission.sections,
            offset,
        )
        self.bundle = Bundle(self.kernel, [problem])
        rows = self.kernel.rows
        self.columns = np.array([rows.index(c.name) for c in admission.channels], dtype=np.int64)
        self.first_energy = self._energy()
        self.seconds = 0.0
        self.samples_done = 0
        self.sections_done = 0

    def slices(self) -> Iterator[Slice]:
        """See `Simulation.slices`."""
        budget = FIRST_BUDGET
        mark = (0.0, self.bundle.time(LANE))
        while self.bundle.counters[Counter.STATUS, LANE] == Status.RUNNING:
            begun = time.perf_counter()
            self.bundle.advance(budget)
            found = self._slice()
            spent = time.perf_counter() - begun
            self.seconds += spent
            mark = self._pace(mark)
            budget = int(min(max(budget * SLICE_SECONDS / spent, 100), LARGEST_BUDGET, 4 * budget))
            yield found
        status = Status(self.bundle.counters[Counter.STATUS, LANE])
        if status != Status.DONE:
            raise self._failure(status)

    def _pace(self, mark: tuple[float, float]) -> tuple[float, float]:
        """Stop a run that has used up its steps or hardly moves; `mark` is (steps, time)."""
        steps, now = float(self.bundle.table("steps")[0, LANE]), self.bundle.time(LANE)
        status = self.bundle.counters[Counter.STATUS]
        if status[LANE] != Status.RUNNING or steps - mark[0] < PACE_STEPS:
            return mark
        period = float(self.bundle.settings[Setting.PERIOD, LANE])
        if now - mark[1] < SLOWEST_PACE * period:
            status[LANE] = Status.UNDERFLOW
        elif steps >= MOST_STEPS:
            status[LANE] = Status.STEP_LIMIT
        return steps, now

    def checkpoint(self) -> bytes:
        """See `Simulation.checkpoint`."""
        facts = {
            "solver_seconds": self.seconds,
            "samples": self.samples_done,
            "sections": self.sections_done,
            "first_energy": self.first_energy,
        }
        buffer = io.BytesIO()
        np.savez(
            buffer,
            state=np.frombuffer(self.bundle.state(), dtype=np.uint8),
            facts=np.frombuffer(json.dumps(facts).encode(), dtype=np.uint8),
        )
        return buffer.getvalue()

    def restore(self, checkpoint: bytes) -> None:
        """Continue from a checkpoint."""
        with np.load(io.BytesIO(checkpoint), allow_pickle=False) as saved:
            facts = json.loads(saved["facts"].tobytes())
            self.bundle.restore(saved["state"].tobytes())
        self.seconds = facts["solver_seconds"]
        self.samples_done, self.sections_done = facts["samples"], facts["sections"]
        self.first_energy = facts["first_energy"]

    def summary(self) -> Summary:
        """See `Simulation.summary`."""
        peaks = self._peaks()
        counters = self.bundle.counters[:, LANE]
        steps = int(self.bundle.table("steps")[0, LANE])
        statistics: dict[str, Any] = {
            "steps": steps,
            "rejections": int(counters[Counter.REJECTIONS]),
            "onsets": int(counters[Counter.ONSETS]),
            "smallest_step": float(self.bundle.table("smallest_step")[0, LANE]) if steps else None,
            "solver_seconds": self.seconds,
            "energy": self._ledger(),
        }
        return Summary(peaks, statistics)

    def _peaks(self) -> dict[str, Peak]:
        rows, table = self.kernel.rows, self.bundle.table
        records = [
            table(f"{block}0", rows.scanned)[:, LANE]
            for block in ("lowest", "lowest_time", "highest", "highest_time")
        ]
        found = {
            name: Peak(*(float(column[r]) for column in records))
            for r, name in enumerate(rows.watched)
        }
        for name, (source, factor, offset) in rows.multiples.items():
            found[name] = found[source].scaled(factor, offset)
        names = [channel.name for channel in self.admission.channels]
        unwatched = [name for name in names if name not in found]
        if unwatched:
            found |= prescribed_peaks(self.bundle, LANE, unwatched, self.bundle.time(LANE))
        return {name: found[name] for name in names}

    def _slice(self) -> Slice:
        counters = self.bundle.counters
        samples, sample_time = self._observe(self.bundle.sample_rows, Counter.SAMPLE_ROWS)
        sections, section_time = self._observe(self.bundle.section_rows, Counter.SECTION_ROWS)
        rows = self.bundle.impact_rows[LANE, : counters[Counter.IMPACT_ROWS, LANE]]
        impacts = np.zeros(len(rows), dtype=IMPACT)
        for column, name in enumerate(IMPACT.names or ()):
            impacts[name] = rows[:, column]
        first_sample, first_section = self.samples_done, self.sections_done
        self.samples_done += len(samples)
        self.sections_done += len(sections)
        reached = self.bundle.time(LANE)
        duration = self.admission.job["duration"]
        if self.samples_done == self.admission.samples:
            sample_time[-1] = reached = duration
        return Slice(
            reached,
            min(reached / duration, 1.0),
            first_sample,
            sample_time,
            samples,
            first_section,
            section_time,
            sections,
            impacts,
        )

    def _observe(self, buffer: Floats, counter: Counter) -> tuple[Floats, Floats]:
        rows = buffer[LANE, : self.bundle.counters[counter, LANE]]
        out = self.bundle.observe(LANE, rows, self.columns)
        return out, rows[:, 0] * self.bundle.settings[Setting.PERIOD, LANE] + rows[:, 1]

    def _energy(self) -> dict[str, float]:
        rows = self.kernel.rows
        self.kernel.module.observe_rest(self.bundle.work)

        def value(name: str) -> float:
            row = rows.index(name)
            block = "previous" if row < rows.scanned else "channel"
            return float(self.bundle.table(f"{block}{row}")[0, LANE])

        return {
            "kinetic": value("energy.kinetic"),
            "potential": value("energy.potential"),
            "stored": value("stored"),
        }

    def _ledger(self) -> dict[str, float]:
        """Energy at the end less at the start must be the work put in less what was lost, J."""
        driver, contact, friction = (float(x) for x in self.bundle.table("total0", LEDGER)[:, LANE])
        now, first = self._energy(), self.first_energy
        change = {key: now[key] - first[key] for key in now}
        gravity = -change["potential"]
        gained = change["kinetic"] + change["stored"]
        return {
            "driver_work": driver,
            "gravity_work": gravity,
            "contact_loss": contact,
            "friction_loss": friction,
            "kinetic_change": change["kinetic"],
            "stored_change": change["stored"],
            "residual": gained - driver - gravity + contact + friction,
        }

    def _failure(self, status: Status) -> SimulationFailed:
        at = self.bundle.time(LANE)
        step = float(self.bundle.table("next_step")[0, LANE])
        steps = int(self.bundle.table("steps")[0, LANE])
        tolerance = self.admission.tolerance
        if status == Status.UNDERFLOW:
            return SimulationFailed(
                "step-size-underflow",
                f"The step fell to {step:.3g} s at t = {at:.9g} s after {steps} steps: the motion"
                f" cannot be followed at tolerance {tolerance:g}. Try a larger tolerance, a lower"
                " contact stiffness, or a wider gap between static_velocity and dynamic_velocity.",
                at,
            )
        if status == Status.STEP_LIMIT:
            return SimulationFailed(
                "step-limit",
                f"{steps} steps were made by t = {at:.9g} s, the limit of a run. Ask for a shorter"
                " duration or a larger tolerance.",
                at,
            )
        return SimulationFailed(
            "onset-not-located",
            f"The beginning of a contact near t = {at:.9g} s could not be located to 1e-9 m."
            " Try a smaller tolerance.",
            at,
        )


_Run = DynamicRun | IdealRun
