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
from jointplay.storage.results.metadata import DOUBLE, Document
from jointplay.storage.studies.cut import chunk_shape
from jointplay.storage.studies.layout import StudyLayout

_STATUS: Final = {
    "long_name": "what became of the point",
    "flag_values": [int(status) for status in PointStatus],
    "flag_meanings": " ".join(status.name for status in PointStatus),
}


def running(layout: StudyLayout) -> dict[str, Document]:
    """Make the documents of a store that is being filled: groups only, the root's last."""
    found = _documents(layout, _values(layout, ()) | _sections(layout), {"complete": False})
    return metadata.groups_among(found)


def sealed(
    layout: StudyLayout, names: Sequence[str], attributes: Mapping[str, Any]
) -> dict[str, Document]:
    """Make every document of a sealed store, the root's last.

    Parameters
    ----------
    layout
        Of the study.
    names
        Of the numbers that points have, as in `Points.numbers`.
    attributes
        Root attributes that the layout does not know.
    """
    chunk = chunk_shape(layout)
    byte, integer = np.dtype("u1"), np.dtype("<i4")

    def column(dtype: np.dtype[Any], attributes: Mapping[str, Any]) -> Document:
        return metadata.array(layout.shape, chunk, dtype, layout.dimensions, attributes)

    arrays = {
        "status": column(byte, _STATUS),
        "count": column(integer, {"long_name": "sections recorded"}),
        "failure": column(byte, {"long_name": "reason, a position in the attribute failures"}),
        "failure_time": column(DOUBLE, {"units": "s", "long_name": "simulated time at failure"}),
    }
    for path in names:
        name = path.partition("/")[2]
        output = layout.outputs.get(name, Channel(name, "1", name.replace("_", " ")))
        arrays[path] = column(DOUBLE, output.attributes)
    if layout.channels:
        width = len(layout.channels)
        shape, cut = [*layout.shape, width], [*chunk_shape(layout, width), width]
        for name, attributes_of in PEAK.items():
            arrays[f"peaks/{name}"] = metadata.array(
                shape, cut, DOUBLE, [*layout.dimensions, "channel"], attributes_of
            )
    return _documents(layout, _values(layout, names) | _sections(layout) | arrays, attributes)


def prefixes_of_values(layout: StudyLayout, names: Sequence[str]) -> list[str]:
    """Return what the values of parameters have before their names: each group of a map's numbers.

    So each group has its coordinates, whichever of them is opened.
    """
    if not layout.coordinates:
        return ["values/"]
    groups = dict.fromkeys(f"{path.partition('/')[0]}/" for path in names)
    return ["", *groups, *(["peaks/"] if layout.channels else [])]


def _values(layout: StudyLayout, names: Sequence[str]) -> dict[str, Document]:
    if not layout.coordinates:
        chunk = chunk_shape(layout)
        return {
            f"values/{spec.name}": metadata.array(
                [layout.points], chunk, DOUBLE, ["point"], spec.attributes
            )
            for spec in layout.parameters
        }
    return {
        prefix + axis: metadata.array(
            values.shape, values.shape, DOUBLE, [axis], {**spec.attributes, "parameter": spec.name}
        )
        for prefix in prefixes_of_values(layout, names)
        for axis, (spec, values) in layout.coordinates.items()
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


def _documents(
    layout: StudyLayout, arrays: Mapping[str, Document], attributes: Mapping[str, Any]
) -> dict[str, Document]:
    about = {
        "study_schema": layout.schema,
        "layout": layout.digest,
        "points": layout.points,
        **({"shape": layout.shape} if layout.coordinates else {}),
        "record": layout.record,
        "blocks": layout.blocks,
        "parameters": layout.parameters,
        "observables": layout.observables,
        "channels": layout.channels,
    }
    own = {"peaks": {"channels": [spec.name for spec in layout.channels]}}
    groups = list(dict.fromkeys(key.rpartition("/")[0] for key in arrays))
    nodes = {group: metadata.group(own.get(group, {}), {}) for group in groups if group}
    # zarr finds no more of a group than what stands together
    together = sorted(arrays.items(), key=lambda item: groups.index(item[0].rpartition("/")[0]))
    nodes |= dict(together)
    return metadata.documents({**layout.attributes, **about, **attributes}, nodes)
