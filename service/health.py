"""``/healthz``: the process lives; ``/readyz``: it can take and answer requests."""

import logging
from typing import Annotated, Literal

from fastapi import APIRouter
from pydantic import BaseModel, Field
from sqlalchemy.exc import SQLAlchemyError

from jointplay.service.dependencies import of_the_application
from jointplay.service.problems import kinds, problems, unavailable
from jointplay.service.readiness import Readiness
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.installation import OtherFiles
from jointplay.storage.object_stores.fitness import Unfit

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
async def is_ready(readiness: Annotated[Readiness, of_the_application("readiness")]) -> Health:
    """Write to the catalogue and to the data folder, and read it again, at most once a second.

    Redis is not asked: jobs are accepted without it, and start when it is back.
    """
    try:
        await readiness.proved()
    except (Unavailable, SQLAlchemyError, RuntimeError) as error:
        _log.warning("the catalogue does not do as asked: %s", error)
        raise unavailable("The catalogue cannot be written.", 5) from error
    except (OSError, OtherFiles, Unfit) as error:
        _log.warning("results cannot be stored: %s", error)
        raise unavailable("Results cannot be stored.", 5) from error
    return Health()
