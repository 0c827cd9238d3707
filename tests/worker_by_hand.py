"""A worker that is played by hand, and what it has done for the service in the thread."""

import threading
from collections.abc import Sequence
from typing import Any

import httpx
import numpy as np
import pytest
from numpy.typing import NDArray

from jointplay.records.impact import IMPACT
from jointplay.records.job import JobError
from jointplay.records.peak import Peak
from jointplay.records.point import PointEnd, SectionRows, StudySlice
from jointplay.records.run import CertificateRecord
from jointplay.records.run_rows import RunRows
from jointplay.solver.kinds import KINDS, Admission, Study, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, Claim
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.writer import ResultWriter
from jointplay.storage.settings import Settings
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.store import create, seal
from jointplay.worker.block_run import BlockRun
from jointplay.worker.execute import Answer, Progress, execute
from jointplay.worker.layouts import layout_of_study

LEDGER = (
    "driver_work",
    "gravity_work",
    "contact_loss",
    "friction_loss",
    "element_loss",
    "kinetic_change",
    "stored_change",
    "gross_work",
    "residual",
)


BIFURCATION: dict[str, Any] = {
    "kind": "bifurcation",
    "parameter": "clearance",
    "values": {"from": 1e-4, "to": 1e-3, "count": 20},
    "record": 6,
    "indicators": ["lyapunov"],
    "tolerance": 1e-6,
}
"""Three blocks: points 0 to 7, 8 to 15, 16 to 19."""
SWEEP: dict[str, Any] = {
    "kind": "sweep",
    "grid": {"clearance": [1e-4, 2e-4, 3e-4], "friction": [0.0, 0.05]},
    "periods": 1,
    "statistics": ["mean", "contact_share"],
}
CHART: dict[str, Any] = {
    "kind": "chart",
    "along": {"parameter": "clearance", "values": {"from": 1e-4, "to": 1e-3, "count": 300}},
    "by": {"parameter": "friction", "values": [0.0, 0.02, 0.05, 0.1, 0.15]},
    "settle": 2,
    "record": 3,
    "indicators": ["recurrence"],
}
"""Two tiles wide, five points high."""
SENSITIVITY: dict[str, Any] = {
    "kind": "sensitivity",
    "parameters": {
        "clearance_A": {"distribution": "uniform", "low": 1e-4, "high": 5e-4},
        "clearance_B": {"distribution": "triangular", "low": 1e-4, "mode": 2e-4, "high": 3e-4},
    },
    "samples": 4,
    "periods": 1,
    "channels": ["displacement"],
    "statistics": ["mean", "impacts"],
}
"""Two blocks of eight points, each of two rows."""
ACCURACY_STUDY: dict[str, Any] = {
    "kind": "accuracy-study",
    "duration": 0.003,
    "methods": ["tsitouras", "rk4"],
    "tolerances": [1e-4, 1e-8],
}
"""Two references, two tolerances, six steps, and the default."""


def known_section(point: Any, column: Any, section: Any) -> NDArray[np.float64]:
    """Values that the worker played by hand records for an observable's column at a section."""
    return np.asarray(1e-5 * (100.0 * point + 10.0 * column + section), dtype=np.float64)


class Worker:
    """Does what a worker does, by hand: known numbers instead of a simulation."""

    def __init__(self, http: httpx.Client, catalogue: Catalogue, settings: Settings) -> None:
        self._http = http
        self._catalogue = catalogue
        self._settings = settings

    def submit(self, **fields: Any) -> str:
        job: dict[str, Any] = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}}
        if fields.get("kind", "simulate") == "simulate":
            job |= {"duration": 2.0, "certificate": False}
        job["cache"] = False  # each test's job is its own
        answer = self._http.post("/v1/jobs", json=job | fields)
        assert answer.status_code == 202, answer.text
        return str(answer.json()["id"])

    def start(self, job_id: str, index: int = 0) -> Claim:
        block = self._catalogue.blocks(job_id)[index]
        claim = self._catalogue.claim_block(block.id, "test", 60.0)
        assert claim is not None
        return claim

    def store(
        self,
        claim: Claim,
        *,
        complete: bool = True,
        certificate: CertificateRecord | None = None,
        impacts: int = 1,
    ) -> None:
        """Store value = column + time, peaks -1 and 1, and impacts without a release."""
        admission, writer, target = self._writer(claim)
        channels = admission.channels
        time = np.linspace(0.0, admission.job["duration"], admission.samples)
        section_time = np.arange(float(admission.sections))
        columns = np.arange(float(len(channels)))
        rows = np.array(impacts * [(1, 0.5, np.nan, 0.01, 100.0, 0.2)], IMPACT)
        writer.append(
            RunRows(
                sample_time=time,
                samples=columns + time[:, None],
                section_time=section_time,
                sections=columns + section_time[:, None],
                impacts=rows,
            )
        )
        peaks = {channel.name: Peak(-1.0, 0.25, 1.0, 0.75) for channel in channels}
        energy = dict.fromkeys(LEDGER, 0.0) | {"driver_work": 2.5, "residual": 1e-6}
        summary = {"steps": 7, "rejections": 1, "onsets": 2, "smallest_step": 1e-6}
        summary |= {"solver_seconds": 0.25, "energy": energy}
        writer.seal(
            target, peaks=peaks, summary=summary, complete=complete, certificate=certificate
        )

    def store_nothing(self, claim: Claim) -> None:
        """Seal the results of a run that ended before its first sample."""
        _, writer, target = self._writer(claim)
        writer.seal(target, peaks={}, summary={}, complete=False)

    def _writer(self, claim: Claim) -> tuple[Admission, ResultWriter, StoredObject]:
        admission = admit(claim.job.spec)
        assert isinstance(admission, Admission)
        attempt = claim.job.id, claim.block.attempt
        channels = admission.channels
        attributes = {"job": admission.job, "scene": admission.scene_document(), "section_note": ""}
        layout = ResultLayout(
            channels, admission.samples, admission.sections, admission.joints, attributes
        )
        folder = self._settings.running_run(*attempt).folder
        return admission, ResultWriter.create(folder, layout), self._settings.sealed_run(*attempt)

    def run(self, claim: Claim, *, reports: int | None = None) -> None:
        """Compute a simulation as a worker does; with `reports`, only so far, and commit it."""
        admission = admit(claim.job.spec)
        assert isinstance(admission, Admission)
        attempt = claim.job.id, claim.block.attempt
        folder = self._settings.running_run(*attempt).folder
        heard = 0

        def report(progress: Progress) -> Answer:
            nonlocal heard
            heard += 1
            if reports is None or heard < reports:
                return Answer.go_on
            name, watermark = progress.keep()
            self._catalogue.record_checkpoint(
                claim.block.id, claim.block.attempt, watermark=watermark, checkpoint=name
            )
            return Answer.leave

        execute(admission, folder, self._settings.sealed_run(*attempt), report=report)

    def work(self, job_id: str) -> None:
        """Compute a job to its end as a worker does."""
        while not self._catalogue.get(job_id).state.terminal:
            for block in self._catalogue.blocks(job_id):
                claim = self._catalogue.claim_block(block.id, "test", 60.0)
                if claim is not None:
                    BlockRun(self._catalogue, self._settings, claim, threading.Event()).run()

    def compute(
        self,
        claim: Claim,
        *,
        failing: Sequence[int] = (),
        points: int | None = None,
        sections: int | None = None,
    ) -> None:
        """Fill the first `points` of a study's block (all by default) as `known_section` says.

        The last of them gets as many sections as given and does not end.
        """
        study = admit(claim.job.spec)
        assert isinstance(study, Study)
        folder = self._settings.running_study(claim.job.id).folder
        layout = layout_of_study(study)
        create(folder, layout)
        first, count = study.blocks[claim.block.index]
        last = first + (count if points is None else points)
        rows, ended = [], []
        for point in range(first, last):
            going = sections is not None and point == last - 1
            recorded = sections if going else 3 if point in failing else study.record
            if study.observables:
                time = 100.0 + np.arange(float(recorded))
                columns = np.arange(len(study.observables))
                values = known_section(point, columns[None, :], np.arange(recorded)[:, None])
                rows.append(SectionRows(point, 0, time, values))
            if not going:
                ended.append(self._ended(study, point, failed=point in failing))
        block = StudyBlock(folder, layout, claim.block.index, claim.block.attempt)
        block.take(StudySlice(1.0, tuple(range(first, last)), tuple(rows), tuple(ended)))
        block.flush(b"")
        if points is None and sections is None:
            block.finish()

    @staticmethod
    def _ended(study: Study, point: int, *, failed: bool) -> PointEnd:
        peaks = np.empty((0, 4))
        if study.channels:
            peaks = np.array([(-1.0 - point, 0.25, 1.0 + point, 0.75)] * len(study.channels))
        indicators = {"verdict": float(point % 4), "lyapunov": 0.1 * point, "lyapunov_error": 0.01}
        return PointEnd(
            point,
            "step-size-underflow" if failed else "",
            "The step fell below 1e-15 s." if failed else "",
            0.7,
            np.full_like(peaks, np.nan) if failed else peaks,
            {"steps": 1000.0 + point}
            | ({"inherited": float(point % 2)} if study.refine else {})
            | ({} if failed else dict.fromkeys(KINDS[study.kind].outputs(study), 0.5 * point)),
            indicators if study.indicators and not failed else {},
            f"point {point} was judged" if study.indicators and not failed else "",
        )

    def finished_study(self, *, failing: Sequence[int] = (), **fields: Any) -> str:
        """A study that succeeded, with its results."""
        job_id = self.submit(**fields)
        study = admit(self._catalogue.get(job_id).spec)
        assert isinstance(study, Study)
        for index in range(len(study.blocks)):
            claim = self.start(job_id, index)
            self.compute(claim, failing=failing)
            self.finish(claim, BlockState.done)
        claim = self.start(job_id, len(study.blocks))
        running, target = self._settings.running_study(job_id), self._settings.sealed_study(job_id)
        seal(running.folder, layout_of_study(study), target)
        self.finish(claim, BlockState.done)
        return job_id

    def finish(self, claim: Claim, outcome: BlockState, error: JobError | None = None) -> None:
        self._catalogue.finish(claim.block.id, claim.block.attempt, BlockEnd(outcome, error))

    def finished(self, **fields: Any) -> str:
        """A job that succeeded, with its results."""
        claim = self.start(self.submit(**fields))
        self.store(claim)
        self.finish(claim, BlockState.done)
        return claim.job.id


@pytest.fixture(scope="session")
def worker(http: httpx.Client, catalogue: Catalogue, settings: Settings) -> Worker:
    return Worker(http, catalogue, settings)


@pytest.fixture(scope="session")
def finished_study(worker: Worker) -> str:
    """A bifurcation diagram, of which points 3 and 17 failed."""
    return worker.finished_study(**BIFURCATION, failing=(3, 17), label="finished study")


@pytest.fixture(scope="session")
def finished_sweep(worker: Worker) -> str:
    """A sweep, of which point 4 failed."""
    return worker.finished_study(**SWEEP, failing=(4,))


@pytest.fixture(scope="session")
def finished_accuracy(worker: Worker) -> str:
    return worker.finished_study(**ACCURACY_STUDY)


@pytest.fixture(scope="session")
def finished_job(worker: Worker) -> str:
    return worker.finished(label="finished")
