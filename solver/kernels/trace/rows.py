"""Which channels are watched for extremes at every step, and which need not be.

A constant, a function of time alone (a driven crank) or a multiple of another channel is left out
of the watch: its extremes follow afterwards. What is watched costs memory traffic at every step.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene

NO_ROW = -1
"""Row of a channel that is not watched."""
IN_TIME = ("stage_time", "phase")
"""First words of variables that follow from time alone."""


@dataclass(frozen=True)
class Rows:
    """The channel block: watched channels, normal force of each pair again, then the rest.

    The repeated normal forces have extremes of their own, for the peak of each contact.
    """

    watched: tuple[str, ...]
    contacts: tuple[str, ...]
    rest: tuple[str, ...]
    multiples: dict[str, tuple[str, float, float]]
    """Channels that are factor * watched channel + offset: (channel, factor, offset)."""
    alike: tuple[int, ...]
    """First row of the kind of each that is scanned: angles count as lengths, moments as forces."""

    @property
    def names(self) -> tuple[str, ...]:
        """Channel of each row."""
        return self.watched + self.contacts + self.rest

    @property
    def scanned(self) -> int:
        """Number of rows that the scan looks at."""
        return len(self.watched) + len(self.contacts)

    def index(self, name: str) -> int:
        """Return the first row of a channel."""
        return self.names.index(name)

    def watched_row(self, name: str) -> int:
        """Return the row that has a channel's extremes, its own or that which it equals.

        `NO_ROW` if it has none: a constant, or a function of time alone.
        """
        source = self.multiples[name][0] if name in self.multiples else name
        return self.watched.index(source) if source in self.watched else NO_ROW


def arrange(scene: Scene, equations: Equations) -> Rows:
    """Sort the channels of a scene into rows."""
    watched: dict[int, str] = {}
    multiples: dict[str, tuple[str, float, float]] = {}
    linear = {o.name: (o.channel, o.factor, o.offset) for o in scene.outputs}
    moving = _moving(equations.channels.values())
    for name, expression in equations.channels.items():
        if name == "stored" or expression not in moving:
            continue
        if expression.index in watched:
            multiples[name] = (watched[expression.index], 1.0, 0.0)
        elif name in linear and linear[name][0] in watched.values():
            multiples[name] = linear[name]
        else:
            watched[expression.index] = name
    names = tuple(watched.values())
    rest = tuple(name for name in equations.channels if name not in names)
    contacts = tuple(f"{name}.normal_force" for name in equations.pairs)
    kinds = {channel.name: _kind(channel.unit) for channel in channels(scene)}
    scanned = [kinds[name] for name in (*names, *contacts)]
    alike = tuple(map(scanned.index, scanned))
    return Rows(names, contacts, rest, multiples, alike)


def _kind(unit: str) -> str:
    return unit.replace("rad", "m").removesuffix(" m")


def _moving(expressions: Iterable[Expression]) -> set[Expression]:
    """Return the nodes of expressions that depend on more than time."""
    moving: set[Expression] = set()
    for node in reachable(expressions):
        own = node.operation == "variable" and not str(node.data).startswith(IN_TIME)
        if own or any(argument in moving for argument in node.arguments):
            moving.add(node)
    return moving
