"""Attributes of stored arrays as netCDF files can hold them, too."""

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr


def in_netcdf(dataset: "xr.Dataset") -> "xr.Dataset":
    """Return a dataset that `to_netcdf` takes: an attribute that is no text or number is JSON text.

    A list of numbers stays one.  True is 1, and false 0.
    """
    found = dataset.assign_attrs({name: _plain(one) for name, one in dataset.attrs.items()})
    for variable in found.variables.values():
        variable.attrs = {name: _plain(one) for name, one in variable.attrs.items()}
    return found


def _plain(value: Any) -> str | float | list[Any]:
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, str | int | float) or _are_numbers(value):
        return value  # type: ignore[no-any-return]
    return json.dumps(value)


def _are_numbers(value: Any) -> bool:
    kinds = {type(one) for one in value} if isinstance(value, list) else set()
    return bool(kinds) and kinds <= {int, float}
