"""Force elements whose strength varies: with time, a driver's position, or how points lie."""

from typing import Annotated, Literal, Self

from pydantic import model_validator

from jointplay.solver.laws.force.law import Ends, ForceElement, Over
from jointplay.solver.laws.function.uses import Course
from jointplay.solver.laws.function.whole_turn import whole_turn
from jointplay.solver.quantities.scalars import Scalar, clamp_to_unit, knotted
from jointplay.solver.quantities.units import quantity

TIME, FULL_RATE = Over(), 1e-3
"""Argument and full rate where nothing else is said."""


class Varying(ForceElement):
    """An element whose strength is a number times `course`, a function of what `over` says.

    Without `over` that is time. With `only` it acts while that rises, or falls: in full from the
    rate `full_rate` on, by a smooth step between rest and that.
    """

    course: Course | None = None
    over: Over | None = None
    only: Literal["rising", "falling"] | None = None
    full_rate: Annotated[float, quantity("unit of `over` per s", gt=0.0, le=1e6)] = FULL_RATE

    @model_validator(mode="after")
    def _of_whole_turns(self) -> Self:
        """End the knots of a course over an angle with the turn that they give to seven digits."""
        if self.course is not None and self.is_over_angle:
            self.__dict__["course"] = whole_turn(self.course)  # frozen only from here on
        return self

    @property
    def is_over_angle(self) -> bool:
        """Whether it may be a function of an angle."""
        over = self.over or TIME
        return over.quantity in ("driver", "angle") and not over.rate

    def follows(self) -> Over | None:
        """Return what it is a function of, if it varies."""
        varies = self.course is not None or self.only is not None
        return (self.over or TIME) if varies else None

    def turns_counted(self) -> tuple[str, str] | None:
        """Return the points of `over`, if that is an angle."""
        over = self.follows()
        if over is None or over.quantity != "angle" or over.rate:
            return None
        return over.first or self.first, over.second or self.second

    def varied(self, strength: Scalar, ends: Ends) -> Scalar:
        """Return a strength times what it varies by."""
        if self.course is not None:
            strength = strength * self.course.at(ends.argument).value
        if self.only is not None:
            rate = ends.argument_rate if self.only == "rising" else -ends.argument_rate
            u = clamp_to_unit(rate / self.full_rate)
            share = knotted(u * u * (3.0 - 2.0 * u), rate, (0.0, self.full_rate))
            strength = strength * share
        return strength
