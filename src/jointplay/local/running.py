"""`run` and `resume`: what a client's methods do, without a service."""

import atexit
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay import jobs
from jointplay.client.errors import FieldProblem, NotFound, Refused
from jointplay.client.job import Job
from jointplay.local.folder_job import load
from jointplay.progress import progress as shown
from jointplay.scene_choice import Scene
from jointplay.worker.local.devices import Lanes, lanes_of

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study


def run(
    job: Scene,
    *,
    output: Path | str | None = None,
    processes: int | None = None,
    device: str = "cpu",
    progress: bool = False,
    check: bool = True,
    **given: Any,
) -> Job:
    """Compute a job here and now, and return it finished, as a client would have it.

    Parameters
    ----------
    job
        A job document, as `jointplay.jobs` makes them; or a scene, with the fields of
        `jointplay.jobs.simulate` and parameters beside: ``run("pendulum", duration=1, mass=2)``.
    output
        Folder to make for the results; by default a temporary one that goes with this process.
    processes
        Of a study; by default one for each core, or one beside a device.
    device
        ``cuda:0``: the first graphics processor computes the points of a study, to the same bits.
        Several processes have it in turns: the others prepare and judge points. ``auto``: the first
        that is made for double precision, if there is one and it computes such a job.
    progress
        Show a bar on stderr.
    check
        Raise if the job does not succeed.
    given
        Of a scene: fields and parameters.

    Raises
    ------
    jointplay.client.Refused
        The job cannot be run as it is described; ``fields`` says why.
    jointplay.client.JobFailed, jointplay.client.JobCancelled
        It failed, or Ctrl-C or another signal ended it; what had been computed can be read, and
        `resume` goes on from there.
    FileExistsError
        The folder is there already.
    """
    if not (isinstance(job, Mapping) and "kind" in job):
        job = jobs.simulate(job, **given)
    elif given:
        name = next(iter(given))
        raise TypeError(f"the job is given whole; {name!r} goes into its document")
    admission = _admitted(job)
    with _refusals():
        lanes = lanes_of(device, admission)
    if output is not None:
        folder = Path(output)
        folder.mkdir(parents=True)
    else:
        folder = Path(tempfile.mkdtemp(prefix="jointplay-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    title = folder.name if output is not None else "run"
    shown_as = title if progress else None
    return _computed(admission, folder, processes, lanes, shown_as, check=check)


def resume(
    folder: Path | str,
    *,
    processes: int | None = None,
    device: str = "cpu",
    progress: bool = False,
    check: bool = True,
) -> Job:
    """Go on with a run that was cut short, and return it finished; with one that ended, do nothing.

    It goes on from its last restart point, at most seconds before it was cut short, and gives the
    same bits as a run in one piece.

    Parameters
    ----------
    folder
        That `run` made, or the command ``jointplay run``.
    processes, device, progress, check
        As for `run`.

    Raises
    ------
    jointplay.client.NotFound
        No run was begun there.
    jointplay.client.JobFailed, jointplay.client.JobCancelled
        As for `run`.
    BlockingIOError
        Another process is computing it.
    """
    admission = unfinished(Path(folder))
    if admission is not None:
        with _refusals():
            lanes = lanes_of(device, admission)
        title = Path(folder).name if progress else None
        return _computed(admission, Path(folder), processes, lanes, title, check=check)
    found = load(folder)
    if check:
        found.check()
    return found


def unfinished(folder: Path) -> "Admission | Study | None":
    """Return the job of a run that was cut short; None of one that ended by itself.

    Raises
    ------
    jointplay.client.NotFound
        No run was begun there.
    jointplay.client.Refused
        Its ``job.json`` is not what was written.
    """
    from jointplay.records.strict_json import MalformedJson, parse
    from jointplay.worker.local.ending import ended
    from jointplay.worker.local.folder import JOB_FILE

    path = folder / JOB_FILE
    try:
        document = parse(path.read_bytes())
    except (FileNotFoundError, NotADirectoryError):
        sentence = f"{folder} holds no run: give the folder that a run was begun in."
        raise NotFound(sentence) from None
    except MalformedJson as error:
        raise Refused(f"{path}: {error}") from None
    if not isinstance(document, dict):
        raise Refused(f"{path}: a job is a JSON object.")
    return None if ended(folder) else _begun(document)


def _computed(
    admission: "Admission | Study",
    folder: Path,
    processes: int | None,
    lanes: Lanes | None,
    title: str | None,
    *,
    check: bool,
) -> Job:
    """Compute into a folder, with a bar if it has a title, and return the finished job."""
    with shown(title) if title else nullcontext(lambda fraction, note: None) as report:
        from jointplay.worker.local.computing import compute

        compute(admission, folder, processes, report, lanes)
    found = load(folder)
    if check:
        found.check()
    return found


def _begun(document: dict[str, Any]) -> "Admission | Study":
    """Return a stored job as it was admitted, maybe by a version that refused less than this."""
    from jointplay.records.failure import InvalidInput
    from jointplay.solver.kinds import parse

    try:
        return parse(document)
    except (InvalidInput, KeyError):  # of a version whose documents this one cannot read
        return _admitted(document)


def _admitted(document: Mapping[str, Any]) -> "Admission | Study":
    from jointplay.solver.kinds import admit

    with _refusals():
        return admit(dict(document))


@contextmanager
def _refusals() -> Iterator[None]:
    """Say as a client does what is wrong with a job."""
    from jointplay.records.failure import InvalidInput, LimitExceeded

    try:
        yield
    except InvalidInput as error:
        raise Refused(
            str(error),
            problem="limit-exceeded" if isinstance(error, LimitExceeded) else "invalid-job",
            fields=[FieldProblem(*problem) for problem in error.problems],
        ) from None
