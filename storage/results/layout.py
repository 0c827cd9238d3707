"""Layout of a results store: named columns with units, and how many rows of each."""

import json
from dataclasses import astuple, dataclass, field
from hashlib import sha256
from typing import Any, Final

from jointplay.records.channel import Channel
from jointplay.records.names import STORED, is_storable
from jointplay.storage.errors import InvalidLayout
from jointplay.storage.results.partition import Partition

MANIFEST: Final = "MANIFEST.json"
SCHEMA_VERSION: Final = 1


@dataclass(frozen=True)
class ResultLayout:
    """Everything that fixes the shape of a store before the first row is known.

    Parameters
    ----------
    channels
        Columns of the history and of the Poincare sections, in this order.
    samples
        Rows of a history that runs to its end.
    sections
        Poincare sections of a run that comes to its end; 0 where there are none.
    joints
        Names of the joints that impacts refer to by index.
    attributes
        JSON document for the root group: the filled-in job, versions, the digest.
    partition
        How rows are cut into files.

    Raises
    ------
    InvalidLayout
        A name that a store cannot hold or that occurs twice, a negative count, or attributes
        that JSON cannot carry.
    """

    channels: tuple[Channel, ...]
    samples: int
    sections: int
    joints: tuple[str, ...]
    attributes: dict[str, Any] = field(default_factory=dict)
    partition: Partition = field(default_factory=Partition)

    def __post_init__(self) -> None:
        seen: set[str] = set()
        for channel in self.channels:
            check_name(channel.name)
            if channel.name in STORED:
                raise InvalidLayout(
                    f"{channel.name!r} cannot name a channel: the store uses that name itself"
                )
            if channel.name in seen:
                raise InvalidLayout(f"channel {channel.name!r} occurs twice; names are unique")
            seen.add(channel.name)
        if self.samples < 0 or self.sections < 0:
            raise InvalidLayout("samples and sections are counts and cannot be negative")
        try:
            json.dumps(self.attributes, allow_nan=False)
        except (TypeError, ValueError) as error:
            raise InvalidLayout(f"attributes must be finite JSON values: {error}") from error

    @property
    def digest(self) -> str:
        """SHA-256 over the arrays (not the attributes): two runs with it can share shards."""
        shape = [
            SCHEMA_VERSION,
            self.channels,
            self.samples,
            self.sections,
            list(self.joints),
            astuple(self.partition),
        ]
        return sha256(json.dumps(shape).encode()).hexdigest()


def check_name(name: str) -> None:
    """Raise `InvalidLayout` if an array cannot have this name."""
    if not is_storable(name):
        raise InvalidLayout(
            f"{name!r} cannot name an array: use 1 to 64 letters, digits, '_', "
            "'.' and '-', not starting with '.' and not ending in .json or .partial"
        )
