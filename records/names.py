"""Names that results may carry, and those that a scene or a store keeps for itself."""

import re
from typing import Final

TIME: Final = "time"
GROUPS: Final = ("poincare", "peaks", "impacts", "pyramid", "certificate")
"""Groups of a run's store, beside its channels."""

STORED: Final = frozenset({TIME, "c", *GROUPS})
"""Names in a run's store beside its channels; Zarr keeps an array's chunks under ``c``."""
RESERVED: Final = frozenset({"ground", "energy", TIME, *GROUPS})
"""Names that no body, joint, driver or output of a scene may have."""
RESERVED_OUTPUTS: Final = RESERVED | STORED
"""Names that no output may have: its channel is an array in the root of the store."""

# also what a key of a store may look like when it is served
_STORABLE: Final = re.compile(r"(?!\.)[A-Za-z0-9_.-]{1,64}")


def is_storable(name: str) -> bool:
    """Tell whether an array of a store can have this name."""
    return bool(_STORABLE.fullmatch(name)) and not name.endswith((".json", ".partial"))
