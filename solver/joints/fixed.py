"""Two bodies in one."""

from collections.abc import Iterator
from typing import ClassVar, Literal

from jointplay.solver.joints.drawing import Drawing
from jointplay.solver.joints.holding import Holding, Row
from jointplay.solver.joints.joint import Freedom, Joint
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.units import Angle, PointReference


class Fixed(Joint):
    """Two bodies welded at a point; `angle` is the part's angle less the base's."""

    called: ClassVar[str] = "fixed"
    end_fields: ClassVar[tuple[str, str]] = ("base", "part")
    drawing: ClassVar[Drawing] = Drawing(sign="weld", supported=True)
    freedom: ClassVar[Freedom] = "none"
    holds_angle: ClassVar[bool] = True
    type: Literal["fixed"]
    base: PointReference
    part: PointReference
    angle: Angle = 0.0

    def rows(self, held: Holding[Row], _motion: Derivatives | None) -> Iterator[Row]:
        """Yield: the points are one, the angle stays."""
        yield from held.coincident()
        yield held.at_angle(self.angle)
