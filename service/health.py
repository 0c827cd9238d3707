"""``/healthz``: the process lives; ``/readyz``: it can take and answer requests."""

import logging
import os
from typing import Literal

from fastapi import APIRouter
from pydantic import BaseModel, Field
from sqlalchemy.exc import SQLAlchemyError

from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.service.problems import kinds, problems, unavailable
from jointplay.storage.catalogue.errors import Unavailable

router = APIRouter(tags=["health"])
_log = logging.getLogger(__name__)


class Health(BaseModel):
    """The service is well."""

    status: Literal["ok"] = Field(default="ok", description="Always ok; otherwise a problem.")


@router.get("/healthz")
async def is_alive() -> Health:
    """Answer while the process lives."""
    return Health()


@router.get("/readyz", responses=problems(kinds.UNAVAILABLE))
def is_ready(catalogue: CatalogueDependency, settings: SettingsDependency) -> Health:
    """Answer whether the catalogue can be read and the results' folder be written.

    Redis is not asked: jobs are accepted without it, and start when it is back.
    """
    try:
        catalogue.ping()
    except (Unavailable, SQLAlchemyError, RuntimeError) as error:
        _log.warning("the catalogue does not answer", exc_info=error)
        raise unavailable("The catalogue does not answer.", 5) from error
    if not os.access(settings.data, os.R_OK | os.W_OK):
        raise unavailable("The results' folder cannot be written.", 5)
    return Health()
