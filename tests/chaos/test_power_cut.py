"""A power cut takes what was not synced, all of it, and nothing else."""

import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.chaos.installation import Installation
from jointplay.chaos.power_cut import cut_catalogue, cut_results
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import JobState

BEGINNING = """
import os, signal, sys
from pathlib import Path
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob
data = Path(sys.argv[1])
catalogue = Catalogue(f"sqlite:///{data}/catalogue.sqlite")
catalogue.migrate()
def submit():
    return catalogue.submit(NewJob("simulate", {"text": "x" * 5000}, "d" * 64, "1")).job.id
"""
END = """
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.fixture
def installation(tmp_path: Path) -> Installation:
    (tmp_path / "data").mkdir()
    return Installation(tmp_path, workers=1)


def killed(installation: Installation, script: str) -> None:
    """Run a script as a process of the installation that is killed at its end."""
    command = [sys.executable, "-c", BEGINNING + script + END, str(installation.data)]
    done = subprocess.run(command, env=installation.environment(), check=False)
    assert done.returncode == -9


def test_an_accepted_job_stays_and_a_claim_is_forgotten(installation: Installation) -> None:
    killed(installation, "job = submit(); catalogue.claim_block(f'{job}-0', 'worker', 60.0)")
    cut_catalogue(installation.folder)
    catalogue = Catalogue(installation.settings.catalogue_url)
    (job,) = catalogue.jobs().jobs
    assert (job.state, job.attempt) == (JobState.queued, 0)
    assert [event.type for event in catalogue.events(job.id)] == ["queued"]
    catalogue.close()


def test_a_claim_by_a_worker_elsewhere_stays(installation: Installation) -> None:
    """It goes on, and the next one must not have the number of its attempt."""
    claims = (
        "claim_next_elsewhere('worker', 60.0, solver)",
        "claim_block_elsewhere(f'{job}-0', 'w', 60)",
    )
    for number, claim in enumerate(claims, 1):
        solver = (
            "from jointplay.storage.catalogue.records import Solver; solver = Solver('1', 'any')"
        )
        killed(installation, f"{solver}; job = submit(); assert catalogue.{claim}")
        cut_catalogue(installation.folder)
        catalogue = Catalogue(installation.settings.catalogue_url)
        jobs = catalogue.jobs().jobs
        assert [job.attempt for job in jobs] == [1] * number
        catalogue.close()


def test_a_claim_stays_if_anything_was_promised_after_it(installation: Installation) -> None:
    claimed = "job = submit(); catalogue.claim_block(f'{job}-0', 'worker', 60.0); submit()"
    killed(installation, claimed)
    cut_catalogue(installation.folder)
    catalogue = Catalogue(installation.settings.catalogue_url)
    assert [job.attempt for job in catalogue.jobs().jobs] == [0, 1]  # the newest first
    catalogue.close()


def test_nothing_promised_is_lost_whenever_the_log_begins_anew(installation: Installation) -> None:
    """SQLite begins a new log after some thousand pages; each of these jobs takes several."""
    for _ in range(3):
        killed(
            installation,
            "for _ in range(150): catalogue.claim_block(f'{submit()}-0', 'worker', 60.0)",
        )
        cut_catalogue(installation.folder)
    catalogue = Catalogue(installation.settings.catalogue_url)
    assert len(catalogue.jobs(limit=1000).jobs) == 450
    with catalogue.connections.reading() as connection:
        assert connection.exec_driver_sql("PRAGMA integrity_check").scalar_one() == "ok"
    catalogue.close()


def test_files_are_cut_to_what_was_synced_of_them(installation: Installation) -> None:
    results = installation.data / "results"
    results.mkdir()
    killed(
        installation,
        """
with (data / "results" / "synced").open("wb") as file:
    file.write(b"durable")
    file.flush()
    os.fsync(file.fileno())
    file.write(b" not yet")
(data / "results" / "written").write_bytes(b"not at all")
""",
    )
    cut_results(installation.folder)
    contents = {path.name: path.read_bytes() for path in results.iterdir()}
    assert contents == {"synced": b"durable", "written": b""}


def test_taking_notes_leaves_sqlites_locks_alone(installation: Installation) -> None:
    """Closing a file ends all locks that a process has on it, whoever took them."""
    killed(
        installation,
        """
submit()
index = os.stat(data / "catalogue.sqlite-shm").st_ino
locks = [one.split() for one in Path("/proc/locks").read_text().splitlines()]
mine = [one[-2:] for one in locks if one[-4] == str(os.getpid()) and one[-3].endswith(f":{index}")]
assert ["128", "128"] in mine, "the byte that says that the index is in use"
""",
    )
