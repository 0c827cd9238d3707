"""`python -m jointplay.worker`: a Celery worker as jointplay wants it."""

import argparse
import os

# One solver runs on one core; threads of libraries beside it only take turns with each other.
for variable in (
    "OMP_NUM_THREADS",
    "NUMBA_NUM_THREADS",
    "MKL_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
):
    os.environ[variable] = "1"


def main() -> None:
    """Run a worker, with a number of processes, until SIGTERM."""
    parser = argparse.ArgumentParser(prog="python -m jointplay.worker", description=__doc__)
    parser.add_argument("--processes", type=int, default=1, help="blocks computed at a time")
    arguments = parser.parse_args()

    import jointplay.worker.tasks  # noqa: F401 - registers the task; after the environment is set
    from jointplay.worker.app import QUEUES, app

    app.worker_main(
        [
            "worker",
            "--pool=prefork",
            f"--concurrency={arguments.processes}",
            f"--queues={','.join(QUEUES)}",
            "--without-gossip",
            "--without-mingle",
            "--without-heartbeat",
            "--loglevel=INFO",
        ]
    )


if __name__ == "__main__":
    main()
