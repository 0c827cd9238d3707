"""Whether a device serves is told of its bits; this processor does what the driver does."""

from functools import partial
from typing import Any

import numpy as np

from jointplay.solver.kernels.device.driver import Device
from jointplay.solver.kernels.device.kernel_text import kernel_text
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.runs.device_trial import try_device
from tests.solver.kernels.device.driver_by_host import DriverByHost
from tests.solver.readable_mechanics import preset


def trial_by(write: Any) -> Any:
    scenes = [preset("slider-crank", clearance=float(c)) for c in np.linspace(1e-4, 5e-4, BUNDLE)]
    return try_device(Device(library=DriverByHost()), scenes, 16, write)


def test_a_device_with_the_same_bits_serves() -> None:
    trial = trial_by(partial(kernel_text, on_host=True))
    assert trial.serves
    assert trial.name == "this processor"
    assert trial.steps > trial.revolutions > 0.0


def test_a_device_with_other_bits_does_not() -> None:
    def rounded_twice(*given: Any) -> str:
        """Return the text with products that are rounded before they are added to."""
        text = kernel_text(*given, on_host=True).replace("@llvm.fma.v1f64", "@apart")
        numbers = "<1 x double>"
        declared = f"declare {numbers} @apart({', '.join([numbers] * 3)})"
        assert declared in text
        defined = f"""define {numbers} @apart({numbers} %x, {numbers} %y, {numbers} %z) {{
          %product = fmul {numbers} %x, %y
          %sum = fadd {numbers} %product, %z
          ret {numbers} %sum
        }}"""
        return text.replace(declared, defined)

    trial = trial_by(rounded_twice)
    assert not trial.same_bits
    assert not trial.serves
