"""Tests that take long are left out by a draw, which is the same everywhere."""

import json
from pathlib import Path

import pytest

from tests import expensive

TIMES = {f"tests/a/b/test_{i}.py::test": {"processor": 3.0 + i} for i in range(40)} | {
    "tests/a/test_a.py::test_cheap": {"processor": 0.9 * expensive.LEAST},
    "tests/b/test_b.py::test_alone": {"processor": 60.0},
    f"{expensive.ALWAYS[0]}::test": {"processor": 60.0},
}


MANY = {name: spent for name, spent in TIMES.items() if name.startswith("tests/a/b/")}
SECONDS = sum(spent["processor"] for spent in MANY.values())


@pytest.mark.parametrize("seed", range(10))
def test_a_share_of_the_seconds_of_a_folder_is_spent(seed: int) -> None:
    left_out = expensive.draw(TIMES, seed)["left_out"]
    assert left_out.items() < {name: spent["processor"] for name, spent in MANY.items()}.items()
    assert 0.0 < SECONDS - sum(left_out.values()) <= expensive.SHARE * SECONDS


def test_where_none_fits_the_shortest_is_run() -> None:
    times = {f"tests/a/test_{i}.py::test": {"processor": 4.0 + i} for i in range(3)}
    assert sorted(expensive.draw(times, 1)["left_out"].values()) == [5.0, 6.0]


def test_another_seed_leaves_out_others() -> None:
    draws = [sorted(expensive.draw(TIMES, seed)["left_out"]) for seed in (1, 1, 2, 3)]
    assert draws[0] == draws[1]
    assert len(set(map(tuple, draws))) > 1


def test_what_the_table_names_is_a_long_test(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    table = tmp_path / "expensive.json"
    monkeypatch.setattr(expensive, "TABLE", table)
    expensive.mark([request.node])  # without a table nothing is
    assert request.node.get_closest_marker("long") is None
    table.write_text(json.dumps({"seed": 1, "left_out": {request.node.nodeid: 9.0}}))
    expensive.mark([request.node])
    assert request.node.get_closest_marker("long") is not None
