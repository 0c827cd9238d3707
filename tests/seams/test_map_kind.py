"""A kind of job over two axes, from outside, from its document to maps as users read them."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
import xarray

from jointplay.client import Refused
from jointplay.local import run
from jointplay.records.coarse_to_fine import coarse_to_fine, over_axes
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import KINDS, Study, admit, parse
from jointplay.storage.studies.store import seal
from jointplay.worker.execute import Answer, Progress
from jointplay.worker.layouts import layout_of_study
from jointplay.worker.probe import cost_of
from jointplay.worker.study_block import run_block
from tests.seams.conftest import Platform
from tests.seams.relief import Relief
from tests.stores import packed, target
from tests.waiting import until

ROOT = Path(__file__).parents[2]
CLEARANCES, FRICTIONS = {"from": 2e-4, "to": 5e-4, "count": 4}, [0.0, 0.05, 0.1]
SCENE = {"preset": "seven-bar-press", "parameters": {"speed": 100.0}}
ALIKE: dict[str, Any] = {
    "scene": SCENE,
    "periods": 1,
    "channels": ["A.normal_force"],
    "statistics": ["mean"],
    "tolerance": 1e-5,
}
RELIEF: dict[str, Any] = {
    "kind": "relief",
    "along": {"parameter": "clearance", "values": CLEARANCES},
    "by": {"parameter": "friction", "values": FRICTIONS},
    **ALIKE,
}
MANY = {"from": 1e-4, "to": 2e-4, "count": 10**6}
MEAN = "A.normal_force.mean"
ORDER = coarse_to_fine((3, 4))
"""Index of each point in the map, row by row."""


@pytest.fixture(autouse=True)
def relief() -> Iterator[None]:
    KINDS["relief"] = Relief()
    yield
    del KINDS["relief"]


@pytest.fixture(scope="module")
def heights() -> np.ndarray[Any, Any]:
    """(y, x) means of a sweep over the same values, whose points are no map."""
    grid = {"friction": FRICTIONS, "clearance": CLEARANCES}
    study = run({"kind": "sweep", "grid": grid, **ALIKE}, processes=1).study()
    return study.statistics[MEAN].reshape(3, 4)


def test_a_map_is_computed_block_by_block_and_read_while_it_grows(
    platform: Platform, http: httpx.Client, service_url: str, heights: np.ndarray[Any, Any]
) -> None:
    job = platform.client.submit(RELIEF | {"cache": False})
    blocks = admit(RELIEF).blocks  # type: ignore[union-attr]
    assert len(blocks) > 1
    address = f"{service_url}/v1/jobs/{job.id}/zarr"
    statistics = partial(xarray.open_zarr, address, group="statistics")
    # the last block of the catalogue's seals what the others computed
    for block, (first, count) in zip(platform.catalogue.blocks(job.id), blocks, strict=False):
        platform.compute(block.id)
        known = first + count
        there = over_axes(np.arange(12) < known, ORDER, (3, 4))
        shown = np.where(there, heights, np.nan)
        # a running study is shown as it was half a second ago at most
        until(lambda shown=shown: np.array_equal(statistics()[MEAN], shown, equal_nan=True))
        mean = statistics()[MEAN]
        assert mean.dims == ("y", "x")
        assert mean["x"].values == pytest.approx([2e-4, 3e-4, 4e-4, 5e-4])
        assert mean["y"].values.tolist() == FRICTIONS
        assert (mean["x"].attrs["parameter"], mean["x"].attrs["units"]) == ("clearance", "m")
        points = http.get(f"/v1/jobs/{job.id}/points").json()
        assert (points["shape"], points["complete"]) == ([3, 4], False)
        assert [(one["name"], one["parameter"]) for one in points["axes"]] == [
            ("y", "friction"),
            ("x", "clearance"),
        ]
        assert points["axes"][0]["values"] == FRICTIONS
        assert points["status"] == ["done"] * known + ["waiting"] * (12 - known)
        assert (
            points["statistics"][MEAN]["values"][:known] == heights.ravel()[ORDER[:known]].tolist()
        )
    assert platform.finished(job).state == "succeeded"
    assert http.get(f"/v1/jobs/{job.id}/points").json() == points | {"complete": True}
    peaks = xarray.open_zarr(address, group="peaks")["maximum"]
    assert (peaks.dims, peaks.shape) == (("y", "x", "channel"), (3, 4, 1))
    job_of_clients(job, heights)


def job_of_clients(job: Any, heights: np.ndarray[Any, Any]) -> None:
    """Look at a job as the client has it, of a service or here and now."""
    assert job.study().shape == (3, 4)
    assert job.points[MEAN].tolist() == heights.ravel()[ORDER].tolist()
    assert job.points["friction"].tolist() == np.repeat(FRICTIONS, 4)[ORDER].tolist()
    assert job.dataset[MEAN].transpose("friction", "clearance").values.tolist() == heights.tolist()
    assert len(job.peaks) == 12
    assert job.figures == ["sweep"]
    assert bytes(job.figure("sweep", channel="A.normal_force").content).startswith(b"\x89PNG")


def test_it_runs_here_and_now(heights: np.ndarray[Any, Any], tmp_path: Path) -> None:
    job = run(RELIEF, processes=1)
    job_of_clients(job, heights)
    rows = job.export(tmp_path / "points.csv", "points").read_text().splitlines()
    assert len([row for row in rows if not row.startswith("#")]) == 1 + 12


def test_it_is_estimated_and_planned_again_as_it_was_admitted() -> None:
    admitted = admit(RELIEF)
    assert isinstance(admitted, Study)
    planned = parse(json.loads(json.dumps(admitted.job)))
    assert isinstance(planned, Study)
    assert planned.shape == admitted.shape == (3, 4)
    assert planned.digest == admitted.digest
    cost = cost_of(admitted.job)
    assert (cost.points, cost.blocks, cost.failure) == (12, len(admitted.blocks), None)


def test_a_block_that_was_cut_short_goes_on_to_the_same_bits(tmp_path: Path) -> None:
    study = admit(RELIEF)
    assert isinstance(study, Study)
    layout = layout_of_study(study)

    def whole(name: str, *, cut: bool) -> bytes:
        kept: list[str] = []

        def report(progress: Progress) -> Answer:
            if not cut or progress.fraction < 0.3:
                return Answer.go_on
            kept.append(progress.keep()[0])
            return Answer.leave

        for index in reversed(range(len(study.blocks))):
            if run_block(study, index, tmp_path / name, report=report).state == "left":
                resume = (kept[-1], 0.3)
                run_block(study, index, tmp_path / name, attempt=2, resume_from=resume)
        assert bool(kept) == cut
        seal(tmp_path / name, layout, target(tmp_path / name))
        return packed(tmp_path / name).read_bytes()

    assert whole("cut", cut=True) == whole("uncut", cut=False)


@pytest.mark.parametrize(
    ("change", "pointer"),
    [
        ({"by": RELIEF["along"]}, "/by/parameter"),
        ({"along": {"parameter": "slack", "values": [1.0]}}, "/along/parameter"),
        ({"by": {"parameter": "friction", "values": [0.1, -1.0]}}, "/by/values/1"),
        ({"by": {"parameter": "friction"}}, "/by/values"),
    ],
)
def test_what_is_no_map_is_refused_at_its_field(
    platform: Platform, change: dict[str, Any], pointer: str
) -> None:
    with pytest.raises(Refused) as refusal:
        platform.client.submit(RELIEF | change)
    assert [problem.pointer for problem in refusal.value.fields] == [pointer]


def test_a_map_of_too_many_points_is_refused_at_its_field() -> None:
    """In this process: a service has another one check so many points, without this kind."""
    with pytest.raises(InvalidInput) as refusal:
        admit(RELIEF | {"along": {"parameter": "clearance", "values": MANY}})
    assert [problem.pointer for problem in refusal.value.problems] == ["/along/values"]


def test_the_command_line_and_the_client_are_made_of_its_document(
    heights: np.ndarray[Any, Any], tmp_path: Path
) -> None:
    def program(*words: str) -> str:
        ended = subprocess.run(
            [sys.executable, "-m", "tests.seams.relief", *words],
            cwd=ROOT,
            env=os.environ | {"COLUMNS": "200"},
            capture_output=True,
            text=True,
            check=False,
        )
        assert ended.returncode == 0, ended.stderr
        return ended.stdout

    shown = " ".join(program("run", "--help").replace("│", " ").split())
    assert "--relief NAME=FROM:TO:COUNT Peaks and statistics over two parameters" in shown
    assert "--by NAME=FROM:TO:COUNT Of a study: what varies along y" in shown
    out = tmp_path / "OUT"
    options = "--set speed=100 --relief clearance=2e-4:5e-4:4 --by friction=0,0.05,0.1 --periods 1"
    options += " --channels A.normal_force --statistics mean --tolerance 1e-5 --processes 1"
    program("run", "seven-bar-press", *options.split(), "-o", str(out))
    table = tmp_path / "points.csv"
    program("export", str(out), "--table", "points", "-o", str(table))
    header, *rows = [row for row in table.read_text().splitlines() if not row.startswith("#")]
    column = header.split(",").index(f"{MEAN} [N]")
    assert [float(row.split(",")[column]) for row in rows] == heights.ravel()[ORDER].tolist()
    made = subprocess.run(
        [sys.executable, "-c", CLIENT], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert json.loads(made.stdout) == {name: RELIEF[name] for name in ("kind", "along", "by")} | {
        "scene": {"preset": "seven-bar-press"},
        "periods": 1,
    }


CLIENT = """
import inspect, json
from jointplay import job_fields
from jointplay.solver.kinds import KINDS
from jointplay.solver.kinds.description import description
from tests.seams.relief import Relief
KINDS["relief"] = Relief()
job_fields.KINDS.update(description())
from jointplay import jobs
from jointplay.client import AsyncClient, Client
along = {"parameter": "clearance", "values": {"from": 2e-4, "to": 5e-4, "count": 4}}
by = {"parameter": "friction", "values": (0.0, 0.05, 0.1)}
assert list(inspect.signature(Client.relief).parameters)[1:4] == ["scene", "along", "by"]
assert inspect.iscoroutinefunction(AsyncClient.relief)
print(json.dumps(jobs.relief("seven-bar-press", along, by, periods=1)))
"""
