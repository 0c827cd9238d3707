"""``/v1/laws``: the laws of contact, friction and force that a scene can name."""

from fastapi import APIRouter
from pydantic import BaseModel

from jointplay.solver.laws.catalogue import Law, laws

router = APIRouter(prefix="/v1/laws", tags=["scenes"])


class LawList(BaseModel):
    """All laws."""

    laws: list[Law]


@router.get("")
def list_laws() -> LawList:
    """List the laws: formula, parameters with unit, range and default, source, where it fails."""
    return LawList(laws=laws())
