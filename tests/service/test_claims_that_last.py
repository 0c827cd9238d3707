"""Claims of workers that joined are on the disk before they are answered."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from jointplay.storage.catalogue.connections import Connections
from jointplay.worker.own_solver import own_solver
from tests.joined_by_hand import SWEEP, installation


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
