"""Names and units of the numbers that say where a motion is at a section."""

from jointplay.records.channel import Channel
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import inner_states


def states_at_section(scene: Scene) -> tuple[Channel, ...]:
    """Return joint coordinates, their rates, and states of laws, in the order of kernels."""
    coordinates = spanning_tree(scene).coordinates
    units = ["rad" if name.endswith(".theta") else "m" for name in coordinates]
    both = list(zip(coordinates, units, strict=True))
    return (
        *(Channel(f"state.{name}", u, f"coordinate {name} at the section") for name, u in both),
        *(
            Channel(f"rate.{name}", f"{u}/s", f"rate of the coordinate {name} at the section")
            for name, u in both
        ),
        *(
            Channel(f"state.{pair}.{one.name}", one.unit, one.long_name)
            for pair, own in inner_states(scene).items()
            for one in own
        ),
    )


def latched_at_section(scene: Scene) -> tuple[Channel, ...]:
    """Return the impact rates that laws have latched, pair by pair; 0: the pair is apart."""
    return tuple(
        Channel(f"impact_rate.{pair}", "m/s", f"impact rate of {pair}, in contact at the section")
        for pair in spanning_tree(scene).pairs
    )
