"""Summary of what a job came to: a document for programs, lines for people."""

import textwrap
from collections import Counter
from collections.abc import Container, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from jointplay.command_line.accuracy import accuracy_lines
from jointplay.command_line.attractors import attractor_lines
from jointplay.command_line.branch_table import branch_lines
from jointplay.command_line.calibration_table import calibration_lines
from jointplay.command_line.certificate import headlines
from jointplay.command_line.peaks import peak_rows, peak_table
from jointplay.command_line.sensitivity import sensitivity_lines

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.records.study import StudySource

_MOST_FAILURES = 5
_LINES = {
    "attractors": attractor_lines,
    "sensitivity": sensitivity_lines,
    "branch": branch_lines,
    "accuracy": accuracy_lines,
    "calibration": calibration_lines,
}
"""Lines of results that only some kinds of jobs have."""


def results_of(job: "Job") -> dict[str, Any]:
    """Return what is there so far: statistics and peaks, or the points of a study; else None."""
    from jointplay.client import NotFound, ResultsNotReady

    parts = (
        *("statistics", "peaks", "points", "accuracy"),
        *("attractors", "branch", "calibration", "sensitivity"),
    )
    found: dict[str, Any] = dict.fromkeys(parts)
    try:
        if "accuracy" in job.links:
            found["accuracy"] = job.accuracy
        elif "calibration" in job.links:
            found["calibration"] = job.calibration
        elif job.is_study:
            found["points"] = job.study(sections=(0, 1))
            found["attractors"] = job.attractors if "attractors" in job.links else None
            if "sensitivity" in job.links:
                found["sensitivity"] = job.sensitivity()
            if "branch" in job.links:
                found["branch"] = job.branch
        elif job.is_finished:
            found["statistics"] = job.statistics
            found["peaks"] = peak_rows(job.results.peaks())
    except (ResultsNotReady, NotFound):
        pass
    return found


def document_of(job: "Job", found: dict[str, Any]) -> dict[str, Any]:
    """Return a job with its results as one document."""
    points = None if found["points"] is None else _summary_of(found["points"])
    return {"job": job.to_document(), **found, "points": points}


def result_lines(
    job: "Job", found: dict[str, Any], channels: Container[str] | None = None
) -> Iterator[str]:
    """Yield results of a job, of a simulation those of some channels, by default of all."""
    for note in (found["statistics"] or {}).get("notes", ()):
        yield from textwrap.wrap(note, 100, initial_indent="note      ")
    if (rows := found["peaks"]) is not None:
        if job.job.get("settle"):
            yield f"peaks from t = {job.job['settle']:g} s on"
        yield from peak_table(
            [one for one in rows if channels is None or one["channel"] in channels]
        )
        if job.job.get("certificate"):
            yield from headlines(job)
    if found["points"] is not None:
        yield from _study_lines(found["points"])
    for name, lines in _LINES.items():
        if found[name] is not None:
            yield from lines(found[name])


def _summary_of(source: "StudySource") -> dict[str, Any]:
    """Return how many points ended in which way, the verdicts, and all failures."""
    from jointplay.records.point import PointStatus

    counts = Counter(PointStatus(code).name for code in source.status)
    verdicts: Counter[str] | None = None
    if (codes := source.verdicts) is not None:
        verdicts = Counter(source.verdict_names[code] for code in codes if code >= 0)
    return {
        "number": source.points,
        "status": {word: counts[word] for word in PointStatus.__members__},
        "sections": _sections_of(source),
        "verdicts": None if verdicts is None else dict(verdicts.most_common()),
        "reasons": [{"point": point, "reason": reason} for point, reason in source.reasons.items()],
        "failures": [
            {"point": point, **failure._asdict()} for point, failure in source.failures.items()
        ],
    }


def _sections_of(source: "StudySource") -> dict[str, int] | None:
    """Return the fewest and most sections of a point that is done; None where none is taken."""
    from jointplay.records.point import PointStatus

    done = source.status == PointStatus.done
    if not source.observables or not done.any():
        return None
    counts = source.counts[done]
    return {"fewest": int(counts.min()), "most": int(counts.max())}


def _missed(job: Mapping[str, Any], fewest: int) -> str:
    """Return why points have fewer sections than were asked for; empty: they have all."""
    section, wanted = job.get("section"), job.get("record", 0)
    if job["kind"] == "continuation" or section is None or fewest >= wanted:
        return ""
    if "crank_angle" in section:
        return f" of {wanted}"
    from jointplay.solver.kinds.limits import EVENT_PATIENCE

    met = f"no onset at {section['onset']}" if "onset" in section else "no crossing"
    return f" of {wanted}: {met} in {EVENT_PATIENCE} periods for each of the others"


def _study_lines(source: "StudySource") -> Iterator[str]:
    """Yield how many points ended in which way, the verdicts, extremes, and first failures."""
    import numpy as np

    from jointplay.records.point import PointStatus

    summary = _summary_of(source)
    for heading, counts in (("points", summary["status"]), ("verdicts", summary["verdicts"])):
        if counts is not None:
            listed = ", ".join(f"{number} {word}" for word, number in counts.items() if number)
            yield f"{heading:9} {listed}"
    if (sections := summary["sections"]) is not None:
        fewest, most = sections.values()
        counted = f"{most} a point" if fewest == most else f"{fewest} to {most} a point"
        yield f"sections  {counted}{_missed(source.attributes['job'], fewest)}"
    if source.points == 1 and 0 in source.reasons:
        yield from textwrap.wrap(source.reasons[0], 100, initial_indent="because   ")
    done = source.status == PointStatus.done
    width = max((len(channel.name) for channel in source.channels), default=0)
    for channel in source.channels if done.any() else ():
        peaks = source.peaks(channel.name)
        low, high = peaks.minimum[done], peaks.maximum[done]
        yield (
            f"{channel.name:{width}}  minimum {np.nanmin(low):.6g} to {np.nanmax(low):.6g},"
            f"  maximum {np.nanmin(high):.6g} to {np.nanmax(high):.6g} {channel.unit}"
        )
    for point, failure in list(source.failures.items())[:_MOST_FAILURES]:
        values = ", ".join(
            f"{parameter.name} = {value:g}"
            for parameter, value in zip(source.parameters, source.values[point], strict=True)
        )
        where = f"point {point}" + (f" ({values})" if values else "")
        yield f"failed    {where}: {failure.detail}"
    if len(source.failures) > _MOST_FAILURES:
        yield f"          and {len(source.failures) - _MOST_FAILURES} more"
