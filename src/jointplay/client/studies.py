"""Studies from the service's pages: one dataset of all points."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain
from typing import Any

import numpy as np

from jointplay.client.halving import parts_that_fit
from jointplay.client.job_record import JobRecord
from jointplay.records.channel import Channel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure, PointStatus
from jointplay.records.run import Floats
from jointplay.records.study import StudyDataset

Document = dict[str, Any]


def study_of(
    job: JobRecord, fetch: Callable[..., Document], sections: tuple[int, int]
) -> StudyDataset:
    """Return a study with the extremes of channels, and times and observables at its sections.

    Parameters
    ----------
    job
        The study.
    fetch
        Asks for points, with `start`, `section_start` and `section_stop`.
    sections
        First section, and the one before which to end.
    """

    def pages_of(window: tuple[int, int]) -> list[Document]:
        first, last = window
        ranges = {"section_start": first, "section_stop": last} if last else {}
        return list(_pages(partial(fetch, **ranges)))

    def table(name: str) -> Floats:
        parts = []
        for (first, last), pages in windows:
            rows = [page["sections"][name] if name else page["time"] for page in pages]
            values = list(chain.from_iterable(one["values"] for one in rows if one))
            parts.append(_table(values, last - first))
        return np.concatenate(parts, axis=1)

    windows = list(parts_that_fit(pages_of, sections, _halves))
    _, pages = windows[0]
    shape = tuple(pages[0]["shape"])
    observables, channels = pages[0]["sections"], pages[0]["peaks"]
    extremes = {}
    for name in channels:
        peaks = [page["peaks"][name] for page in pages]
        columns = [_joined([one[part] for one in peaks]) for part in PeakColumns._fields]
        extremes[name] = PeakColumns(*columns)
    return _study(
        job,
        pages,
        observables=_channels(observables),
        channels=_channels(channels),
        times=table(""),
        section_values={name: table(name) for name in observables},
        recorded=np.array([count for page in pages for count in page["counts"]], np.int64),
        extremes=extremes,
        grid=shape if len(shape) > 1 else (),
    )


def _halves(sections: tuple[int, int]) -> tuple[tuple[int, int], tuple[int, int]] | None:
    first, last = sections
    middle = (first + last) // 2
    return None if last - first < 2 else ((first, middle), (middle, last))


def _pages(fetch: Callable[..., Document]) -> Iterator[Document]:
    start: int | None = 0
    while start is not None:
        page = fetch(start=start)
        yield page
        start = page["next_start"]


def _study(job: JobRecord, pages: Sequence[Document], **results: Any) -> StudyDataset:
    """Put together what every study has."""
    first = pages[0]
    values = list(_columns(pages, "values").values())
    status = [PointStatus[word] for page in pages for word in page["status"]]
    codes, names = None, []
    if first.get("verdicts") is not None:
        words = [word for page in pages for word in page["verdicts"]]
        names = sorted({word for word in words if word is not None})
        codes = np.array([-1 if word is None else names.index(word) for word in words], np.int64)
    scene = job.job["scene"]
    return StudyDataset(
        attributes={
            "job": job.job,
            "scene": scene if "bodies" in scene else {},
            "meanings": {
                name: (one["unit"], one["long_name"]) for name, one in first["statistics"].items()
            },
        },
        parameters=_channels(first["values"]),
        values=np.array(values).reshape(len(values), len(status)).T,
        status=np.array(status, np.uint8),
        failures={
            one["point"]: Failure(one["code"], one["detail"], one["time"])
            for page in pages
            for one in page["failures"]
        },
        statistics=_columns(pages, "statistics"),
        indicators=_columns(pages, "indicators"),
        verdicts=codes,
        verdict_names=names,
        reasons={
            page["start"] + at: reason
            for page in pages
            for at, reason in enumerate(page.get("reasons") or ())
            if reason is not None
        },
        **results,
    )


def _columns(pages: Sequence[Document], group: str) -> dict[str, Floats]:
    """Join columns by name; a page that was made before a name occurred has none of it."""
    names = dict.fromkeys(name for page in pages for name in page.get(group, ()))
    return {
        name: _joined(
            [
                page[group][name]["values"] if name in page[group] else [None] * len(page["status"])
                for page in pages
            ]
        )
        for name in names
    }


def _table(rows: Sequence[Sequence[float | None]], width: int) -> Floats:
    table = np.full((len(rows), width), np.nan)
    for row, values in zip(table, rows, strict=True):
        row[: len(values)] = np.array(values, np.float64)
    return table


def _joined(columns: Sequence[Sequence[float | None]]) -> Floats:
    return np.array(list(chain.from_iterable(columns)), np.float64)


def _channels(described: Mapping[str, Document]) -> list[Channel]:
    return [Channel(name, one["unit"], one["long_name"]) for name, one in described.items()]
