"""The application: `create_app` puts the resources together."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial
from importlib.metadata import version

from fastapi import FastAPI

import jointplay.service.batches.endpoints
import jointplay.service.charts.attractors
import jointplay.service.charts.endpoints
import jointplay.service.jobs.endpoints
import jointplay.service.page.endpoints
import jointplay.service.problems.endpoints
import jointplay.service.results.endpoints
import jointplay.service.results.figures
import jointplay.service.results.spectra
import jointplay.service.scenes.channels
import jointplay.service.scenes.checks
import jointplay.service.scenes.endpoints
import jointplay.service.scenes.poses
import jointplay.service.studies.endpoints
import jointplay.service.workers.attempts
import jointplay.service.workers.claims
import jointplay.service.workers.drops
import jointplay.service.workers.files
import jointplay.service.workers.listing
import jointplay.service.zarr.endpoints
import jointplay.service.zarr.whole
from jointplay.service import estimates, events, health, kinds, laws, metrics, problems, schemas
from jointplay.service.access import links, needs, quotas
from jointplay.service.access.authentication import Authentication
from jointplay.service.access.concurrency import ConcurrencyLimit
from jointplay.service.access.signed import SignedLinks
from jointplay.service.checking import Checker
from jointplay.service.compression import Compression
from jointplay.service.content_policy import ContentPolicy
from jointplay.service.dependencies import KNOWN_PARAMETERS
from jointplay.service.description import describe
from jointplay.service.fair_semaphore import (
    DRAWN_AT_ONCE,
    EXPORTED_AT_ONCE,
    LISTED_AT_ONCE,
    FairSemaphore,
)
from jointplay.service.heads import Heads
from jointplay.service.jobs.queueing import Queueing
from jointplay.service.jobs.waiting import Watcher
from jointplay.service.metrics import registry_of
from jointplay.service.migration import migrated
from jointplay.service.pieces import Pieces
from jointplay.service.prober import Prober
from jointplay.service.problems.handlers import install
from jointplay.service.problems.kinds import OF_THE_DOOR
from jointplay.service.problems.unexpected import UnexpectedErrors
from jointplay.service.readiness import Readiness
from jointplay.service.request_log import RequestLog
from jointplay.service.results.damage import answer_damage
from jointplay.service.scenes.checks import scene_checker
from jointplay.service.scenes.poses import scene_poser
from jointplay.service.targets import Targets
from jointplay.service.vital import VitalThreads
from jointplay.service.windows import WindowProcess
from jointplay.service.workers.new_blocks import NewBlocks
from jointplay.service.workers.uploads import Uploads
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.errors import CorruptStore
from jointplay.storage.installation import require_own_files
from jointplay.storage.object_stores.fitness import require_fit
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.settings import Settings

_DESCRIPTION = """
Simulate planar mechanisms whose joints have play, and read the results.

All values are in SI units; the schemas give the unit of every field.  Everything that goes wrong
is an RFC 9457 problem document whose `errors` point at the fields.
"""
_JOBS = needs("jobs:read", "jobs:write")
_RESULTS = needs("results:read")
_WORKERS = needs("worker")
_BEHIND_THE_DOOR = (
    (jointplay.service.jobs.endpoints, _JOBS),
    (events, _JOBS),
    (estimates, needs("jobs:write")),
    (jointplay.service.batches.endpoints, _JOBS),
    (jointplay.service.scenes.checks, needs("jobs:write")),
    (jointplay.service.scenes.poses, needs("jobs:read")),
    (jointplay.service.scenes.channels, needs("jobs:read")),
    (jointplay.service.charts.endpoints, _RESULTS),
    (jointplay.service.charts.attractors, _RESULTS),
    (jointplay.service.studies.endpoints, _RESULTS),
    (jointplay.service.results.endpoints, _RESULTS),
    (jointplay.service.results.figures, _RESULTS),
    (jointplay.service.results.spectra, _RESULTS),
    (jointplay.service.zarr.endpoints, _RESULTS),
    (jointplay.service.zarr.whole, _RESULTS),
    (links, _RESULTS),
    (metrics, needs("metrics")),
    (quotas, needs("jobs:read")),
    (jointplay.service.workers.listing, needs("jobs:read")),
    (jointplay.service.workers.claims, _WORKERS),
    (jointplay.service.workers.files, _WORKERS),
    (jointplay.service.workers.drops, _WORKERS),
    (jointplay.service.workers.attempts, _WORKERS),
)
_OPEN = (
    jointplay.service.scenes.endpoints,
    kinds,
    laws,
    schemas,
    health,
    jointplay.service.problems.endpoints,
    jointplay.service.page.endpoints,
)


def create_app(settings: Settings | None = None, *, patient: bool = False) -> FastAPI:
    """Return the application.

    Parameters
    ----------
    settings
        Where the catalogue and the results are; by default from the environment
        (``JOINTPLAY_...``).
    patient
        Whether it also starts while the catalogue is out of reach, and refuses requests.
    """
    settings = settings or Settings()
    app = FastAPI(
        title="jointplay",
        version=version("jointplay"),
        description=_DESCRIPTION,
        lifespan=partial(_running, patient=patient),
        openapi_url=None,  # theirs writes the document anew for each request
        docs_url=None,  # theirs loads its scripts from elsewhere; ours: service/page
        redoc_url=None,
    )
    app.state.settings = settings
    _add_middleware(app, settings)
    install(app)
    app.add_exception_handler(CorruptStore, answer_damage)
    refusals = problems.problems(*OF_THE_DOOR)
    for resource, key in _BEHIND_THE_DOOR:
        looked_at = [key, KNOWN_PARAMETERS]
        app.include_router(resource.router, dependencies=looked_at, responses=refusals)
    for resource in _OPEN:
        app.include_router(resource.router)
    describe(app)
    return app


@asynccontextmanager
async def _running(app: FastAPI, *, patient: bool) -> AsyncIterator[None]:
    """Give an application what its requests need, while it runs."""
    settings: Settings = app.state.settings
    settings.data.mkdir(parents=True, exist_ok=True)
    if not isinstance(settings.object_store, Folder):
        require_fit(settings.object_store)
    catalogue = Catalogue(settings.catalogue_url)
    migrating = await migrated(catalogue, patient=patient)
    if not patient:
        require_own_files(settings, catalogue)
    app.state.catalogue = catalogue
    app.state.vital = vital = VitalThreads()
    app.state.authentication = Authentication(catalogue, settings, vital)
    app.state.link_secret = app.state.authentication.link_secret
    app.state.readiness = Readiness(catalogue, settings, vital)
    app.state.registry = registry_of(catalogue)
    app.state.watcher = Watcher(catalogue)
    app.state.in_flight = {}
    app.state.new_blocks = new_blocks = NewBlocks()
    app.state.uploads = Uploads()
    app.state.drawing = FairSemaphore(DRAWN_AT_ONCE)
    app.state.exporting = FairSemaphore(EXPORTED_AT_ONCE)
    app.state.listing = FairSemaphore(LISTED_AT_ONCE)
    app.state.prober = prober = Prober()
    app.state.checker = checker = Checker(settings, catalogue)
    app.state.queueing = Queueing(settings, catalogue, checker, new_blocks)
    app.state.windows = windows = WindowProcess()
    app.state.scene_checker = scenes = scene_checker()
    app.state.poser = poser = scene_poser()
    try:
        yield
    finally:
        for process in (prober, checker, windows, scenes, poser):
            process.close()
        migrating.cancel()
        catalogue.close()


def _add_middleware(app: FastAPI, settings: Settings) -> None:
    """Add what looks at all requests, or at all answers; the last one is the outermost."""
    locked = [one for part, _ in _BEHIND_THE_DOOR for one in part.router.routes]
    unlocked = [one for part in _OPEN for one in part.router.routes]
    known = [one for one in (*locked, *unlocked) if "HEAD" in getattr(one, "methods", ())]
    app.add_middleware(Compression)
    app.add_middleware(Heads, known=known)
    app.add_middleware(SignedLinks)
    app.add_middleware(Pieces)
    app.add_middleware(ConcurrencyLimit, unlocked=unlocked, keys=settings.keys == "required")
    app.add_middleware(Targets)
    app.add_middleware(UnexpectedErrors)
    app.add_middleware(ContentPolicy)
    if settings.log_format == "json":
        app.add_middleware(RequestLog)
