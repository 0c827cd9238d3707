"""State of a worker when it forks: it has asked no bucket, else its children could not, and loaded
nothing of a device where none is named.
"""

import os
import subprocess
import sys
from pathlib import Path

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.installation import MARK
from jointplay.storage.object_stores import object_store_at
from tests.seaweedfs_server import BUCKET, running_store

STARTING = """
import os, sys
from celery.signals import worker_init
import jointplay.worker.tasks
worker_init.send(None)
devices = [name for name in sys.modules if name.startswith("jointplay.solver.kernels.device")]
print(len(os.listdir("/proc/self/task")), devices)
"""


def test_no_thread_is_left_of_a_look_at_a_bucket(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path}/catalogue.sqlite"
    catalogue = Catalogue(url)
    catalogue.migrate()
    catalogue.close()
    with running_store() as endpoint:
        results = f"s3://{BUCKET}/lab?endpoint={endpoint}"
        own = {
            "JOINTPLAY_DATA": str(tmp_path),
            "JOINTPLAY_CATALOGUE_URL": url,
            "JOINTPLAY_RESULTS_URL": results,
        }
        command = [sys.executable, "-P", "-c", STARTING]
        done = subprocess.run(command, env=os.environ | own, capture_output=True, text=True)
        assert done.stdout.strip() == "1 []", done.stderr
        assert object_store_at(results).read(MARK, 0, 64)  # it was looked at
