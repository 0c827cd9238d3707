"""The device that is found is one made for double precision."""

from typing import Any

import pytest

from jointplay.solver.kernels.device.driver import RATIO, Device, DeviceError
from jointplay.solver.runs.found_device import found_device
from tests.solver.kernels.device.driver_by_host import DriverByHost


class OfRatio(DriverByHost):
    """A driver of a device that is so many times as fast in single precision."""

    def __init__(self, ratio: int) -> None:
        super().__init__()
        self._ratio = ratio

    def cuDeviceGetAttribute(self, value: Any, which: int, _device: Any) -> int:  # noqa: N802
        assert which == RATIO
        value._obj.value = self._ratio
        return 0


@pytest.mark.parametrize(
    ("ratios", "name"), [([2], "cuda:0"), ([64, 4], "cuda:1"), ([64, 32], None), ([], None)]
)
def test_the_first_one_that_serves_is_found(ratios: list[int], name: str | None) -> None:
    def opened(number: int) -> Device:
        if number == len(ratios):
            raise DeviceError("there is no such device")
        return Device(number, library=OfRatio(ratios[number]))

    assert found_device(opened) == name
