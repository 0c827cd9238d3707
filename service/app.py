"""The application: `create_app` puts the resources together."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version

from fastapi import FastAPI

import jointplay.service.batches.endpoints
import jointplay.service.jobs.endpoints
import jointplay.service.problems.endpoints
import jointplay.service.results.endpoints
import jointplay.service.results.figures
import jointplay.service.studies.endpoints
import jointplay.service.zarr.endpoints
from jointplay.service import estimates, events, health, problems, scenes
from jointplay.service.idempotency import InFlight
from jointplay.service.jobs.watcher import Watcher
from jointplay.service.openapi import described
from jointplay.service.prober import Prober
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings

_DESCRIPTION = """
Simulate planar mechanisms whose joints have play, and read the results.

All values are in SI units; the schemas give the unit of every field.  Everything that goes wrong
is an RFC 9457 problem document whose `errors` point at the fields.
"""
_RESOURCES = (
    jointplay.service.jobs.endpoints,
    events,
    estimates,
    jointplay.service.batches.endpoints,
    jointplay.service.studies.endpoints,
    jointplay.service.results.endpoints,
    jointplay.service.results.figures,
    jointplay.service.zarr.endpoints,
    scenes,
    health,
    jointplay.service.problems.endpoints,
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
