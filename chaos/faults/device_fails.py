"""A device that is lost, or has no memory left."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation


@dataclass(frozen=True)
class DeviceFails(Fault):
    """Launches and requests for memory fail: `how` is "lost" or "memory".

    The worker goes on with its processor, until it is started again.
    """

    how: str
    lasts = (15.0, 30.0)  # code for a device takes some seconds to make

    def hindrance(self, installation: Installation) -> str | None:
        """Return why, unless a worker has a device."""
        return None if installation.device is not None else "no worker has a device"

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Let the device fail once its worker has work, and start that again."""
        device = installation.device
        assert device is not None  # noqa: S101  (no hindrance)
        device.await_work()
        device.fail(self.how)
        try:
            yield
        finally:
            device.fail_no_more()
            device.stop()
            device.start()
