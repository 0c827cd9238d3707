"""Fields of jobs whose starts are perturbed, and of all that draw: spread and seed."""

from typing import Annotated, Any

from jointplay.records.failure import InvalidInput
from jointplay.solver.quantities.units import quantity


def check_spread(spread: float) -> None:
    """Refuse (InvalidInput) several starts that are one."""
    if spread == 0.0:
        sentence = "Starts that are perturbed by nothing are all the same; it must be above 0."
        raise InvalidInput.at("/spread", sentence)


def spread_up_to(most: float) -> Any:
    """Return the field of how far starts lie apart, which may be as large as this."""
    return quantity(
        "1",
        ge=0.0,
        le=most,
        description=(
            "standard deviation of the starts' perturbation: positions relative to the finest"
            " clearance, velocities to that per period/2pi"
        ),
    )


def seed_of(what: str) -> Any:
    """Return the field of the seed of what is drawn."""
    return quantity("1", ge=0, le=2**53 - 1, description=f"seed of {what}; the same gives the same")


Seed = Annotated[int, seed_of("the perturbations")]
