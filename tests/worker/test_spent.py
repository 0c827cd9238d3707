"""Seconds that a worker has spent are told to the catalogue, once."""

from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest

from jointplay.solver.kernels.cache import SPENT
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.counters import COMPILING, PUBLISHED, PUBLISHING
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.settings import Settings
from jointplay.worker.execute import execute
from jointplay.worker.spent import SpentReport

JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.1}


@pytest.fixture
def catalogue(tmp_path: Path) -> Iterator[Catalogue]:
    catalogue = Catalogue(f"sqlite:///{tmp_path / 'catalogue.sqlite'}")
    catalogue.migrate()
    yield catalogue
    catalogue.close()


class Away(Catalogue):
    """A catalogue that does not answer."""

    def note_spent(self, *_: object) -> None:
        raise Unavailable("the catalogue does not answer")


def test_what_was_spent_is_told_once(tmp_path: Path, catalogue: Catalogue) -> None:
    before = SPENT.seconds + SPENT.elsewhere
    spent_report = SpentReport()
    spent_report.send(catalogue, "worker")
    assert catalogue.census().totals == {}
    settings = Settings(data=tmp_path)
    admission = cast("Admission", admit(JOB))
    target = settings.sealed_run("01M7YBSH1WSYHM7G141H5BWD2R", 1)
    execute(admission, tmp_path / "a1", target, report=lambda _: "continue")
    away = Away(f"sqlite:///{tmp_path / 'catalogue.sqlite'}")
    with pytest.raises(Unavailable):
        spent_report.send(away, "worker")
    away.close()
    spent_report.send(catalogue, "worker")
    told = catalogue.census().totals
    assert told[PUBLISHED] == 1
    assert told[PUBLISHING] > 0
    assert told.get(COMPILING, 0.0) == SPENT.seconds + SPENT.elsewhere - before
    spent_report.send(catalogue, "worker")
    assert catalogue.census().totals == told
