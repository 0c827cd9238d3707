"""Whether a device serves is told of its bits; this processor does what the driver does."""

from typing import Any

import numpy as np

from jointplay.solver.kernels.device.driver import Device
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.runs.device_trial import try_device
from tests.solver.kernels.device.driver_by_host import DriverByHost
from tests.solver.readable_mechanics import preset


class RoundedTwice(DriverByHost):
    """Rounds products before they are added to."""

    def cuModuleLoadDataEx(self, module: Any, code: bytes, *rest: Any) -> int:  # noqa: N802
        text = code.decode().replace("@llvm.fma.v1f64", "@apart")
        numbers = "<1 x double>"
        declared = f"declare {numbers} @apart({', '.join([numbers] * 3)})"
        assert declared in text
        defined = f"""define {numbers} @apart({numbers} %x, {numbers} %y, {numbers} %z) {{
          %product = fmul {numbers} %x, %y
          %sum = fadd {numbers} %product, %z
          ret {numbers} %sum
        }}"""
        return super().cuModuleLoadDataEx(module, text.replace(declared, defined).encode(), *rest)


def trial_by(driver: DriverByHost) -> Any:
    scenes = [preset("slider-crank", clearance=float(c)) for c in np.linspace(1e-4, 5e-4, BUNDLE)]
    return try_device(Device(library=driver), scenes, 16)


def test_a_device_with_the_same_bits_serves() -> None:
    trial = trial_by(DriverByHost())
    assert trial.serves
    assert trial.name == "this processor"
    assert trial.steps > trial.revolutions > 0.0


def test_a_device_with_other_bits_does_not() -> None:
    trial = trial_by(RoundedTwice())
    assert not trial.same_bits
    assert not trial.serves
