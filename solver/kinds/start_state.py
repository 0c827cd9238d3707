"""A state that a run starts from, instead of the scene's start."""

from typing import Annotated

from pydantic import Field

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds.methods import check_reduced
from jointplay.solver.mechanics.section_states import latched_at_section, states_at_section
from jointplay.solver.quantities.units import quantity
from jointplay.solver.scene.document import Scene

StartState = Annotated[
    list[Annotated[float, quantity("SI units")]] | None,
    Field(
        min_length=1,
        max_length=4096,
        description=(
            "section to begin at, instead of the scene's start: columns 'state.' and 'rate.' of a"
            " branch and, of pairs in contact, 'impact_rate.', which may be left out"
        ),
    ),
]


def check_state(state: list[float] | None, scene: Scene, formulation: str) -> None:
    """Refuse a state that is none of a scene.

    Raises
    ------
    InvalidInput
        It has too few or too many numbers, impact rates below zero, or coordinates are others.
    """
    if state is None:
        return
    check_reduced(formulation, "A state is given in")
    states = [one.name for one in states_at_section(scene)]
    rates = [one.name for one in latched_at_section(scene)]
    given = len(state)
    if given not in (len(states), len(states) + len(rates)):
        sentence = (
            f"A section has {len(states)} numbers, here are {given}: {', '.join(states)}"
            f"{'; these may follow: ' if rates else ''}{', '.join(rates)}."
        )
        raise InvalidInput.at("/state", sentence)
    if any(one < 0.0 for one in state[len(states) :]):
        raise InvalidInput.at("/state", "An impact rate is positive in contact, and 0 apart.")
