"""`run`: what a client's methods do, without a service."""

import atexit
import shutil
import tempfile
from collections.abc import Mapping
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay import jobs
from jointplay.client.errors import FieldProblem, Refused
from jointplay.client.job import Job
from jointplay.local.folder_job import load
from jointplay.progress import progress as shown
from jointplay.scene_choice import Scene

if TYPE_CHECKING:
    from jointplay.solver.kinds import Admission, Study


def run(
    job: Scene,
    *,
    output: Path | str | None = None,
    processes: int | None = None,
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
        Of a study; by default one for each core.
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
        It failed, or Ctrl-C was pressed; what had been computed can be read.
    FileExistsError
        The folder is there already.
    """
    if not (isinstance(job, Mapping) and "kind" in job):
        job = jobs.simulate(job, **given)
    elif given:
        name = next(iter(given))
        raise TypeError(f"the job is given whole; {name!r} goes into its document")
    admission = _admitted(job)
    if output is not None:
        folder = Path(output)
        folder.mkdir(parents=True)
    else:
        folder = Path(tempfile.mkdtemp(prefix="jointplay-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    title = folder.name if output is not None else "run"
    with shown(title) if progress else nullcontext(lambda fraction, note: None) as report:
        from jointplay.worker.local.computing import compute

        compute(admission, folder, processes, report)
    found = load(folder)
    if check:
        found.check()
    return found


def _admitted(document: Mapping[str, Any]) -> "Admission | Study":
    from jointplay.records.failure import InvalidInput, LimitExceeded
    from jointplay.solver.kinds import admit

    try:
        return admit(dict(document))
    except InvalidInput as error:
        raise Refused(
            str(error),
            problem="limit-exceeded" if isinstance(error, LimitExceeded) else "invalid-job",
            fields=[FieldProblem(*problem) for problem in error.problems],
        ) from None
