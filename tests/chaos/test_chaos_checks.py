"""A history in which something is wrong is found out, each wrong by its own sentence."""

import sqlite3
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import pytest

from jointplay.chaos.checks import wrongs
from jointplay.chaos.history import History, Submission
from jointplay.chaos.installation import Installation
from jointplay.chaos.undisturbed import undisturbed
from jointplay.solver.kinds import admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob
from jointplay.worker.execute import execute

JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.1}


@dataclass
class Left:
    """A campaign of one job, as it has left its folder."""

    installation: Installation
    history: History
    expected: dict[int, dict[str, bytes]]

    @property
    def job(self) -> str:
        job = self.history.submissions[0].job
        assert job is not None
        return job

    @property
    def sealed(self) -> Path:
        key = self.installation.settings.sealed_run(self.job, 1).key
        return self.installation.data / "results" / key

    def sql(self, statement: str) -> None:
        with closing(sqlite3.connect(self.installation.data / "catalogue.sqlite")) as database:
            database.execute(statement)
            database.commit()

    def wrong(self) -> list[str]:
        return wrongs(self.installation, self.history, self.expected)


@pytest.fixture
def left(tmp_path: Path) -> Left:
    installation = Installation(tmp_path, workers=1)
    settings = installation.settings
    admission = admit(dict(JOB))
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    job = catalogue.submit(new).job.id
    claim = catalogue.claim_block(f"{job}-0", "here", 60.0)
    assert claim is not None
    execute(admission, tmp_path / "store", settings.sealed_run(job, 1), report=lambda _: "continue")
    catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.done))
    catalogue.close()
    submission = Submission("key", 0, job=job, state="succeeded")
    return Left(
        installation, History([submission]), {0: undisturbed(JOB, tmp_path / "undisturbed")}
    )


def test_nothing_is_wrong_where_nothing_happened(left: Left) -> None:
    assert left.wrong() == []


def flip_a_byte(left: Left) -> None:
    content = bytearray(left.sealed.read_bytes())
    content[len(content) // 2] ^= 1
    left.sealed.write_bytes(content)


def remove_the_results(left: Left) -> None:
    left.sealed.unlink()


def change_an_array(left: Left) -> None:
    key = next(key for key in left.expected[0] if "/c/" in key)
    left.expected[0][key] = left.expected[0][key][:-1] + b"!"


def write_after_being_fenced(left: Left) -> None:
    left.sealed.with_name(f"{left.job}-a2.zarr.zip").write_bytes(b"late")


def leave_a_partial_file(left: Left) -> None:
    left.sealed.with_name(f"{left.sealed.name}.0123.partial").write_bytes(b"")


def leave_a_restart_point(left: Left) -> None:
    folder = left.installation.settings.running_folder(left.job)
    folder.mkdir(parents=True)
    (folder / "block0-a1").write_bytes(b"")


def leave_a_file(left: Left) -> None:
    (left.installation.data / "ballast").write_bytes(b"")


def end_twice(left: Left) -> None:
    left.sql("INSERT INTO event SELECT job, seq + 1, time, type, data FROM event WHERE seq = 4")


def lose_an_event(left: Left) -> None:
    left.sql("DELETE FROM event WHERE seq = 2")


def go_on_after_the_end(left: Left) -> None:
    left.sql("INSERT INTO event SELECT job, 5, time, 'lost', data FROM event WHERE seq = 4")


def finish_once_more(left: Left) -> None:
    left.sql(
        "INSERT INTO attempt (block, number, worker, started, ended, outcome)"
        " SELECT block, 2, worker, started, ended, outcome FROM attempt"
    )


def keep_an_attempt_open(left: Left) -> None:
    left.sql("UPDATE attempt SET outcome = NULL")


def lose_the_job(left: Left) -> None:
    left.history.submissions[0].job = "01ARZ3NDEKTSV4RRFFQ69G5FAV"


def fail(left: Left) -> None:
    left.sql("UPDATE job SET state = 'failed'")


def answer_otherwise(left: Left) -> None:
    left.history.submissions[0].state = "running"


def never_answer(left: Left) -> None:
    left.history.submissions[0].job = None


@pytest.mark.parametrize(
    ("do", "sentence"),
    [
        (flip_a_byte, "cannot be read"),
        (remove_the_results, "cannot be read"),
        (change_an_array, "has other bytes than undisturbed"),
        (write_after_being_fenced, "-a2.zarr.zip is left over"),
        (leave_a_partial_file, ".partial is left over"),
        (leave_a_restart_point, " is left over"),
        (leave_a_file, "ballast is left in the data folder"),
        (end_twice, "ended as ['succeeded', 'succeeded']"),
        (lose_an_event, "has events that are missing or doubled"),
        (go_on_after_the_end, "its last event is lost"),
        (finish_once_more, "was finished by attempts [1, 2]"),
        (keep_an_attempt_open, "has an attempt without an end"),
        (lose_the_job, "was accepted and is lost"),
        (fail, "ended as failed"),
        (answer_otherwise, "is succeeded, and running was answered"),
        (never_answer, "was never accepted"),
    ],
)
def test_a_wrong_is_found(left: Left, do: Callable[[Left], None], sentence: str) -> None:
    do(left)
    assert sentence in "\n".join(left.wrong())


def test_a_key_leads_to_one_job_and_an_end_is_an_end() -> None:
    history = History([Submission("key", 0)])
    submission = history.submissions[0]
    history.accepted(submission, "first")
    history.accepted(submission, "first")
    history.seen(submission, {"state": "succeeded", "progress": {"fraction": 1.0}})
    assert history.violations == []
    assert history.open == []
    history.seen(submission, {"state": "running", "progress": {"fraction": 0.5}})
    history.accepted(submission, "second")
    assert history.violations == [
        "job first was succeeded, then running",
        "the key key made job first and then job second",
    ]
