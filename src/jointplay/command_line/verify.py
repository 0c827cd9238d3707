"""``jointplay verify``: a job computed again, and compared bit for bit."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.calibrate import computed
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import AS_JSON, DEFAULT_URL, PROCESSES, URL, job_of
from jointplay.command_line.output import aligned, print_result, remark

if TYPE_CHECKING:
    from jointplay.client.job import Job
    from jointplay.local.verification import Verification
    from jointplay.storage.results.comparison import Compared

_MOST_ROWS = 20


def verify(
    results: Annotated[
        str,
        typer.Argument(
            metavar="OUT|ID|FILE.json",
            help="Folder of `jointplay run`, id of a job, or what `jointplay calibrate` left.",
        ),
    ],
    processes: PROCESSES = None,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Compute a finished job again, on this machine, and compare every stored array bit for bit.

    The stored job is not touched.  Equal bits are promised where the same version of the solver
    computed it; of another version a simulation is compared within its certificate's bars.  Exit
    code 0: that holds; 1: it does not, and the table says where.  A service that the job is of then
    computes it anew when its document is submitted again.

    Example: `jointplay verify 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    if results.endswith(".json") and Path(results).is_file():
        found = _calibration(Path(results), processes)
    else:
        found = _job(results, url, processes)
    print_result(found.document(), _lines(found), as_json=as_json)
    if not found.holds:
        raise Stopped(_verdict(found), Exit.CHECK_FAILED)


def _job(results: str, url: str, processes: int | None) -> "Verification":
    from jointplay.client.errors import Damaged
    from jointplay.local.verification import NotRepeatable
    from jointplay.local.verification import verify as repeat
    from jointplay.progress import progress
    from jointplay.storage.errors import CorruptStore

    try:
        with job_of(results, url) as job:
            with progress("verifying") as report:
                found = repeat(job, processes, report)
            if found.promised and not found.holds:
                _report_mismatch(job)
            return found
    except NotRepeatable as error:
        raise Stopped(str(error)) from None
    except (CorruptStore, Damaged) as error:
        line = f"damaged, there is nothing to compare: {error}"
        raise Stopped(line, Exit.CHECK_FAILED) from None


def _report_mismatch(job: "Job") -> None:
    """Have the service answer no more submissions with a job whose repetition gave other bits."""
    from jointplay.client.errors import ClientError
    from jointplay.client.service_job import ServiceJob

    if not isinstance(job, ServiceJob):
        return
    try:
        job.report_mismatch()
        line = "the service computes it anew when its document is submitted again"
    except ClientError as error:
        line = f"the service does not note it: {error}; `jointplay submit --anew` computes it again"
    remark([line])


def _calibration(path: Path, processes: int | None) -> "Verification":
    from jointplay.local.verification import verified_calibration
    from jointplay.records.strict_json import parse
    from jointplay.solver.kinds import admit_calibration

    stored = parse(path.read_bytes())
    if not isinstance(stored, dict) or "calibration" not in stored:
        raise Stopped(f"{path} is not what `jointplay calibrate` left, nor a folder of results.")
    again = computed(admit_calibration(stored["calibration"]), processes).document()
    return verified_calibration(str(path), stored, again)


def _lines(found: "Verification") -> Iterator[str]:
    equal = [one for one in found.arrays if not one.differing]
    values = sum(one.values for one in equal)
    yield f"{len(equal)} of {len(found.arrays)} arrays are equal bit for bit, {values} values"
    if found.differing:
        heading = ("array", "differ", "first at", "stored", "again", "largest difference")
        yield from aligned([heading, *map(_row, found.differing[:_MOST_ROWS])])
        if (more := len(found.differing) - _MOST_ROWS) > 0:
            yield f"and {more} more arrays"
    if found.attributes:
        yield f"attributes that differ: {', '.join(found.attributes)}"
    if found.states[0] != found.states[1]:
        yield f"the job {found.states[0]}, its repetition {found.states[1]}"
    if not found.promised:
        then, now = found.versions
        yield f"computed by version {then}, repeated by {now}: equal bits are not promised"
    if found.beyond is not None:
        beyond = f"beyond them: {', '.join(found.beyond[:5])}" if found.beyond else "within them"
        yield f"channels against the certificates' bars, where converged: {beyond}"


def _row(one: "Compared") -> tuple[str, ...]:
    share = f"{one.differing} of {one.values}"
    if one.first is None:
        return one.name, share, "another shape, or missing", "", "", ""
    index = ", ".join(map(str, one.first))
    return one.name, share, f"[{index}]", repr(one.stored), repr(one.again), f"{one.largest:.3g}"


def _verdict(found: "Verification") -> str:
    if not found.promised:
        return "another version computed it, and the results differ"
    return (
        "the same version gave other bits: another kind of processor, another Numba or NumPy,"
        " memory that fails, or results that were changed and sealed anew"
    )
