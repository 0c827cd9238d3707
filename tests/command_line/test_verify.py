"""`jointplay verify`: a repetition gives the same bits, and one changed value is found."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from jointplay.client import Client
from jointplay.solver.kinds import admit
from jointplay.storage.packed import Packed, files_at, pack
from jointplay.storage.results import manifest, shards
from jointplay.storage.results.layout import MANIFEST
from jointplay.worker.local.computing import compute
from tests.solver.calibration.calibrations import bounce

CRANK = {"scene": {"preset": "slider-crank"}}
JOBS: dict[str, dict[str, Any]] = {
    "press": {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.02},
    "fitted press": {
        "kind": "simulate",
        "scene": {"preset": "seven-bar-press-fitted"},
        "duration": 0.02,
    },
    "crank": {"kind": "simulate", **CRANK, "duration": 0.005},
    "journal": {"kind": "simulate", "scene": {"preset": "bouncing-journal"}, "duration": 0.3},
    "pendulum": {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.5},
    "bifurcation": {
        "kind": "bifurcation",
        **CRANK,
        "parameter": "clearance",
        "values": [2e-4, 4e-4],
        "settle": 1,
        "record": 3,
        "indicators": ["lyapunov"],
    },
    "sweep": {"kind": "sweep", **CRANK, "grid": {"clearance": [1e-4, 2e-4]}, "periods": 1},
    "poincare": {"kind": "poincare", **CRANK, "settle": 1, "record": 3},
    "ensemble": {"kind": "ensemble", **CRANK, "members": 2, "settle": 1, "record": 3},
    "accuracy-study": {
        "kind": "accuracy-study",
        **CRANK,
        "duration": 0.003,
        "methods": ["tsitouras"],
        "tolerances": [1e-4],
    },
    "calibration": bounce(search={"population": 4, "generations": 4}),
    "a run that fails": {
        "kind": "simulate",
        "scene": {
            "preset": "seven-bar-press",
            "parameters": {"static_velocity": 1e-12, "dynamic_velocity": 2e-12, "friction": 1.0},
        },
        "duration": 1.0,
        "tolerance": 1e-13,
    },
}


def computed(document: dict[str, Any], folder: Path) -> Path:
    folder.mkdir()
    compute(admit(document), folder, 1, lambda _fraction, _note: None)
    return folder


SAMPLED = ("journal", "pendulum", "bifurcation", "a run that fails")


@pytest.mark.parametrize(
    "name",
    [name if name in SAMPLED else pytest.param(name, marks=pytest.mark.long) for name in JOBS],
)
def test_a_repetition_of_any_job_gives_the_same_bits(jointplay, tmp_path: Path, name: str) -> None:
    folder = computed(JOBS[name], tmp_path / "OUT")
    before = (folder / "results.zarr.zip").read_bytes()
    ended = jointplay("verify", folder, "--processes", "1", "--json")
    assert ended.code == 0, ended.err
    found = json.loads(ended.out)
    assert found["equal"] is found["promised"] is True
    assert found["states"] == [("failed" if "fails" in name else "succeeded")] * 2
    assert len(found["arrays"]) > 5
    assert all(one["differing"] == 0 for one in found["arrays"])
    assert (folder / "results.zarr.zip").read_bytes() == before


def reseal(folder: Path, change: Callable[[dict[str, bytes]], None]) -> None:
    """Change files of a store and seal it again, with the right checksums."""
    path = folder / "results.zarr.zip"
    files = files_at(path)
    assert isinstance(files, Packed)
    found = {key: files.read(key) for key in files if key != MANIFEST}
    change(found)
    path.write_bytes(b"".join(pack(manifest.listed(found.items()))))


def moved_by(distance: float) -> Callable[[dict[str, bytes]], None]:
    """Move the angle of the pendulum at sample 7."""

    def change(files: dict[str, bytes]) -> None:
        key = "rod.theta/c/0"
        values = np.frombuffer(shards._codec.decode(files[key]), "<f8").copy()
        values[7] += distance
        files[key] = shards.compress(values)

    return change


def by_another_version(files: dict[str, bytes]) -> None:
    root = json.loads(files["zarr.json"])
    root["attributes"]["solver_version"] = "0.0.0+000000000000"
    files["zarr.json"] = json.dumps(root).encode()


@pytest.fixture
def swing(tmp_path: Path) -> Path:
    return computed(JOBS["pendulum"], tmp_path / "OUT")


def test_one_value_that_was_changed_and_sealed_is_found(jointplay, swing: Path) -> None:
    reseal(swing, moved_by(1e-15))
    assert jointplay("doctor", swing).code == 0  # its checksums are right
    ended = jointplay("verify", swing)
    assert ended.code == 1
    assert "the same version gave other bits" in ended.err
    first, heading, row, _ = ended.out.splitlines()
    assert first.startswith("50 of 51 arrays are equal bit for bit")
    assert heading.startswith("array")
    assert row.split()[:5] == ["rod.theta", "1", "of", "2001", "[7]"]
    found = json.loads(jointplay("verify", swing, "--json").out)
    (array,) = [one for one in found["arrays"] if one["differing"]]
    assert array["first"] == [7]
    assert array["largest"] == abs(array["stored"] - array["again"]) > 0.0


def test_results_of_another_version_need_not_be_equal_but_lie_within_the_bars(
    jointplay, swing: Path
) -> None:
    reseal(swing, by_another_version)
    ended = jointplay("verify", swing)
    assert ended.code == 0
    assert "equal bits are not promised" in ended.out
    reseal(swing, moved_by(1e-14))
    ended = jointplay("verify", swing)
    assert ended.code == 0
    assert "bars, where converged: within them" in ended.out
    reseal(swing, moved_by(0.1))
    ended = jointplay("verify", swing)
    assert ended.code == 1
    assert "beyond them: rod.theta" in ended.out
    assert "another version computed it" in ended.err


def test_an_array_that_is_gone_is_a_difference(jointplay, swing: Path) -> None:
    def remove(files: dict[str, bytes]) -> None:
        root = json.loads(files["zarr.json"])
        del root["consolidated_metadata"]["metadata"]["peaks/maximum"]
        root["attributes"]["summary"]["steps"] += 1
        files["zarr.json"] = json.dumps(root).encode()

    reseal(swing, remove)
    ended = jointplay("verify", swing)
    assert ended.code == 1
    assert "another shape, or missing" in ended.out
    assert "attributes that differ: summary" in ended.out


def test_damaged_results_are_not_compared(jointplay, swing: Path) -> None:
    path = swing / "results.zarr.zip"
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    ended = jointplay("verify", swing)
    assert ended.code == 1
    assert "damaged, there is nothing to compare" in ended.err


def test_a_job_that_was_cancelled_has_no_end_to_compare(jointplay, swing: Path) -> None:
    outcome = json.loads((swing / "outcome.json").read_text())
    (swing / "outcome.json").write_text(json.dumps(outcome | {"state": "cancelled"}))
    ended = jointplay("verify", swing)
    assert ended.code == 2
    assert "is cancelled; only what ended by itself ends alike" in ended.err


@pytest.mark.parametrize("name", ["crank", "bifurcation", "accuracy-study"])
def test_jobs_of_a_service_are_verified_over_http(jointplay, service, name: str) -> None:
    url, data = service
    with Client(url) as client:
        job = client.submit(JOBS[name]).wait()
        ended = jointplay("verify", job.id, "--processes", "1", "--url", url)
        assert ended.code == 0, ended
        assert "arrays are equal bit for bit" in ended.out
        (path,) = (data / "results").glob(f"*/{job.id}-*")
        content = bytearray(path.read_bytes())
        content[-3] ^= 1
        path.write_bytes(content)
        ended = jointplay("verify", job.id, "--processes", "1", "--url", url)
        assert ended.code == 1
        assert path.name in ended.err
        job.delete()


def test_a_job_that_has_not_ended_is_refused(jointplay, service) -> None:
    url, _ = service
    with Client(url) as client:
        job = client.simulate("seven-bar-press", duration=10_000)
        ended = jointplay("verify", job.id, "--url", url)
        assert ended.code == 2
        assert "is compared when it has ended" in ended.err
        job.cancel().wait(check=False)


@pytest.mark.long
def test_a_calibration_is_repeated_and_compared(jointplay, tmp_path: Path) -> None:
    found = tmp_path / "found.json"
    document = {
        "kind": "calibration",
        "scene": {"preset": "pendulum"},
        "parameters": {"angle": {"minimum": 0.1, "maximum": 1.0}},
        "cases": [{"targets": [{"channel": "rod.theta", "value": 0.5, "to": 0.2}]}],
        "search": {"population": 4, "generations": 2},
        "spread": {"generations": 4},
    }
    (tmp_path / "calibration.json").write_text(json.dumps(document))
    made = jointplay("calibrate", tmp_path / "calibration.json", "-o", found, "--processes", "1")
    assert made.code == 0, made.err
    outcome = json.loads(found.read_text())
    outcome["members"]["values"][0][0] += 1e-12
    found.write_text(json.dumps(outcome))
    ended = jointplay("verify", found, "--processes", "1", "--json")
    assert ended.code == 1
    (differing,) = [one for one in json.loads(ended.out)["arrays"] if one["differing"]]
    assert (differing["name"], differing["first"]) == ("members/values", [0, 0])


def test_a_file_that_is_no_calibration_is_refused(jointplay, tmp_path: Path) -> None:
    (tmp_path / "job.json").write_text(json.dumps(JOBS["pendulum"]))
    ended = jointplay("verify", tmp_path / "job.json")
    assert ended.code == 2
    assert "what `jointplay calibrate` left" in ended.line()
