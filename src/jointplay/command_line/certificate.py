"""``jointplay certificate``: how far a result can be believed."""

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from jointplay.command_line.options import AS_JSON, DEFAULT_URL, RESULTS, URL, job_of
from jointplay.command_line.output import print_result

if TYPE_CHECKING:
    from jointplay.client import Job


def certificate(results: RESULTS, as_json: AS_JSON = False, url: URL = DEFAULT_URL) -> None:
    """Print how far a simulation can be believed: its numbers, and until when each channel.

    With --json also the estimated errors over time, and the spreads beyond.

    Example: `jointplay certificate OUT`
    """
    with job_of(results, url) as job:
        document = job.certificate
    print_result(document, _lines(document), as_json=as_json)


def _lines(document: dict[str, Any]) -> Iterator[str]:
    own = {name: one for name, one in document.items() if name not in ("time", "channels")}
    for name, value in _numbers("", own):
        yield f"{name:32} {value}"
    for name, channel in document["channels"].items():
        yield f"{name:32} until {channel['until']:.6g} s"


def _numbers(name: str, value: Any) -> Iterator[tuple[str, str]]:
    """Yield what is in a document by dotted names; a list of objects has one line for each."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from _numbers(f"{name}.{key}" if name else key, one)
    elif isinstance(value, list) and any(isinstance(one, dict) for one in value):
        for index, one in enumerate(value):
            yield f"{name}.{index}", ", ".join(f"{key} {_word(part)}" for key, part in one.items())
    elif isinstance(value, list):
        yield name, ", ".join(map(_word, value)) or "none"
    else:
        yield name, _word(value)


def _word(value: Any) -> str:
    """Return a number or a word; of a span both ends."""
    if isinstance(value, list):
        return " to ".join(map(_word, value))
    if isinstance(value, float):
        return f"{value:.7g}"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "unknown" if value is None else str(value)


def headlines(job: "Job") -> Iterator[str]:
    """Yield where a job's motion is converged, and its exponent, a line each, if it has any."""
    from jointplay.client import NotFound, ResultsNotReady

    try:
        document = job.certificate
    except (NotFound, ResultsNotReady):
        return
    spans = [f"{start:.4g} to {stop:.4g} s" for start, stop in document["converged"]]
    forces = document.get("forces_until")
    known = "" if forces is None else f", forces to {forces:.4g} s"
    yield f"converged {', '.join(spans)}{known}"
    if (impacts := document.get("impacts")) is not None:
        share = f"{impacts['certified']} of {impacts['count']}"
        yield f"impacts   certified until {impacts['until']:.4g} s, {share}"
    if (advice := _advice(job.job, document)) is not None:
        yield f"advice    {advice}"
    if document["note"] and document.get("lanes"):
        yield f"note      {document['note']}"
    elif not document.get("lanes"):
        yield from (f"note      {one['detail']}" for one in document.get("pulling", ()))
    if (found := document.get("exponent")) is not None:
        yield f"exponent  {exponent_in_words(found)}"


def exponent_in_words(found: Mapping[str, Any]) -> str:
    """Return the exponent of a certificate, with its error where there is one."""
    if found["error"] is None:
        return f"{found['value']:.3g} 1/s, of too short a time to know its error"
    spread = f"{found['lowest']:.2g} to {found['highest']:.2g} over {found['windows']} windows"
    return f"{found['value']:.3g} ± {found['error']:.2g} 1/s, {spread}"


def _advice(job: Mapping[str, Any], document: Mapping[str, Any]) -> str | None:
    """Return what makes more of the motion known; None where all of it is, or nothing would.

    An error grows as the distance of neighbours does: a tolerance ten times smaller moves the
    horizon by ln 10 over their exponent, where that is known to be above zero.
    """
    if not document.get("lanes") or document["horizon"] >= job["duration"]:
        return None
    if job.get("step") is not None:
        return f"half the step, --step {job['step'] / 2:.3g}, reaches further"
    tighter = f"--tolerance {job['tolerance'] / 10:.3g}"
    found = document.get("exponent") or {}
    rate, error = found.get("value"), found.get("error")
    if rate is None or error is None or rate <= error:
        return f"{tighter} reaches further (--accuracy reference furthest); how far, that run tells"
    gain = math.log(10.0) / rate
    left = (job["duration"] - document["horizon"]) / gain
    return (
        f"{tighter} reaches some {gain:.2g} s further, as neighbours part with {rate:.2g} 1/s;"
        f" all of it takes {left:.0f} such steps"
    )
