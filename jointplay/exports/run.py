"""Channels as CSV or JSON text, piece by piece: memory does not grow with the history."""

import json
from collections.abc import Iterator, Sequence

from jointplay.records import text_tables
from jointplay.records.channel import TIME, Channel, by_name
from jointplay.records.channel_choice import no_such_channel
from jointplay.records.run import Floats, Source
from jointplay.records.text_tables import json_numbers


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
    described = by_name(source.channels)
    titles = [one.title for one in (TIME, *(described[name] for name in names))]
    blocks = source.blocks(names, *source.between(start, stop))
    rows = ((time, *(columns[name] for name in names)) for time, columns in blocks)
    yield from text_tables.csv_lines(titles, rows, comments)


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
    described = by_name(source.channels)
    window = source.between(start, stop)
    yield f'{{"complete": {json.dumps(source.complete)}, "time": '
    times = (time for time, _ in source.blocks([], *window))
    yield from _series(TIME, times)
    yield ', "channels": {'
    for position, name in enumerate(names):
        yield f"{', ' if position else ''}{json.dumps(name)}: "
        values = (columns[name] for _, columns in source.blocks([name], *window))
        yield from _series(described[name], values)
    yield "}}\n"


def _series(channel: Channel, blocks: Iterator[Floats]) -> Iterator[str]:
    unit, long_name = json.dumps(channel.unit), json.dumps(channel.long_name)
    yield f'{{"unit": {unit}, "long_name": {long_name}, "values": ['
    separator = ""
    for block in blocks:
        if len(block):
            yield separator + json_numbers(block)
            separator = ", "
    yield "]}"


def _names(source: Source, channels: Sequence[str] | None) -> list[str]:
    known = [channel.name for channel in source.channels]
    if channels is None:
        return known
    if unknown := [name for name in channels if name not in known]:
        raise no_such_channel(unknown, known)
    return list(channels)
