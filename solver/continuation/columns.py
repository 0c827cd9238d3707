"""Columns of the table of a branch, with their units, and labels of special orbits."""

from collections.abc import Sequence

from jointplay.records.branch import BOUND, LABEL, LENGTH, SECOND, SECOND_BOUND, UNSTABLE, VALUE
from jointplay.records.channel import Channel
from jointplay.solver.mechanics.section_states import latched_at_section, states_at_section
from jointplay.solver.scene.document import Scene

LABELS = {
    "": "an orbit of the branch",
    "EP": "start or end of the branch",
    "MX": "the branch was lost",
    "LP": "fold: a multiplier passes 1 and the branch turns back",
    "BP": "branch point: a multiplier passes 1 and the branch goes on",
    "PD": "period doubling: a multiplier passes -1",
    "NS": "Neimark-Sacker: a complex pair passes the unit circle",
    "GR": "grazing: an impact begins or ends",
    "CP": "cusp: two folds meet",
    "R1": "resonance 1:1: a second multiplier passes 1",
    "R2": "resonance 1:2: a second multiplier passes -1",
    "ST": "sticking: a phase in which friction holds, or slides, begins or ends",
    "R3": "resonance 1:3: a pair of multipliers passes a third of a turn",
    "R4": "resonance 1:4: a pair of multipliers passes a quarter of a turn",
    "GPD": "generalised doubling: period doubling is soft on one side, hard on the other",
}
"""Labels as AUTO and COCO print them; stores keep their positions."""

OF_ORBITS = (
    (LENGTH, "1", "length along the branch since its start, in scales of state and range"),
    (LABEL, "1", "special orbit, a position in the attribute labels; 0: none"),
    (BOUND, "", "error of the value at a special orbit; that of the runs comes besides"),
    ("duration", "s", "period of the orbit"),
    ("impacts", "1", "impacts in a period"),
    (UNSTABLE, "1", "multipliers outside of the unit circle; 0: the orbit is stable"),
    ("residual", "1", "distance of section and return, in the scales of the states"),
    (
        "multiplier_error",
        "1",
        "error of the multipliers, by differences at two scales and runs at two tolerances",
    ),
    ("least_gap", "m", "least gap where a pair comes near and does not touch; none: NaN"),
    (
        "least_penetration",
        "m",
        "least penetration where a pair nearly opens and does not; none: NaN",
    ),
    ("slowest_impact", "m/s", "approach rate of the slowest impact in a period; none: NaN"),
)


def columns_of(
    scene: Scene, parameters: Sequence[str], units_of: Sequence[str], *, driven: bool
) -> tuple[Channel, ...]:
    """Return the columns: the parameter's value, facts of the orbit, multipliers, the section.

    There is a multiplier for each state; of a mechanism that nothing drives one less.
    Of a second parameter there are two more: its value, and how far that is known.
    """
    states, latched = states_at_section(scene), latched_at_section(scene)
    multipliers = [
        Channel(f"multiplier_{k}.{part}", "1", f"{part} part of multiplier {k}, the largest first")
        for k in range(1, len(states) + driven)
        for part in ("real", "imaginary")
    ]
    first = Channel(VALUE, units_of[0], parameters[0])
    facts = [Channel(name, one or units_of[0], text) for name, one, text in OF_ORBITS]
    behind = []
    for name, one in zip(parameters[1:], units_of[1:], strict=True):
        behind = [Channel(SECOND, one, name), Channel(SECOND_BOUND, one, f"error of {name}")]
    return (first, *facts, *behind, *multipliers, *states, *latched)
