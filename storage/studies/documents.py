"""The zarr.json documents of a study's store, from the template of `storage.results.metadata`.

While a study runs the root's document shows the parameters' values and the sections. What has one
number a point joins when the study is sealed: until then its files would be many and tiny.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.names import TIME
from jointplay.records.peak import PEAK
from jointplay.records.point import PointStatus
from jointplay.storage.results import metadata
from jointplay.storage.results.metadata import FILE, Document
from jointplay.storage.studies.layout import CHUNK_VALUES, STUDY_SCHEMA, StudyLayout

DOUBLE: Final = np.dtype("<f8")
_STATUS: Final = {
    "long_name": "what became of the point",
    "flag_values": [int(status) for status in PointStatus],
    "flag_meanings": " ".join(status.name for status in PointStatus),
}


def point_chunk(layout: StudyLayout, width: int = 1) -> int:
    """Points in one chunk of an array with `width` numbers a point."""
    return max(min(layout.points, CHUNK_VALUES // max(width, 1)), 1)


def running(layout: StudyLayout) -> dict[str, Document]:
    """Make the documents of a store that is being filled: groups only, the root's last."""
    return _tree(layout, _values(layout) | _sections(layout), {"complete": False}, whole=False)


def sealed(
    layout: StudyLayout, names: Mapping[str, Sequence[str]], attributes: Mapping[str, Any]
) -> dict[str, Document]:
    """Make every document of a sealed store, the root's last.

    Parameters
    ----------
    layout
        Of the study.
    names
        Of the numbers that points have, by group (statistics, indicators).
    attributes
        Root attributes that the layout does not know.
    """
    points = [layout.points]
    chunk = [point_chunk(layout)]
    byte, integer = np.dtype("u1"), np.dtype("<i4")

    def column(dtype: np.dtype[Any], attributes: Mapping[str, Any]) -> Document:
        return metadata.array(points, chunk, dtype, ["point"], attributes)

    arrays = {
        "status": column(byte, _STATUS),
        "count": column(integer, {"long_name": "sections recorded"}),
        "failure": column(byte, {"long_name": "reason, a position in the attribute failures"}),
        "failure_time": column(DOUBLE, {"units": "s", "long_name": "simulated time at failure"}),
    }
    for group, members in names.items():
        for name in members:
            output = layout.outputs.get(name, Channel(name, "1", name.replace("_", " ")))
            arrays[f"{group}/{name}"] = column(DOUBLE, output.attributes)
    if layout.channels:
        width = len(layout.channels)
        shape, cut = [layout.points, width], [point_chunk(layout, width), width]
        for name, attributes_of in PEAK.items():
            arrays[f"peaks/{name}"] = metadata.array(
                shape, cut, DOUBLE, ["point", "channel"], attributes_of
            )
    return _tree(layout, _values(layout) | _sections(layout) | arrays, attributes, whole=True)


def _values(layout: StudyLayout) -> dict[str, Document]:
    chunk = [point_chunk(layout)]
    return {
        f"values/{spec.name}": metadata.array(
            [layout.points], chunk, DOUBLE, ["point"], spec.attributes
        )
        for spec in layout.parameters
    }


def _sections(layout: StudyLayout) -> dict[str, Document]:
    if not layout.record:
        return {}
    time = Channel(TIME, "s", "time since the start of the point's run")
    return {
        f"sections/{spec.name}": metadata.array(
            [layout.points, layout.record],
            layout.chunk,
            DOUBLE,
            ["point", "section"],
            spec.attributes,
        )
        for spec in (*layout.observables, time)
    }


def _tree(
    layout: StudyLayout,
    arrays: Mapping[str, Document],
    attributes: Mapping[str, Any],
    *,
    whole: bool,
) -> dict[str, Document]:
    """Documents of all groups, and of the arrays too if `whole`, by key."""
    about = {
        "study_schema": STUDY_SCHEMA,
        "layout": layout.digest,
        "points": layout.points,
        "record": layout.record,
        "blocks": layout.blocks,
        "parameters": _listed(layout.parameters),
        "observables": _listed(layout.observables),
        "channels": _listed(layout.channels),
    }
    written: dict[str, Document] = {}
    members: dict[str, Document] = {}
    of_groups: dict[str, dict[str, Document]] = {}
    for key, document in arrays.items():
        group, _, name = key.rpartition("/")
        if group:
            of_groups.setdefault(group, {})[name] = document
        if whole:
            written[f"{key}/{FILE}"] = document
    for group, below in of_groups.items():
        own = {"channels": [spec.name for spec in layout.channels]} if group == "peaks" else {}
        written[f"{group}/{FILE}"] = metadata.group(own, below)
        members[group] = metadata.group(own, {})
    written[FILE] = metadata.group(
        {**layout.attributes, **about, **attributes}, members | dict(arrays)
    )
    return written


def _listed(specs: Sequence[Channel]) -> list[list[str]]:
    return [[spec.name, spec.unit, spec.long_name] for spec in specs]
