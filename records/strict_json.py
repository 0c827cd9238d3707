"""JSON as RFC 8259 has it: no NaN, no infinity, no duplicate keys, bounded nesting.

Python's parser is more generous: of two equal keys the last one wins silently, and ``1e400`` is
read as infinity; pydantic-core's says nothing of equal keys either.  Service and command line read
every document through `parse`, so that a job means the same wherever it is given.
"""

import codecs
import json
import math
from types import NoneType
from typing import Any, NamedTuple, NoReturn

DEEPEST = 64  # a scene document nests 6 levels; nothing legitimate comes near
MOST_FLAWS = 20  # enough to correct a document by, few enough to read
INTEGER_DIGITS = 18  # up to here an integer surely fits 64 bits
_LONGEST_SHOWN = 60
_SOUND = (int, float, NoneType)  # nothing can be wrong with these: lists of a million are common


class Flaw(NamedTuple):
    """One thing that is wrong with a document.

    ``pointer`` is the RFC 6901 pointer of the place, ``detail`` one sentence.
    """

    pointer: str
    detail: str


class MalformedJson(ValueError):
    """The text is not JSON as RFC 8259 defines it; ``flaws`` says where and why."""

    def __init__(self, *flaws: Flaw) -> None:
        super().__init__(" ".join(flaw.detail for flaw in flaws))
        self.flaws = flaws


def finite(value: Any) -> Any:
    """Return a document with null where a number is not finite, which JSON has not."""
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, dict):
        return {name: finite(one) for name, one in value.items()}
    return [finite(one) for one in value] if isinstance(value, list | tuple) else value


class _Refused(NamedTuple):
    """Stands in the parsed document where a value was that JSON cannot carry."""

    detail: str


def parse(text: bytes) -> object:
    """Parse one JSON document.

    Parameters
    ----------
    text
        The document, UTF-8; a byte-order mark before it is passed over.

    Returns
    -------
    object
        Dictionaries, lists, strings, finite floats, integers of 64 bits, booleans and None.

    Raises
    ------
    MalformedJson
        With every flaw found (at most 20), each with the pointer of its place.
    """
    document = _loads(text.removeprefix(codecs.BOM_UTF8))
    flaws = _flaws_in(document)
    if flaws:
        raise MalformedJson(*flaws)
    return document


def escaped(key: str) -> str:
    """Return ``key`` as one RFC 6901 reference token."""
    printable = key.encode("utf-8", "replace").decode()
    return printable.replace("~", "~0").replace("/", "~1")


def _loads(text: bytes) -> object:
    try:
        return json.loads(
            text.decode("utf-8"),
            parse_float=_float,
            parse_int=_integer,
            parse_constant=_constant,
            object_pairs_hook=_object,
        )
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        _malformed(f"The document is not JSON: {error.msg.removesuffix(' at')} at {where}.")
    except UnicodeDecodeError as error:
        _malformed(f"The document is not UTF-8: byte {error.start} cannot be decoded.")
    except RecursionError:
        _malformed(_too_deep())


def _malformed(detail: str) -> NoReturn:
    raise MalformedJson(Flaw("", detail)) from None


def _too_deep() -> str:
    return f"The document is nested too deeply: at most {DEEPEST} levels are read."


def _float(text: str) -> object:
    value = float(text)
    if math.isinf(value):
        shown = text[:_LONGEST_SHOWN]
        return _Refused(f"{shown} is beyond the range of numbers; give at most 1.7e308.")
    return value


def _integer(text: str) -> object:
    return int(text) if len(text) <= INTEGER_DIGITS else _float(text)


def _constant(text: str) -> object:
    return _Refused(f"{text} is not a number that JSON knows; give a finite number.")


def _object(pairs: list[tuple[str, object]]) -> object:
    document = dict(pairs)
    if len(document) == len(pairs):
        return document
    seen: set[str] = set()
    for key, _ in pairs:
        if key in seen:
            document[key] = _Refused(f"The key {_shown(key)} is given twice; give it once.")
        seen.add(key)
    return document


def _flaws_in(document: object) -> list[Flaw]:
    """Walk the document without recursion, in reading order."""
    flaws: list[Flaw] = []
    pending: list[tuple[str, object, int]] = [("", document, 0)]
    while pending and len(flaws) < MOST_FLAWS:
        pointer, value, depth = pending.pop()
        children: list[tuple[str, object]] = []
        if isinstance(value, _Refused):
            flaws.append(Flaw(pointer, value.detail))
        elif isinstance(value, str):
            if not _storable(value):
                flaws.append(Flaw(pointer, _unstorable(value)))
        elif isinstance(value, dict):
            flaws += [Flaw(pointer, _unstorable(key)) for key in value if not _storable(key)]
            children = [
                (f"{pointer}/{escaped(key)}", child)
                for key, child in value.items()
                if not isinstance(child, _SOUND)
            ]
        elif isinstance(value, list):
            children = [
                (f"{pointer}/{index}", child)
                for index, child in enumerate(value)
                if not isinstance(child, _SOUND)
            ]
        if depth == DEEPEST and isinstance(value, dict | list) and value:
            return [Flaw("", _too_deep())]
        pending += [(*child, depth + 1) for child in reversed(children)]
    return flaws[:MOST_FLAWS]


def _storable(text: str) -> bool:
    """Tell whether every database and file can carry ``text``."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return "\0" not in text


def _unstorable(text: str) -> str:
    return f"The text {_shown(text)} contains NUL or half of a surrogate pair; leave it out."


def _shown(text: str) -> str:
    return ascii(text[:_LONGEST_SHOWN])
