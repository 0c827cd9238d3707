"""Connections that are held for nothing, by the hundred and of every kind at once."""

from pathlib import Path

import pytest

from benchmarks.attack import KINDS, Attack, health, service, states, submit
from benchmarks.memory import anonymous

MOST = 100.0  # MB that the API takes beyond those of its start
SUBMITTED = 100


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_who_has_a_key_goes_on_under_attack(tmp_path: Path, kind: str) -> None:
    with service(kind, tmp_path) as attacked:
        assert states(attacked, submit(attacked, 0, 2)) == ["succeeded"] * 2
        before = anonymous(attacked.api)
        with Attack(attacked) as attack:
            jobs = submit(attacked, 100, SUBMITTED)
            assert [status for status, _ in health(attacked)] == [200] * 5
            assert states(attacked, jobs) == ["succeeded"] * SUBMITTED
            assert [status for status, _ in health(attacked)] == [200] * 5
        assert attack.again > 0
        assert attack.largest - before < MOST
