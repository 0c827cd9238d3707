"""A job whose results are damaged: what is answered, and how it is computed anew."""

import shutil
from typing import Any, cast

import httpx
import pytest
import zarr

from jointplay import figures
from jointplay.storage.installation import MARK
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader
from tests.worker_by_hand import BIFURCATION, Worker

# aiohttp leaves its connections to the garbage collector
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")


def test_a_damaged_job_is_computed_anew_when_it_is_submitted_again(
    http: httpx.Client, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="to be damaged", duration=1.0)
    document = http.get(f"/v1/jobs/{job}").json()["job"]
    assert http.post("/v1/jobs", json=document).json()["id"] == job
    path = settings.data / "results" / settings.sealed_run(job, 1).key
    content = bytearray(path.read_bytes())
    content[-3] ^= 1
    path.write_bytes(content)
    answer = http.get(f"/v1/jobs/{job}/history")
    assert (answer.status_code, answer.headers["Cache-Control"]) == (410, "no-store")
    problem = answer.json()
    assert problem["type"] == "/problems/damaged-results"
    assert path.name in problem["detail"]
    assert "to /v1/jobs" in problem["detail"]
    shown = http.get(f"/v1/jobs/{job}").json()
    assert shown["state"] == "succeeded"
    assert path.name in shown["damaged"]
    again = http.post("/v1/jobs", json=document)
    assert again.status_code == 202
    assert again.json()["id"] != job


def test_results_that_are_not_mounted_are_not_lost(
    http: httpx.Client, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="not mounted for a while", duration=1.0)
    away = settings.data / "away"
    away.mkdir()
    mounted = ("results", MARK)
    for name in mounted:
        (settings.data / name).rename(away / name)
    try:
        answer = http.get(f"/v1/jobs/{job}/history")
    finally:
        shutil.rmtree(settings.data / "results", ignore_errors=True)
        for name in mounted:
            (away / name).rename(settings.data / name)
        away.rmdir()
    assert (answer.status_code, answer.json()["type"]) == (503, "/problems/unavailable")
    assert http.get(f"/v1/jobs/{job}").json()["damaged"] is None
    assert http.get(f"/v1/jobs/{job}/history").status_code == 200


@pytest.mark.parametrize("file", ["", "sections/time/c/0/0"])
def test_a_damaged_diagram_beneath_a_figure_is_the_one_that_is_marked(
    http: httpx.Client,
    worker: Worker,
    settings: Settings,
    finished_job: str,
    monkeypatch: pytest.MonkeyPatch,
    file: str,
) -> None:
    """Results of the figure's own job are whole; the damage is found early, or in the drawing."""
    diagram = worker.finished_study(**BIFURCATION)
    path = settings.data / "results" / settings.sealed_study(diagram).key
    content = bytearray(path.read_bytes())
    packed = Packed(StoredObject(Folder(str(path.parent)), path.name))
    content[packed.entry(file).offset + 7 if file else -3] ^= 1
    path.write_bytes(content)

    def drawn(_store: Any, _name: str, _form: str, chosen: figures.Selection, *_: Any) -> bytes:
        return bytes(cast("StudyReader", chosen.over).section_times(0, 8))

    monkeypatch.setattr(figures, "render", drawn)
    address = f"/v1/jobs/{finished_job}/figures/outputs.svg"
    answer = http.get(address, params={"over": diagram})
    (told,) = answer.json()["errors"]
    assert (answer.status_code, told["parameter"]) == (410, "over")
    assert path.name in told["detail"]
    assert http.get(f"/v1/jobs/{finished_job}").json()["damaged"] is None
    assert path.name in http.get(f"/v1/jobs/{diagram}").json()["damaged"]


def test_stock_zarr_raises_and_shows_no_fill_values(
    service_url: str, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="for zarr", duration=1.0)
    history = zarr.open_group(f"{service_url}/v1/jobs/{job}/zarr", mode="r")
    assert float(history["time"][-1]) == 1.0
    path = settings.data / "results" / settings.sealed_run(job, 1).key
    found = Packed(StoredObject(Folder(str(path.parent)), path.name)).entry("time/c/0")
    content = bytearray(path.read_bytes())
    content[found.offset + 7] ^= 1
    path.write_bytes(content)
    with pytest.raises(Exception, match="410"):
        history["time"][:]
    path.unlink()
    with pytest.raises(Exception, match="410"):
        history["slider7.x"][:]
