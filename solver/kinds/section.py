"""Poincare sections: taken at a crank angle, at onsets of contact, or at a crossing."""

from typing import Annotated, Any, Literal

from pydantic import Field

from jointplay.solver.quantities.units import Strict, quantity
from jointplay.solver.scene.unions import discriminated_by, form, has


class CrankSection(Strict):
    """Once a period, when the first driver has turned that far past its start.

    One with a `motion` counts as turning evenly, once in the period of its function.
    """

    crank_angle: Annotated[float, quantity("rad", ge=0.0, lt=6.283185307179586)] = 0.0


class OnsetSection(Strict):
    """At each onset of contact (impact) of a contact pair."""

    onset: Annotated[
        str,
        Field(
            pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,31}(\.[a-z0-9_]{1,16})?$",
            description="a joint with clearance; of one with several contact pairs, which of them",
        ),
    ]


class ChannelSection(Strict):
    """Each time that a channel crosses a value in one direction; an angle, once a turn."""

    channel: Annotated[str, Field(min_length=1, max_length=80)]
    value: Annotated[float, quantity("the channel's unit")]
    direction: Annotated[
        Literal["up", "down"], Field(description="up: the channel grows while it crosses")
    ] = "up"


def _form_of_section(value: Any) -> str | None:
    for field in ("onset", "channel"):
        if has(value, field):
            return field
    return "crank_angle" if isinstance(value, dict | CrankSection) else None


Section = Annotated[
    Annotated[CrankSection, form("crank_angle")]
    | Annotated[OnsetSection, form("onset")]
    | Annotated[ChannelSection, form("channel")],
    discriminated_by(
        _form_of_section,
        "'section' must be an object with 'crank_angle', with 'onset', or with 'channel' and"
        " 'value'",
    ),
    Field(
        description=(
            "where sections are taken: once a period, when the first driver has turned by a crank"
            " angle since the start, where a 'motion' counts as an even turn in each period of its"
            " function; at each onset of contact in a joint; each time a channel crosses a value"
        )
    ),
]
