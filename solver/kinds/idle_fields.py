"""Fields of a job that have no effect beside its other fields: refused where they are given."""

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds.job import MechanismJob


def check_idle(job: MechanismJob, without: str, *fields: str) -> None:
    """Refuse (InvalidInput) fields that have no effect without another one, which is not given.

    A field with its default counts as not given: filled-in documents have all fields.
    """
    defaults = type(job).model_fields
    given = [name for name in fields if getattr(job, name) != defaults[name].default]
    if given:
        raise InvalidInput(
            Problem(
                f"/{name}", f"'{name}' has no effect without {without}; give that, or leave it out."
            )
            for name in given
        )
