"""The application: `create_app` puts the resources together."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version

from fastapi import FastAPI

import service.batches.endpoints
import service.estimates.endpoints
import service.events.endpoints
import service.health.endpoints
import service.jobs.endpoints
import service.problems.endpoints
import service.results.endpoints
import service.results.figures
import service.scenes.endpoints
import service.studies.endpoints
import service.zarr.endpoints
from service import problems
from service.estimates.prober import Prober
from service.events.watcher import Watcher
from service.idempotency import InFlight
from service.openapi import described
from storage.catalogue import Catalogue
from storage.settings import Settings

_DESCRIPTION = """
Simulate planar mechanisms whose joints have play, and read the results.

All values are in SI units; the schemas give the unit of every field.  Everything that goes wrong
is an RFC 9457 problem document whose `errors` point at the fields.
"""
_RESOURCES = (
    service.jobs.endpoints,
    service.events.endpoints,
    service.estimates.endpoints,
    service.batches.endpoints,
    service.studies.endpoints,
    service.results.endpoints,
    service.results.figures,
    service.zarr.endpoints,
    service.scenes.endpoints,
    service.health.endpoints,
    service.problems.endpoints,
)


def create_app(settings: Settings | None = None) -> FastAPI:
    """Return the application.

    Parameters
    ----------
    settings
        Where the catalogue and the results are; by default from the environment
        (``JOINTPLAY_...``).
    """
    settings = settings or Settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        settings.data.mkdir(parents=True, exist_ok=True)
        catalogue = Catalogue(settings.catalogue_url)
        catalogue.migrate()
        app.state.catalogue = catalogue
        app.state.watcher = Watcher(catalogue)
        app.state.in_flight = InFlight()
        app.state.prober = prober = Prober()
        try:
            yield
        finally:
            prober.close()
            catalogue.close()

    app = FastAPI(
        title="jointplay",
        version=version("jointplay"),
        description=_DESCRIPTION,
        lifespan=lifespan,
    )
    app.state.settings = settings
    problems.install(app)
    for resource in _RESOURCES:
        app.include_router(resource.router)
    app.openapi = described(app)  # type: ignore[method-assign]  # as FastAPI documents it
    return app
