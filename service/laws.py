"""``/v1/laws``: the laws of contact, friction and force, and the functions, of scenes."""

from fastapi import APIRouter
from pydantic import BaseModel

from jointplay.solver.laws.catalogue import Law, laws

router = APIRouter(prefix="/v1/laws", tags=["scenes"])


class LawList(BaseModel):
    """All laws."""

    laws: list[Law]


@router.get("")
def list_laws() -> LawList:
    """List laws and functions: formula, parameters with unit, range and default, source, limits."""
    return LawList(laws=laws())
