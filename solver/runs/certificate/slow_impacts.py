"""Impacts slower than the floor of their impact rate: what a certificate says of them."""

from jointplay.solver.lanes.bundle import Bundle


def slow_impacts(bundle: Bundle, lane: int) -> str:
    """Say how many impacts of a lane were slower than the floor of their law, if any were."""
    at = bundle.lane(lane)
    count = int(at.run["slow"])
    if not count:
        return ""
    floors = sorted({float(floor) for floor in at["impact_floor"] if floor > 0.0})
    told = " to ".join(f"{floor:.2g}" for floor in (floors[0], floors[-1])[: len(floors)])
    impacts = "1 impact was" if count == 1 else f"{count} impacts were"
    return (
        f"{impacts} slower than the impact_rate_floor ({told} m/s), with less damping than the law"
        " has for that rate: give a smaller floor if their rebound matters."
    )
