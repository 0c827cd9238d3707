"""Units of laws: the same law in units of other lengths, masses and times."""

from typing import Any, NamedTuple, TypeVar

from hypothesis import strategies as st

from jointplay.solver.quantities.units import Strict

ROUNDING = 1e-13
"""A law is about ten operations, and a power of a large ratio amplifies a rounding tenfold."""


class Units(NamedTuple):
    """Factors by which the numbers of lengths, masses and times grow."""

    m: float
    kg: float
    s: float

    def of(self, unit: str, law: Strict) -> float:
        """Return the factor of a unit such as N/m^n; a law's own exponent stands for n."""
        if unit.startswith("unit of"):  # of what another field chooses; here it is left alone
            return 1.0
        factor = 1.0
        for place, part in enumerate(unit.split("/")):
            for symbol in part.split():
                name, _, power = symbol.partition("^")
                exponent = getattr(law, "exponent", 0.0) if power == "n" else float(power or 1)
                factor *= self._base(name) ** (exponent if place == 0 else -exponent)
        return factor

    def _base(self, name: str) -> float:
        newton = self.kg * self.m / self.s**2
        return {
            "1": 1.0,
            "rad": 1.0,
            "N": newton,
            "Pa": newton / self.m**2,
            "J": newton * self.m,
        }.get(name) or float(getattr(self, name))


some_units = st.builds(Units, *[st.floats(0.01, 100.0)] * 3)
Law = TypeVar("Law", bound=Strict)


def rescaled(law: Law, units: Units) -> Law:
    """Return a law with the numbers that its parameters have in other units."""
    fields = type(law).model_fields
    values: dict[str, Any] = {}
    for name, field in fields.items():
        extra = field.json_schema_extra
        unit = extra.get("unit", "1") if isinstance(extra, dict) else "1"
        value = getattr(law, name)
        if isinstance(value, Strict):
            values[name] = rescaled(value, units)
        else:
            values[name] = value * units.of(str(unit), law) if isinstance(value, float) else value
    return type(law).model_construct(**values)
