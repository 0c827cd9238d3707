"""Interface of joints: two points of two bodies, what holds them together, and where they touch."""

import math
from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from jointplay.records.arrays import Flags
from jointplay.solver.joints.contact import Contact, ContactState
from jointplay.solver.joints.drawing import Curve, Drawing
from jointplay.solver.joints.holding import Holding, Row
from jointplay.solver.joints.starts import GuideStart, JournalStart
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Derivatives, Function
from jointplay.solver.quantities.frames import Pair
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule, Strict

Freedom = Literal["turn", "slide", "none", "more"]
"""Motion that a joint without play leaves: its second body turns about the point that both have in
common, its point slides along an axis without turning, nothing moves, or more than one coordinate
is free. Of the last kind are joints that only close loops: they carry no body."""
DRIVEN: Mapping[str, str] = {"turn": "angle", "slide": "along"}
"""Part of a joint's constraint that prescribes its motion, by the freedom that it takes away."""
Table = tuple[tuple[str, str, str], ...]
"""Quantity, unit and meaning of channels."""
MOMENT: Table = (
    (
        "moment",
        "N m",
        "moment on the joint's second body (slider, part, follower, journal) about its point",
    ),
)
"""Channel of joints that hold an angle, or act beside their second point."""


class AnyClearance(Strict):
    """Play of a joint, with the laws of the contact that there is then.

    Each has fields `contact` and `friction` of its own, so that they stand where its document has
    them.
    """

    play_field: ClassVar[str]
    """Field of the distance of centred bodies from touching, m."""
    if TYPE_CHECKING:
        contact: ContactLaw
        friction: FrictionLaw | None

    @property
    def play(self) -> Scalar:
        """Distance of centred bodies from touching, m; 0 of an ideal joint."""
        found: Scalar = getattr(self, self.play_field)
        return found

    @property
    def rules(self) -> tuple[Rule, ...]:
        """Rules that its numbers must keep."""
        return ()


class Joint(Strict):
    """Two points of two bodies, and what the second may do against the first.

    A member of the family is one class, and an entry of `JOINTS`. It takes its numbers from its
    fields, which may be floats, columns or traced expressions. A joint with play has a
    field `clearance`; where that is above zero, contact acts in place of constraints.
    """

    type: str
    called: ClassVar[str]
    """Words for it in sentences, as in "a pin in a slot"."""
    end_fields: ClassVar[tuple[str, str]]
    """Fields that name its first and second point."""
    drawing: ClassVar[Drawing]
    """Marks by which it is drawn."""
    freedom: ClassVar[Freedom] = "more"
    holds_angle: ClassVar[bool] = False
    """Whether its bodies do not turn against each other; then the first's angle and `angle` are
    the second's."""
    is_journal: ClassVar[bool] = False
    """Whether what has play is a journal in a bearing: then its position in the play is a vector,
    and `start.joints` says where it starts."""
    one_sided: ClassVar[bool] = False
    """Whether a real one only pushes and may lift off: then its channel `normal_force` is below
    zero where it pulls without play, and what starts apart is not carried along."""
    needs_direction: ClassVar[bool] = False
    """Whether it holds its points apart on the line between them, which must have a direction."""
    parts: ClassVar[tuple[str, ...]] = ("",)
    """Names of its contact pairs; empty where there is one."""
    ideal_channels: ClassVar[Table] = ()
    """Channels of its own where it has no play, beside those that all joints have."""
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that its own numbers must keep."""
    if TYPE_CHECKING:
        angle: float

    @property
    def slack(self) -> AnyClearance | None:
        """Its clearance, if it has one, be it zero."""
        found: AnyClearance | None = getattr(self, "clearance", None)
        return found

    @property
    def has_play(self) -> bool:
        """Whether its bodies act on each other by contact, not by a constraint."""
        return self.slack is not None and bool(self.slack.play > 0.0)

    @property
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """(field, reference) of its first and second point."""
        first, second = self.end_fields
        return (first, getattr(self, first)), (second, getattr(self, second))

    @property
    def points(self) -> tuple[str, str]:
        """References of its first and second point."""
        (_, first), (_, second) = self.ends
        return first, second

    @property
    def bodies(self) -> tuple[str, str]:
        """Names of its first and second body."""
        first, second = (point.split(".")[0] for point in self.points)
        return first, second

    @property
    def has_moment(self) -> bool:
        """Whether it acts with a moment about its second point that no other channel tells."""
        return self.holds_angle

    @property
    def heading(self) -> Sequence[Scalar] | None:
        """Direction of its axis in the first body's, along which its second point may move."""
        return None

    @property
    def facing(self) -> Sequence[Scalar] | None:
        """Direction in the second body's axes away from the first, where the scene gives it."""
        return None

    @property
    def driven_part(self) -> str | None:
        """Part of its constraint that a driver prescribes; None: there is no motion to drive."""
        return DRIVEN.get(self.freedom)

    @abstractmethod
    def rows(self, held: Holding[Row], motion: Derivatives | None) -> Iterator[Row]:
        """Yield the constraints of the joint without play; `motion` is that of its driver."""

    def contact(self, name: str, part: str, between: Ends, state: ContactState) -> Contact:
        """Evaluate one of its contact pairs.

        `name` : of the joint. `between` : its second point against its first.
        """
        raise TypeError(f"{self.called} touches nowhere")

    def ideal_values(self, between: Ends, force: Pair) -> tuple[Scalar, ...]:
        """Return the values of `ideal_channels` under a force on its second body, N.

        `between` has no rates.
        """
        return ()

    @property
    def size(self) -> float:
        """Length of what touches, m."""
        return 0.0

    @property
    def is_point(self) -> bool:
        """Whether what touches is hardly larger than its play, so that it is no measure of size."""
        return False

    @property
    def deepest(self) -> Scalar:
        """Depth beyond which the formula of its contact law does not go, m."""
        return math.inf

    @property
    def loosened(self) -> Mapping[str, float]:
        """Largest violation of each part of its constraint within its play, m or rad."""
        return {}

    def is_within(self, parts: Mapping[str, float], play: float) -> bool:
        """Return whether constraints of that value, m or rad by part, are within a play, m."""
        return all(abs(value) <= play for value in parts.values())

    def curves(self) -> Iterator[Curve]:
        """Yield the curves that it is drawn by besides its marks."""
        yield from ()

    def functions(self) -> Iterator[tuple[str, Function]]:
        """Yield its fields that are functions."""
        yield from ()

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield what no rule says is wrong with it: a field, and the sentence."""
        yield from ()

    def start_problems(self, start: JournalStart) -> Iterator[tuple[str, str]]:
        """Yield what is wrong with a start of it: a field of that, and the sentence."""
        yield from ()

    def cannot_start(self, start: JournalStart) -> Flags | bool:
        """Return the same as truth values, where numbers may be columns."""
        return False

    def starts_in_wall(self, start: GuideStart) -> Flags | bool:
        """Return whether half of what it guides, or of its cam, would be in the other at a start.

        Numbers may be columns.
        """
        return False
