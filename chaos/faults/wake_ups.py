"""Wake-ups that nobody sent, or that come twice, late, or for blocks that never were."""

import contextlib
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from kombu.exceptions import OperationalError
from redis.exceptions import RedisError

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import QUEUES
from jointplay.worker.app import RUN_BLOCK, make_app

_TIMES = 3


class WakeUps(Fault):
    """Messages for every block that there is, ended or not, several times, in any order."""

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Send them; they are gone when workers have looked at them."""
        catalogue = Catalogue(installation.settings.catalogue_url)
        with contextlib.suppress(Unavailable):
            jobs = catalogue.jobs(limit=1000).jobs
            blocks = [block.id for job in jobs for block in catalogue.blocks(job.id)]
        catalogue.close()
        messages = [*blocks, "no-such-block"] * _TIMES
        drawn.shuffle(messages)
        with (
            contextlib.suppress(OperationalError, RedisError, OSError),
            make_app(installation.broker_url) as app,
        ):
            for block in messages:
                app.send_task(RUN_BLOCK, args=[block], queue=drawn.choice(QUEUES))
        yield
