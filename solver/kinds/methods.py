"""The method and tolerance that a job asks for, if the one can give what the other promises."""

from jointplay.records.failure import InvalidInput
from jointplay.solver.integrators import AUTO, METHODS, method_for
from jointplay.solver.kinds.job import ACCURACIES, Job
from jointplay.solver.quantities.registry import quoted


def chosen(job: Job) -> tuple[str, float | None]:
    """Return the method and the tolerance, by number or by name; none with a fixed step.

    InvalidInput: fields that exclude each other, or a tolerance too large for the method.
    """
    if job.accuracy is not None:
        for field, given in (("tolerance", job.tolerance), ("method", job.method != "auto")):
            if given:
                raise InvalidInput.at("/accuracy", f"Give a {field} or a named accuracy, not both.")
    if job.method != "auto" and METHODS[job.method].fixed_step:
        _check_fixed_step(job)
        return job.method, None
    if job.step is not None:
        able = quoted([name for name, each in METHODS.items() if each.fixed_step])
        sentence = f"Only the method {able} has a fixed step; drop it, or choose {able}."
        raise InvalidInput.at("/step", sentence)
    method, tolerance = ACCURACIES[job.accuracy or "standard"]
    method = method if job.accuracy else job.method
    if not job.accuracy:
        tolerance = job.tolerance if job.tolerance is not None else job.usual_tolerance
    limit = METHODS[method_for(method, tolerance)].largest_tolerance
    if tolerance > limit:
        raise InvalidInput.at("/tolerance", _too_large(method, tolerance, limit))
    return method, tolerance


def check_study(job: Job, *, tangents: bool) -> None:
    """Refuse (InvalidInput) methods that studies do not offer, at the field that asks for it."""
    method, tolerance = chosen(job)
    name = method_for(method, tolerance)
    where = "/accuracy" if job.accuracy else "/method" if job.method != "auto" else "/tolerance"
    if METHODS[name].fixed_step:
        sentence = f"A study needs error control and located onsets, which '{name}' has not."
    elif tangents and not METHODS[name].carries_tangents:
        able = quoted([name for name, each in METHODS.items() if each.carries_tangents])
        sentence = (
            f"Lyapunov exponents are computed along steps of {able}, not of '{name}'; choose that"
            f" or 'auto' and a tolerance of {AUTO.largest_tolerance:g} at most, or drop the"
            " indicator 'lyapunov'."
        )
    else:
        return
    raise InvalidInput.at(where, sentence)


def check_reduced(formulation: str, what: str) -> None:
    """Refuse (InvalidInput) the formulation without joint coordinates, which `what` ends with."""
    if formulation != "reduced":
        only = "which only the formulation 'reduced' has; choose that."
        raise InvalidInput.at("/formulation", f"{what} joint coordinates, {only}")


def _check_fixed_step(job: Job) -> None:
    if job.step is None:
        sentence = f"The method '{job.method}' needs its fixed 'step', s."
        raise InvalidInput.at("/step", sentence)
    if job.tolerance is not None:
        sentence = (
            f"The method '{job.method}' does not control its error; drop the tolerance, or choose"
            " another method."
        )
        raise InvalidInput.at("/tolerance", sentence)


def _too_large(method: str, tolerance: float, limit: float) -> str:
    able = [name for name, each in METHODS.items() if tolerance <= each.largest_tolerance]
    remedy = f", or choose {quoted(able)}" if able else ""
    who = "any method" if method == "auto" else f"'{method}'"
    return (
        f"At tolerance {tolerance:g} the energy that {who} loses track of is a large part of what"
        f" contacts and friction take; ask for {limit:g} at most{remedy}."
    )
