"""Contacts that last, by laws with memory: what their motion rests on.

A law that latches the impact rate keeps it as long as the contact lasts: a number that nothing in
the motion changes any more, and that the motion depends on.
"""

from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs


def lasting_contacts(
    bundle: Bundle, lane: int, scene: Scene, since: float, how_long: str = "throughout"
) -> str:
    """Say which pairs of a lane have been in contact since a time, s, by a law with memory."""
    at, play = bundle.lane(lane), contact_pairs(scene)
    lasting = [
        f"{name} ({at['impact_rate'][j]:.3g} m/s, {play[name].clearance.contact.title})"
        for j, name in enumerate(bundle.kernel.pairs)
        if at["mode"][j] > 0.0 and at["onset_time"][j] <= since and at["impact_floor"][j] > 0.0
    ]
    if not lasting:
        return ""
    return (
        f"contact lasted {how_long} in {', '.join(lasting)}, with the impact rate that the law"
        " latched at the last onset (it stays the same until the next onset, and with another rate"
        " the motion may be of another kind)"
    )
