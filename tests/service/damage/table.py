"""The table of damages: by kind of store and damage, what became of every reading."""

from collections import Counter
from dataclasses import dataclass, field
from enum import StrEnum

from tests.service.damage.damages import Damage
from tests.service.damage.readings import Denied, Reading


class Outcome(StrEnum):
    """Outcome of a reading of damaged results."""

    detected = "detected"
    no_effect = "no effect"
    silent = "silent"
    error = "error"
    """Refused, but not as damage."""


def outcome_of(reading: Reading, before: bytes, damage: Damage, status: str) -> tuple[Outcome, str]:
    """Read, and tell what became of it, and what was said; `status` is that of damage."""
    try:
        found = reading.read()
    except Denied as denied:
        said = str(denied)
        is_damage = "damaged" in said and (said[:3] == status or not said[:3].isdecimal())
        is_damage &= "stock Zarr" in said or any(name in said for name in damage.names)
        return Outcome.detected if is_damage else Outcome.error, said
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what the table shows
        return Outcome.error, repr(error)
    if found == before:
        return Outcome.no_effect, ""
    shown = found.decode(errors="replace")
    # `jointplay show` shows a damaged job as such
    return Outcome.detected if "damaged  " in shown else Outcome.silent, shown


@dataclass
class Table:
    """Counts of readings."""

    damages: Counter[tuple[str, str]] = field(default_factory=Counter)
    readings: Counter[tuple[str, str, Outcome]] = field(default_factory=Counter)

    def lines(self) -> list[str]:
        """Return the table as Markdown."""
        titles = ["store", "damage", "struck", *(one.value for one in Outcome)]
        rows = [titles, ["---"] * len(titles)]
        for kind, damage in self.damages:
            counts = [self.readings[kind, damage, one] for one in Outcome]
            rows.append([kind, damage, *map(str, [self.damages[kind, damage], *counts])])
        total = [
            sum(self.readings[key] for key in self.readings if key[2] is one) for one in Outcome
        ]
        rows.append(["all", "", *map(str, [self.damages.total(), *total])])
        return [f"| {' | '.join(row)} |" for row in rows]
