"""``/metrics``: what Prometheus asks for, of the catalogue and of this process."""

import time
from collections.abc import Iterator, Mapping
from threading import Lock
from typing import Annotated, Any, Final

from fastapi import APIRouter, Response
from prometheus_client import CollectorRegistry, PlatformCollector, ProcessCollector
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest
from prometheus_client.metrics_core import (
    CounterMetricFamily,
    GaugeMetricFamily,
    Metric,
    SummaryMetricFamily,
)
from prometheus_client.registry import Collector

from jointplay.service.dependencies import of_the_application
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.census import Census
from jointplay.storage.catalogue.counters import (
    COMPILING,
    ON_DEVICES,
    OUTCOMES,
    PUBLISHED,
    PUBLISHING,
    of_outcome,
)
from jointplay.storage.catalogue.records import JobState

router = APIRouter(include_in_schema=False)
_REMEMBERED: Final = 5.0
"""Seconds for which the catalogue is not counted again, whoever asks."""


class Counted(Collector):
    """The catalogue's numbers."""

    def __init__(self, catalogue: Catalogue) -> None:
        self._catalogue = catalogue
        self._turn = Lock()
        self._known: tuple[float, Census] | None = None

    def collect(self) -> Iterator[Metric]:
        """Yield a family of numbers each; `storage.catalogue.errors.Unavailable` may be raised."""
        found = self._census()
        yield _family("jobs", "Jobs that have not ended.", "state", found.jobs)
        queues = found.waiting.items()
        blocks = {name: queue.blocks for name, queue in queues}
        yield _family("blocks_waiting", "Blocks that no worker has taken.", "queue", blocks)
        longest = {name: queue.longest for name, queue in queues}
        said = "Time that the first block of a queue has waited."
        yield _family("longest_wait_seconds", said, "queue", longest)
        yield _single("blocks_running", "Blocks that a worker has.", found.running)
        yield _single("blocks_overdue", "Blocks whose lease ran out.", found.overdue)
        said = "Jobs whose solver no worker has."
        yield _single("jobs_unserved", said, found.unserved)
        said = "Wake-ups that were sent and not answered yet."
        yield _single("wake_ups_on_the_way", said, found.on_the_way)
        rates = {name: devices.rate for name, devices in found.devices.items()}
        counts = {name: devices.count for name, devices in found.devices.items()}
        yield _family(
            "devices", "Workers that have a graphics processor, by its name.", "device", counts
        )
        said = "Accepted steps of these processors, as they were tried."
        yield _family("device_steps_per_second", said, "device", rates)
        yield from _totals(found.totals)
        ahead = self._catalogue.clock() - time.time()
        said = "Clock of the catalogue less that of this machine."
        yield _single("clock_ahead_seconds", said, ahead)

    def describe(self) -> list[Metric]:
        """Return nothing: registering shall not ask the catalogue."""
        return []

    def _census(self) -> Census:
        with self._turn:
            if self._known is None or time.monotonic() > self._known[0] + _REMEMBERED:
                self._known = time.monotonic(), self._catalogue.census()
            return self._known[1]


def registry_of(catalogue: Catalogue) -> CollectorRegistry:
    """Return what is shown at `/metrics`."""
    registry = CollectorRegistry()
    registry.register(Counted(catalogue))
    ProcessCollector(registry=registry)
    PlatformCollector(registry=registry)
    return registry


def _single(name: str, said: str, value: float) -> Metric:
    return GaugeMetricFamily(f"jointplay_{name}", said, value=value)


def _family(name: str, said: str, label: str, values: Any) -> Metric:
    family = GaugeMetricFamily(f"jointplay_{name}", said, labels=[label])
    for key, value in values.items():
        family.add_metric([key.value if isinstance(key, JobState) else key], value)
    return family


def _totals(totals: Mapping[str, float]) -> Iterator[Metric]:
    attempts = CounterMetricFamily(
        "jointplay_attempts", "Attempts at blocks that ended, by outcome.", labels=["outcome"]
    )
    for outcome in OUTCOMES:
        attempts.add_metric([outcome], totals.get(of_outcome(outcome), 0.0))
    yield attempts
    yield SummaryMetricFamily(
        "jointplay_publish_seconds",
        "Time in which workers sealed the results of jobs and stored them.",
        count_value=int(totals.get(PUBLISHED, 0.0)),
        sum_value=totals.get(PUBLISHING, 0.0),
    )
    yield CounterMetricFamily(
        "jointplay_compile_seconds",
        "Time in which workers compiled kernels, or waited for them.",
        value=totals.get(COMPILING, 0.0),
    )
    yield CounterMetricFamily(
        "jointplay_device_points",
        "Points of studies that graphics processors computed.",
        value=totals.get(ON_DEVICES, 0.0),
    )


@router.get("/metrics")
def show_metrics(
    registry: Annotated[CollectorRegistry, of_the_application("registry")],
) -> Response:
    """Show the numbers in the text format that Prometheus reads."""
    return Response(generate_latest(registry), media_type=CONTENT_TYPE_LATEST)
