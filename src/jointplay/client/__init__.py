"""Talk to a jointplay service from Python.

>>> from jointplay import Client
>>> with Client("http://127.0.0.1:8000") as client:  # doctest: +SKIP
...     job = client.simulate("pendulum", duration=1.0).wait(progress=True)
...     print(job.window("energy.kinetic", points=500)["energy.kinetic"].max())
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from jointplay.client.errors import (
    ClientError,
    Damaged,
    Expired,
    FieldProblem,
    MissingExtra,
    NotAllowed,
    NotFinished,
    NotFound,
    Overloaded,
    Refused,
    ResultsNotReady,
    ServiceFailure,
    TimedOut,
    Unreachable,
)
from jointplay.client.job import Job, JobCancelled, JobEnded, JobFailed
from jointplay.client.job_record import Estimate, JobRecord
from jointplay.client.notebook import Picture
from jointplay.client.results import Impacts, Peak, Results
from jointplay.client.window import ChannelSeries, Window

if TYPE_CHECKING:
    from jointplay.client.asynchronous.batch import AsyncBatch
    from jointplay.client.asynchronous.client import AsyncClient
    from jointplay.client.asynchronous.job import AsyncJob
    from jointplay.client.batches import Batch
    from jointplay.client.client import Client
    from jointplay.client.connection import DEFAULT_URL
from jointplay.records.job import JobError, Progress

__all__ = [
    "DEFAULT_URL",
    "AsyncBatch",
    "AsyncClient",
    "AsyncJob",
    "Batch",
    "ChannelSeries",
    "Client",
    "ClientError",
    "Damaged",
    "Estimate",
    "Expired",
    "FieldProblem",
    "Impacts",
    "Job",
    "JobCancelled",
    "JobEnded",
    "JobError",
    "JobFailed",
    "JobRecord",
    "MissingExtra",
    "NotAllowed",
    "NotFinished",
    "NotFound",
    "Overloaded",
    "Peak",
    "Picture",
    "Progress",
    "Refused",
    "Results",
    "ResultsNotReady",
    "ServiceFailure",
    "TimedOut",
    "Unreachable",
    "Window",
]

_ONLINE = {
    "AsyncBatch": "asynchronous.batch",
    "AsyncClient": "asynchronous.client",
    "AsyncJob": "asynchronous.job",
    "Batch": "batches",
    "Client": "client",
    "DEFAULT_URL": "connection",
}


def __getattr__(name: str) -> Any:
    """Load what speaks HTTP when it is asked for: jobs in a folder need none of it."""
    if name in _ONLINE:
        return getattr(import_module(f"jointplay.client.{_ONLINE[name]}"), name)
    raise AttributeError(f"module 'jointplay.client' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
