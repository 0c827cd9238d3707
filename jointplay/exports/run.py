"""Channels as CSV or JSON text, piece by piece: memory does not grow with the history."""

import json
from collections.abc import Iterator, Sequence

import numpy as np

from jointplay.records.channel_choice import no_such_channel
from jointplay.records.run import Floats, Source

_TIME_UNIT = "s"


def csv_lines(
    source: Source,
    channels: Sequence[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
    comments: Sequence[str] = (),
) -> Iterator[str]:
    """Write a window of the history as comma-separated values.

    Parameters
    ----------
    source
        Where the samples are.
    channels
        Names of the columns after the time; all if None.
    start, stop
        First and last time [s], both included; None is unbounded.
    comments
        Text for lines that begin with `#`, before the header.

    Yields
    ------
    str
        Whole lines: the comments, one header row `time [s],slider7.x [m],...`, then one row a
        sample with 17 significant digits, which give back every bit. What was not computed is
        `nan`.

    Raises
    ------
    NoSuchChannel
        On the first piece, before any text.
    """
    names = _names(source, channels)
    units = {channel.name: channel.unit for channel in source.channels}
    for comment in comments:
        for line in comment.splitlines() or [""]:
            yield f"# {line}".rstrip() + "\n"
    header = [f"time [{_TIME_UNIT}]", *(f"{name} [{units[name]}]" for name in names)]
    yield ",".join(header) + "\n"
    row_format = ",".join(["%.17g"] * len(header)) + "\n"
    for time, columns in source.blocks(names, *source.between(start, stop)):
        table = np.column_stack([time, *(columns[name] for name in names)])
        if len(table):
            yield "".join([row_format % tuple(row) for row in table.tolist()])


def json_pieces(
    source: Source,
    channels: Sequence[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
) -> Iterator[str]:
    """Write a window of the history as one JSON document.

    Parameters
    ----------
    source, channels, start, stop
        As for `csv_lines`.

    Yields
    ------
    str
        Pieces of `{"complete", "time": {"unit", "long_name", "values"}, "channels": {name:
        {"unit", "long_name", "values"}}}`. Numbers give back every bit; what was not computed
        is null, since JSON has no NaN.

    Raises
    ------
    NoSuchChannel
        On the first piece, before any text.
    """
    names = _names(source, channels)
    described = {channel.name: channel for channel in source.channels}
    window = source.between(start, stop)
    yield f'{{"complete": {json.dumps(source.complete)}, "time": '
    times = (time for time, _ in source.blocks([], *window))
    yield from _series(_TIME_UNIT, "time", times)
    yield ', "channels": {'
    for position, name in enumerate(names):
        yield f"{', ' if position else ''}{json.dumps(name)}: "
        values = (columns[name] for _, columns in source.blocks([name], *window))
        yield from _series(described[name].unit, described[name].long_name, values)
    yield "}}\n"


def _series(unit: str, long_name: str, blocks: Iterator[Floats]) -> Iterator[str]:
    yield f'{{"unit": {json.dumps(unit)}, "long_name": {json.dumps(long_name)}, "values": ['
    separator = ""
    for block in blocks:
        if len(block):
            values = ", ".join(
                [repr(value) if np.isfinite(value) else "null" for value in block.tolist()]
            )
            yield separator + values
            separator = ", "
    yield "]}"


def _names(source: Source, channels: Sequence[str] | None) -> list[str]:
    known = [channel.name for channel in source.channels]
    if channels is None:
        return known
    if unknown := [name for name in channels if name not in known]:
        raise no_such_channel(unknown, known)
    return list(channels)
