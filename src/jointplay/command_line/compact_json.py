"""JSON for people: what fits on a line stays on one, as the shipped scenes are written."""

import json

WIDTH = 120


def compact_json(value: object) -> str:
    """Return a JSON document; an object or list is broken where it would exceed a line.

    Raises
    ------
    ValueError
        A number that JSON cannot carry.
    """
    return _broken(value, 0, 0) if isinstance(value, dict | list) and value else _line(value)


def _line(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _broken(value: object, indent: int, before: int) -> str:
    """Return a value that begins after `before` characters of its line."""
    line = _line(value)
    fits = before > 0 and before + len(line) + 1 <= WIDTH  # a comma may follow
    if fits or not isinstance(value, dict | list) or not value:
        return line
    inner = " " * (indent + 2)
    if isinstance(value, dict):
        keys = [f"{inner}{_line(key)}: " for key in value]
        values, ends = list(value.values()), "{}"
    else:
        keys, values, ends = [inner] * len(value), list(value), "[]"
    items = [
        key + _broken(item, indent + 2, len(key)) for key, item in zip(keys, values, strict=True)
    ]
    return "\n".join([ends[0], ",\n".join(items), " " * indent + ends[1]])
