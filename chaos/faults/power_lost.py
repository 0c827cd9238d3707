"""Everything ends at once, and what was not synced is gone."""

import contextlib
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation
from jointplay.chaos.power_cut import cut_catalogue, cut_results


class PowerLost(Fault):
    """SIGKILL of all; results and catalogue lose what was not synced, the broker all."""

    def hindrance(self, installation: Installation) -> str | None:
        """Return why, unless all is in files of its own."""
        if installation.servers == ("", ""):
            return None
        return "what servers have synced is not known here"

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Kill, cut, and start the service again."""
        installation.kill()
        cut_results(installation.folder)
        cut_catalogue(installation.folder)
        with contextlib.suppress(FileNotFoundError):
            shutil.rmtree(installation.data / "broker")
        yield
        installation.start()
