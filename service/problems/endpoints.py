"""``GET /problems/{name}``: what the ``type`` of a problem document points to."""

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.service.problems import kinds
from jointplay.service.problems.document import RequestRefused, problems

router = APIRouter(prefix="/problems", tags=["problems"])


class ProblemKind(BaseModel):
    """Explains one kind of problem."""

    type: str = Field(description="As in the problem documents.")
    title: str
    status: int = Field(description="HTTP status of such a problem.")
    help: str = Field(description="What a client can do about it.")


class ProblemKinds(BaseModel):
    """All kinds of problems."""

    problems: list[ProblemKind]


@router.get("")
def list_problem_kinds() -> ProblemKinds:
    """List every kind of problem that the service answers with."""
    return ProblemKinds(problems=[_described(kind) for kind in kinds.ALL.values()])


@router.get("/{name}", responses=problems(kinds.NOT_FOUND))
def explain_problem_kind(name: str) -> ProblemKind:
    """Explain one kind of problem."""
    if name not in kinds.ALL:
        known = ", ".join(kinds.ALL)
        raise RequestRefused(kinds.NOT_FOUND, f"There is no such problem; there are: {known}.")
    return _described(kinds.ALL[name])


def _described(kind: kinds.Kind) -> ProblemKind:
    return ProblemKind(type=kind.type, title=kind.title, status=kind.status, help=kind.help)
