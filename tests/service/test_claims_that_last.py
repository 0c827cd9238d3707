"""Claims of workers that joined are on the disk before they are answered."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from jointplay.storage.catalogue.connections import Connections
from jointplay.worker.own_solver import own_solver
from tests.joined_by_hand import SWEEP, SWING, installation, sealed


def test_a_power_cut_forgets_no_claim_of_a_worker_that_it_does_not_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    changed: list[bool] = []
    writing = Connections.writing

    @contextmanager
    def noted(connections: Connections, *, durable: bool = False) -> Iterator[Any]:
        with writing(connections, durable=durable) as connection:
            before = connection.exec_driver_sql("SELECT count(*) FROM attempt").scalar_one()
            yield connection
            after = connection.exec_driver_sql("SELECT count(*) FROM attempt").scalar_one()
            changed.extend([durable] * (after - before))

    with installation("folder", tmp_path / "data") as service:
        service.submit(SWEEP)
        monkeypatch.setattr(Connections, "writing", noted)
        held = service.claim()
        solver = own_solver()
        asked = {"version": solver.version, "processor": solver.processor, "most": 5}
        answer = service.http.post(f"{held.path}/beside", json=asked)
        assert len(answer.json()["claims"]) == 1
    assert changed == [True, True]


def test_a_run_whose_claim_was_undone_after_it_was_sealed_is_not_computed_again(
    tmp_path: Path,
) -> None:
    """After an older catalogue was put back it was computed again, and refused for its bytes."""
    with installation("folder", tmp_path / "data") as service:
        job = service.submit(SWING)
        content = sealed(SWING)  # with the seconds that it took
        target = service.settings.sealed_run(job.id, 1)
        target.put([content])
        service.work()
        assert service.outcomes(job) == ["done"]
        service.require_right(job)
        assert target.read(0, target.size()) == content
