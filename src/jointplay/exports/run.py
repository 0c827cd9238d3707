"""Channels as CSV or JSON text, piece by piece: memory does not grow with the history."""

import json
from collections.abc import Iterable, Iterator, Sequence

from jointplay.records import text_tables
from jointplay.records.channel import TIME, Channel, by_name
from jointplay.records.channel_choice import no_such_channel
from jointplay.records.run import Floats, Source
from jointplay.records.text_tables import json_list, json_numbers, json_object


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
    chosen = _chosen(source, channels)
    blocks = source.blocks([one.name for one in chosen], *source.between(start, stop))
    rows = ((time, *(columns[one.name] for one in chosen)) for time, columns in blocks)
    yield from text_tables.csv_lines([one.title for one in (TIME, *chosen)], rows, comments)


def json_pieces(
    source: Source,
    channels: Sequence[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
) -> Iterator[str]:
    """Write a window of the history as one JSON document; arguments and errors as of `csv_lines`.

    Yields
    ------
    str
        Pieces of `{"complete", "time": {"unit", "long_name", "values"}, "channels": {name:
        {"unit", "long_name", "values"}}}`. Numbers give back every bit; what was not computed
        is null, since JSON has no NaN.
    """
    chosen = _chosen(source, channels)
    window = source.between(start, stop)

    def values_of(channel: Channel) -> Iterator[Floats]:
        for _, columns in source.blocks([channel.name], *window):
            yield columns[channel.name]

    times = (time for time, _ in source.blocks([], *window))
    series = {channel.name: _series(channel, values_of(channel)) for channel in chosen}
    complete = json.dumps(source.complete)
    document = {"complete": [complete], "time": _series(TIME, times)}
    yield from json_object({**document, "channels": json_object(series)})
    yield "\n"


def _series(channel: Channel, blocks: Iterable[Floats]) -> Iterator[str]:
    values = json_list(json_numbers(block) for block in blocks if len(block))
    unit, long_name = json.dumps(channel.unit), json.dumps(channel.long_name)
    return json_object({"unit": [unit], "long_name": [long_name], "values": values})


def _chosen(source: Source, names: Sequence[str] | None) -> list[Channel]:
    described = by_name(source.channels)
    if names is None:
        return list(described.values())
    if unknown := [name for name in names if name not in described]:
        raise no_such_channel(unknown, list(described))
    return [described[name] for name in names]
