"""``GET /problems/{name}``: what the ``type`` of a problem document points to."""

from fastapi import APIRouter
from pydantic import BaseModel

from jointplay.service.problems import RequestRefused, kinds, problems

router = APIRouter(prefix="/problems", tags=["problems"])


class ProblemKinds(BaseModel):
    """All kinds of problems."""

    problems: list[kinds.ProblemKind]


@router.get("")
def list_problem_kinds() -> ProblemKinds:
    """List every kind of problem that the service answers with."""
    return ProblemKinds(problems=[*kinds.ALL.values()])


@router.get("/{name}", responses=problems(kinds.NOT_FOUND))
def explain_problem_kind(name: str) -> kinds.ProblemKind:
    """Explain one kind of problem."""
    if name not in kinds.ALL:
        known = ", ".join(kinds.ALL)
        raise RequestRefused(kinds.NOT_FOUND, f"There is no such problem; there are: {known}.")
    return kinds.ALL[name]
