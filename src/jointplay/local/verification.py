"""A finished job computed again, here and now, and compared with what is stored of it."""

import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any
from zlib import crc32

import zarr

from jointplay.client.job import Job
from jointplay.local.certificate_bars import beyond_bars
from jointplay.local.folder_job import load
from jointplay.local.repeated_calibration import compared_findings
from jointplay.storage.packed.reading import Entry
from jointplay.storage.packed.zarr_store import FilesStore
from jointplay.storage.results.comparison import (
    Compared,
    compared_arrays,
    differing_attributes,
)

Report = Callable[[float, str], None]
_FILES = 4  # kept of a store: arrays read the last one in ranges


class NotRepeatable(Exception):
    """The job did not end by itself, so that a repetition has no end to be compared with."""


@dataclass(frozen=True)
class Verification:
    """Outcome of a repetition."""

    id: str
    states: tuple[str, str]
    """States in which the job and its repetition ended."""
    versions: tuple[str | None, str]
    """Versions of the solver that computed it, and of this one."""
    arrays: tuple[Compared, ...]
    attributes: tuple[str, ...]
    """Names of those that differ."""
    beyond: tuple[str, ...] | None
    """Channels that differ by more than the certificates' bars where the motion is converged; None
    if nothing differs, or there are no bars."""

    @property
    def promised(self) -> bool:
        """Whether equal bits are promised: only the same solver gives the same bits."""
        return self.versions[0] == self.versions[1]

    @property
    def differing(self) -> tuple[Compared, ...]:
        """Arrays that differ."""
        return tuple(one for one in self.arrays if one.differing)

    @property
    def equal(self) -> bool:
        """Whether everything is equal, bit for bit."""
        return not self.differing and not self.attributes and self.states[0] == self.states[1]

    @property
    def holds(self) -> bool:
        """Whether promises hold: equal bits, or of another solver results within bars."""
        same_end = self.states[0] == self.states[1]
        return self.equal or (same_end and not self.promised and self.beyond == ())

    def document(self) -> dict[str, Any]:
        """Return it as JSON has it."""
        derived = {name: getattr(self, name) for name in ("promised", "equal", "holds")}
        return asdict(self) | derived


def verify(job: Job, processes: int | None, report: Report) -> Verification:
    """Compute a job again in a temporary folder; nothing of the stored one is touched.

    Parameters
    ----------
    job
        In a folder, or of a service.
    processes
        Of a study; by default one for each core.
    report
        Called several times a second with the fraction of the whole, and a few words.

    Raises
    ------
    NotRepeatable
        It is not finished, was cancelled, or was ended by a limit or by the platform.
    jointplay.client.JobFailed
        A process of the repetition died.
    jointplay.client.errors.Damaged, jointplay.storage.errors.CorruptStore
        What is stored is not what was.
    """
    from jointplay.solver.kinds import parse
    from jointplay.solver.version import SOLVER_VERSION
    from jointplay.worker.local.computing import compute

    _insist(job)
    stored = _root(job)
    with tempfile.TemporaryDirectory(prefix="jointplay-") as name:
        folder = Path(name)
        compute(parse(dict(job.job)), folder, processes, report)
        again = load(folder)
        if again.state == "cancelled":
            raise KeyboardInterrupt
        if again.error is not None and again.error.error_class == "platform":
            again.check()
        ours = _root(again)
        arrays = tuple(compared_arrays(stored, ours))
        attributes = tuple(differing_attributes(stored, ours))
        if "calibration" in job.links and job.state == again.state == "succeeded":
            found, others = compared_findings(job.calibration, again.calibration)
            arrays, attributes = arrays + found, attributes + others
        return Verification(
            job.id,
            (job.state, again.state),
            (job.solver_version, SOLVER_VERSION),
            arrays,
            attributes,
            beyond_bars((job, again), (stored, ours), arrays),
        )


def verified_calibration(
    name: str, stored: Mapping[str, Any], again: Mapping[str, Any]
) -> Verification:
    """Compare what `jointplay calibrate` left with its repetition."""
    states = "succeeded", "succeeded"
    versions = stored.get("solver"), again["solver"]
    return Verification(name, states, versions, *compared_findings(stored, again), None)


def _insist(job: Job) -> None:
    if not job.is_finished:
        raise NotRepeatable(f"{job.id} is {job.state}; it is compared when it has ended.")
    error = job.error
    if job.state == "succeeded" or (error is not None and error.error_class == "solver"):
        return
    why = "" if error is None else f" ({error.code})"
    raise NotRepeatable(
        f"{job.id} is {job.state}{why}; only what ended by itself ends alike when it is repeated."
    )


def _root(job: Job) -> zarr.Group:
    files = FilesStore(_Fetched(job.results.content))
    return zarr.open_group(files, mode="r", zarr_format=3)


class _Fetched:
    """Files of a store, each fetched whole."""

    def __init__(self, fetch: Callable[[str], bytes]) -> None:
        self._fetch = lru_cache(maxsize=_FILES)(fetch)

    def __iter__(self) -> Iterator[str]:
        return iter(())  # the root's document lists all there is

    def entry(self, key: str) -> Entry:
        """Fetch a file and describe it."""
        content = self._fetch(key)
        return Entry(0, len(content), crc32(content))

    def read(self, key: str, start: int = 0, stop: int | None = None) -> bytes:
        """Fetch a file, or take bytes [start, stop) of it."""
        return self._fetch(key)[start:stop]
