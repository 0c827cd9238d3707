"""The method and tolerance that a job asks for, if the one can give what the other promises."""

from __future__ import annotations

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.integrators import METHODS, method_for
from jointplay.solver.jobs.job import ACCURACIES, Job, Method


def chosen(job: Job) -> tuple[Method, float | None]:
    """Return the method and the tolerance, by number or by name; none with a fixed step.

    Raises
    ------
    InvalidInput
        Fields that exclude each other, or a tolerance too large for the method.
    """
    if job.accuracy is not None:
        for field, given in (("tolerance", job.tolerance), ("method", job.method != "auto")):
            if given:
                raise InvalidInput(
                    [Problem("/accuracy", f"Give a {field} or a named accuracy, not both.")]
                )
    if job.method == "rk4":
        _check_fixed_step(job)
        return "rk4", None
    if job.step is not None:
        raise InvalidInput(
            [Problem("/step", "Only the method 'rk4' has a fixed step; drop it, or choose 'rk4'.")]
        )
    method, tolerance = ACCURACIES[job.accuracy or "standard"]
    method = method if job.accuracy else job.method
    tolerance = job.tolerance if job.tolerance is not None else tolerance
    limit = METHODS[method_for(method, tolerance)].largest_tolerance
    if tolerance > limit:
        raise InvalidInput([Problem("/tolerance", _too_large(method, tolerance, limit))])
    return method, tolerance


def check_study(job: Job, *, tangents: bool) -> None:
    """Refuse methods that studies do not offer.

    Raises
    ------
    InvalidInput
        At the field that asks for it.
    """
    method, tolerance = chosen(job)
    name = method_for(method, tolerance)
    where = "/accuracy" if job.accuracy else "/method" if job.method != "auto" else "/tolerance"
    if not METHODS[name].error:
        sentence = f"A study needs error control and located onsets, which '{name}' has not."
    elif tangents and name != "tsitouras":
        sentence = (
            f"Lyapunov exponents are computed along steps of 'tsitouras', not of '{name}'; choose"
            " that or 'auto' and a tolerance of 3e-05 at most, or drop the indicator 'lyapunov'."
        )
    else:
        return
    raise InvalidInput([Problem(where, sentence)])


def _check_fixed_step(job: Job) -> None:
    if job.step is None:
        raise InvalidInput([Problem("/step", "The method 'rk4' needs its fixed 'step', s.")])
    if job.tolerance is not None:
        raise InvalidInput(
            [
                Problem(
                    "/tolerance",
                    "The method 'rk4' does not control its error; drop the tolerance, or choose"
                    " another method.",
                )
            ]
        )


def _too_large(method: str, tolerance: float, limit: float) -> str:
    able = [f"'{name}'" for name, each in METHODS.items() if tolerance <= each.largest_tolerance]
    remedy = f", or choose {' or '.join(able)}" if able else ""
    who = "any method" if method == "auto" else f"'{method}'"
    return (
        f"At tolerance {tolerance:g} the energy that {who} loses track of is a large part of what"
        f" contacts and friction take; ask for {limit:g} at most{remedy}."
    )
