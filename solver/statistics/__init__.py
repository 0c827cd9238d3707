"""Statistics over a stretch of time, kept up while it is computed: flat memory, always one order.

Two families, a file a member: of channels on a uniform grid (`of_channels`), and of the contacts
of joints with clearance (`of_contacts`). A member takes what became known a few rows at a time, and
its result has the same bits however the rows were cut.
"""

from __future__ import annotations

from jointplay.records.channel import Channel
from jointplay.solver.statistics.of_channels import OF_CHANNELS
from jointplay.solver.statistics.of_contacts import OF_CONTACTS

__all__ = ["OF_CHANNELS", "OF_CONTACTS", "Output", "outputs_of"]

Output = tuple[str, str]
"""Unit and long name."""


def outputs_of(
    chosen: tuple[str, ...], channels: tuple[Channel, ...], joints: tuple[str, ...]
) -> dict[str, Output]:
    """Return unit and long name of chosen statistics of channels and joints with clearance.

    They are named after both: ``A.normal_force.mean``, ``A.contact_share``.
    """
    found: dict[str, Output] = {}
    for channel in channels:
        for name in chosen:
            if name in OF_CHANNELS:
                long_name = f"{OF_CHANNELS[name].long_name} of {channel.long_name}"
                found[f"{channel.name}.{name}"] = (channel.unit, long_name)
    for joint in joints:
        for name in chosen:
            if name in OF_CONTACTS:
                of_joint = OF_CONTACTS[name]
                found[f"{joint}.{name}"] = (of_joint.unit, f"{of_joint.long_name} (joint {joint})")
    return found
