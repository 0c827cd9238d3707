"""Dissipation laws with numbers of their own, for tests of all of them."""

from jointplay.solver.laws.dissipation import LAWS, Dissipation

NUMBERS = {
    "restitution": 0.6,
    "effective_mass": 2.0,
    "damping": 1e3,
    "relaxation_time": 1e-5,
    "loss": 0.2,
}


def made(name: str, **numbers: float) -> Dissipation:
    """Return a law with the numbers above, or others, as far as it has such parameters."""
    fields = LAWS[name].model_fields
    given_ones = {key: value for key, value in (NUMBERS | numbers).items() if key in fields}
    return LAWS[name].model_validate(given_ones)
