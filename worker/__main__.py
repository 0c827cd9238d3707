"""`python -m jointplay.worker`: a Celery worker as jointplay wants it."""

import argparse
import gc
import os
import sys

# One solver runs on one core; threads of libraries beside it only take turns with each other.
for variable in (
    "OMP_NUM_THREADS",
    "MKL_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
):
    os.environ[variable] = "1"


def main() -> None:
    """Run a worker, with a number of processes, until SIGTERM."""
    parser = argparse.ArgumentParser(prog="python -m jointplay.worker", description=__doc__)
    parser.add_argument("--processes", type=int, default=1, help="blocks computed at a time")
    arguments = parser.parse_args()

    gc.disable()  # what is imported stays: looks through it are a tenth of the start
    import jointplay.worker.tasks  # noqa: F401 - registers the task; after the environment is set
    from jointplay.records.log_lines import begin
    from jointplay.storage.catalogue.records import QUEUES
    from jointplay.storage.settings import Settings
    from jointplay.worker.app import app

    gc.enable()
    gc.freeze()  # nor need the processes that compute look through it, or copy it
    begin(Settings().log_format)

    # without Celery's command line, whose libraries would be a tenth of the worker's start
    app.conf.worker_concurrency = arguments.processes  # known before the fork, too
    worker = app.Worker(
        pool_cls="prefork",
        queues=list(QUEUES),
        without_gossip=True,
        without_mingle=True,
        without_heartbeat=True,
        loglevel="INFO",
        quiet=True,  # no banner
    )
    worker.start()
    sys.exit(worker.exitcode)


if __name__ == "__main__":
    main()
