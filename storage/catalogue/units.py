"""Methods of the catalogue, made of functions that take one unit of reading or writing."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import update_wrapper
from typing import Concatenate, ParamSpec, Protocol, TypeVar

from sqlalchemy import Connection

from jointplay.storage.catalogue.connections import Connections, Unit

Given = ParamSpec("Given")
Answer = TypeVar("Answer")
_InUnit = Callable[Concatenate[Unit, Given], Answer]
_Method = Callable[Concatenate["Connected", Given], Answer]


class Connected(Protocol):
    """Whatever has connections and a clock: the catalogue."""

    connections: Connections
    clock: Callable[[], float]


def _in_unit(
    function: _InUnit[Given, Answer],
    begin: Callable[["Connected"], AbstractContextManager[Connection]],
) -> _Method[Given, Answer]:
    def method(catalogue: "Connected", /, *given: Given.args, **named: Given.kwargs) -> Answer:
        def unit() -> Answer:
            with begin(catalogue) as connection:
                return function(Unit(connection, catalogue.clock()), *given, **named)

        return catalogue.connections.repeated(unit)

    update_wrapper(method, function)
    return method


def _once_in_unit(
    function: _InUnit[Given, Answer],
    begin: Callable[["Connected"], AbstractContextManager[Connection]],
) -> _Method[Given, Answer]:
    """Make a method that, repeated as the answer to its commit was lost, answers what it did."""

    def method(catalogue: "Connected", /, *given: Given.args, **named: Given.kwargs) -> Answer:
        reached: list[tuple[int, Answer]] = []

        def unit() -> Answer:
            for earlier, found in reached:
                if catalogue.connections.committed(earlier):
                    return found
            reached.clear()
            with begin(catalogue) as connection:
                answer = function(Unit(connection, catalogue.clock()), *given, **named)
                mark = catalogue.connections.mark(connection)
                if mark is not None:
                    reached.append((mark, answer))
            return answer

        return catalogue.connections.repeated(unit)

    update_wrapper(method, function)
    return method


def reading(function: _InUnit[Given, Answer]) -> _Method[Given, Answer]:
    """Make a method of a function that reads in one unit."""
    return _in_unit(function, lambda catalogue: catalogue.connections.reading())


def writing(function: _InUnit[Given, Answer]) -> _Method[Given, Answer]:
    """Make a method of a function that writes in one unit, which a power cut may undo."""
    return _in_unit(function, lambda catalogue: catalogue.connections.writing())


def writing_once(function: _InUnit[Given, Answer]) -> _Method[Given, Answer]:
    """Make a method of a function that would do another thing if it were repeated."""
    return _once_in_unit(function, lambda catalogue: catalogue.connections.writing())


def durably_once(function: _InUnit[Given, Answer]) -> _Method[Given, Answer]:
    """Make a method as `writing_once`, whose writing is on the disk when it returns."""
    return _once_in_unit(function, lambda catalogue: catalogue.connections.writing(durable=True))


def durably(function: _InUnit[Given, Answer]) -> _Method[Given, Answer]:
    """Make a method of a function that writes in one unit, on the disk when it returns."""
    return _in_unit(function, lambda catalogue: catalogue.connections.writing(durable=True))


def claiming(function: _InUnit[Given, Answer]) -> _Method[Given, Answer]:
    """Make a method as `writing_once`, whose writing lasts as long as its caller."""
    return _once_in_unit(function, lambda catalogue: catalogue.connections.claiming())
