"""Talk to a jointplay service from Python.

>>> from jointplay.client import Client
>>> job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
>>> with Client("http://127.0.0.1:8000") as client:  # doctest: +SKIP
...     finished = client.wait(client.submit(job).id)
...     print(client.peaks(finished.id)["energy.kinetic"].maximum)
"""

from jointplay.client.batches import Batch
from jointplay.client.connection import DEFAULT_URL
from jointplay.client.errors import (
    ClientError,
    NotFound,
    Refused,
    ResultsNotReady,
    ServiceFailure,
    Unreachable,
)
from jointplay.client.estimates import Estimate
from jointplay.client.jobs import Job, JobError, Progress
from jointplay.client.results import ChannelSeries, History, Impacts, Peak, Section
from jointplay.client.session import Client

__all__ = [
    "DEFAULT_URL",
    "Batch",
    "ChannelSeries",
    "Client",
    "ClientError",
    "Estimate",
    "History",
    "Impacts",
    "Job",
    "JobError",
    "NotFound",
    "Peak",
    "Progress",
    "Refused",
    "ResultsNotReady",
    "Section",
    "ServiceFailure",
    "Unreachable",
]
