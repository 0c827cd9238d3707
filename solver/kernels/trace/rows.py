"""Which channels are watched for extremes at every step, and which need not be.

A constant, a function of time alone (a driven crank) or a multiple of another channel is left out
of the watch: its extremes follow afterwards. What is watched costs memory traffic at every step.
"""

from collections.abc import Callable, Iterable
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
    bent: tuple[bool, ...]
    """Whether each that is scanned has a kink where friction bends, see `_bent`."""

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
    moving = _depending(equations.channels.values(), _moves)
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
    bends = _bent(equations)
    bent = tuple(equations.channels[name] in bends for name in (*names, *contacts))
    return Rows(names, contacts, rest, multiples, alike, bent)


def _kind(unit: str) -> str:
    return unit.replace("rad", "m").removesuffix(" m")


def _bent(equations: Equations) -> set[Expression]:
    """Return the nodes of channels that have a kink inside a step where a slip comes to a bend.

    These are accelerations, and what friction does where pairs touch; of the state alone, which is
    smooth inside a step, nothing has one.
    """
    every, slips = equations.channels.values(), {slip for slip, _ in equations.slips}
    accelerated = _depending(every, lambda node: _is_variable(node, "slope"))
    touching = _depending(every, lambda node: _is_variable(node, "mode"))
    return accelerated | touching & _depending(every, slips.__contains__)


def _moves(node: Expression) -> bool:
    return node.operation == "variable" and not _is_variable(node, IN_TIME)


def _is_variable(node: Expression, begins: str | tuple[str, ...]) -> bool:
    return node.operation == "variable" and str(node.data).startswith(begins)


def _depending(
    expressions: Iterable[Expression], own: Callable[[Expression], bool]
) -> set[Expression]:
    """Return the nodes of expressions of which this is true, or that depend on such a one."""
    found: set[Expression] = set()
    for node in reachable(expressions):
        if own(node) or any(argument in found for argument in node.arguments):
            found.add(node)
    return found
