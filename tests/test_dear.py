"""Tests that take long are left out by a draw, which is the same everywhere."""

import json
from pathlib import Path

import pytest

from tests import dear

TIMES = {f"tests/a/b/test_{i}.py::test": {"processor": 3.0 + i} for i in range(8)} | {
    "tests/a/test_a.py::test_cheap": {"processor": 0.5},
    "tests/b/test_b.py::test_alone": {"processor": 60.0},
    f"{dear.ALWAYS[0]}::test": {"processor": 60.0},
}


def test_a_share_of_the_dear_tests_of_a_folder_is_run_and_at_least_one() -> None:
    left_out = dear.draw(TIMES, 1)["left_out"]
    assert len(left_out) == 8 - round(8 * dear.SHARE)
    assert all(name.startswith("tests/a/b/") for name in left_out)
    assert all(left_out[name] == TIMES[name]["processor"] for name in left_out)


def test_another_seed_leaves_out_others() -> None:
    draws = [sorted(dear.draw(TIMES, seed)["left_out"]) for seed in (1, 1, 2, 3)]
    assert draws[0] == draws[1]
    assert len(set(map(tuple, draws))) > 1


def test_what_the_table_names_is_a_long_test(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    table = tmp_path / "dear.json"
    monkeypatch.setattr(dear, "TABLE", table)
    dear.mark([request.node])  # without a table nothing is
    assert request.node.get_closest_marker("long") is None
    table.write_text(json.dumps({"seed": 1, "left_out": {request.node.nodeid: 9.0}}))
    dear.mark([request.node])
    assert request.node.get_closest_marker("long") is not None
