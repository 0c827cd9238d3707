"""Files that the service takes from a worker that joined: of the block that it holds, and whole."""

from base64 import b64encode
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.service.workers import file_body, handed_in
from jointplay.storage.attempt_files import LEAST, AttemptFiles
from jointplay.storage.catalogue import solvers
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Claim
from jointplay.storage.results.examination import LARGEST_DOCUMENT
from jointplay.storage.settings import Settings
from jointplay.worker.handed_in.expected import expected_of
from jointplay.worker.handed_in.names import largest
from jointplay.worker.own_solver import own_solver
from tests.service.guarded import SWING, Guarded
from tests.service_in_thread import serving
from tests.worker_by_hand import Worker


def digest(content: bytes) -> dict[str, str]:
    told = b64encode(sha256(content).digest()).decode()
    return {"Content-Digest": f"sha-256=:{told}:"}


@pytest.fixture
def claim(worker: Worker) -> Claim:
    return worker.start(worker.submit())


@pytest.fixture
def address(claim: Claim) -> str:
    return f"/v1/worker/blocks/{claim.block.id}/{claim.block.attempt}"


def test_files_are_kept_once_their_digest_is_right(
    http: httpx.Client, settings: Settings, claim: Claim, address: str
) -> None:
    path = settings.running_folder(claim.job.id) / "a1/parts/00000001"
    name = f"{address}/files/a1/parts/00000001"
    for headers in ({}, digest(b"other")):
        assert http.put(name, content=b"rows", headers=headers).status_code == 422
        assert not path.exists()
    assert http.put(name, content=b"rows", headers=digest(b"rows")).status_code == 204
    more = http.put(name, content=b" more", headers=digest(b" more"), params={"offset": 4})
    assert (more.status_code, path.read_bytes()) == (204, b"rows more")
    beyond = http.put(name, content=b"x", headers=digest(b"x"), params={"offset": 99})
    assert (beyond.status_code, path.read_bytes()) == (422, b"rows more")
    assert http.get(name).content == b"rows more"
    assert http.delete(name).status_code == 204
    assert http.get(name).status_code == 404
    assert [*path.parent.iterdir()] == []


@pytest.mark.parametrize("given", [{"fraction": 2.0}, {"fraction": "0"}, {"other": 1}, {}])
def test_what_a_worker_says_is_read_strictly(
    http: httpx.Client, address: str, given: dict[str, Any]
) -> None:
    told = {"time": 1.0, "fraction": 0.5} | given
    if not given:
        del told["time"]
    assert http.post(f"{address}/progress", json=told).status_code == 422
    for words in ("", "a\0b", "a\nb", 33 * "a"):
        for verb in ("activity", "put-off"):
            assert http.post(f"{address}/{verb}", json={"activity": words}).status_code == 422
    for event in ("succeeded", "retried"):  # which a job's history has for other things
        assert http.post(f"{address}/activity", json={"activity": event}).status_code == 422
    fault = {"error_class": "platform", "code": "odd", "detail": "a\0b", "time": None}
    ended = http.post(f"{address}/finish", json={"outcome": "failed", "error": fault})
    assert ended.status_code == 422
    assert "no NUL" in ended.text
    odd = {"watermark": 1, "checkpoint": "../block0-a1"}
    assert http.post(f"{address}/checkpoint", json=odd).status_code == 422
    assert http.post(f"{address}/finish", json={"outcome": "waiting"}).status_code == 422


@pytest.mark.parametrize(
    ("most", "told"),
    [(10**400, "inf"), (-(10**400), "-inf"), (65, "65")],
    ids=["too long", "too long and negative", "short"],
)
def test_a_number_out_of_its_bounds_is_refused_however_long(
    http: httpx.Client, address: str, most: int, told: str
) -> None:
    asked = {"version": "a", "processor": "b", "most": most}
    answer = http.post(f"{address}/beside", json=asked)
    assert answer.status_code == 422, answer.text
    (error,) = answer.json()["errors"]
    assert error["parameter"] == "most"
    assert told in error["detail"]


def test_an_attempt_that_lost_its_block_changes_nothing(
    http: httpx.Client, catalogue: Catalogue, settings: Settings, claim: Claim, address: str
) -> None:
    catalogue.release(claim.block.id, claim.block.attempt)
    name = f"{address}/files/block0-a1"
    answers = [
        http.put(name, content=b"late", headers=digest(b"late")),
        http.get(f"{address}/files"),
        http.post(f"{address}/heartbeat"),
        http.post(f"{address}/progress", json={"time": 1.0, "fraction": 0.5}),
        http.post(f"{address}/finish", json={"outcome": "done"}),
    ]
    assert {answer.status_code for answer in answers} == {409}
    assert {answer.json()["type"] for answer in answers} == {"/problems/not-held"}
    assert not settings.running_folder(claim.job.id).exists()


def test_a_file_for_which_there_is_no_room_is_refused(
    http: httpx.Client, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(file_body, "LARGEST_FILE", 3)
    name = f"{address}/files/block0-a1"
    assert http.put(name, content=b"rows", headers=digest(b"rows")).status_code == 422
    monkeypatch.setattr(Settings, "room", lambda _: 7)  # it is here twice for a moment
    monkeypatch.setattr(file_body, "LARGEST_FILE", 9)
    assert http.put(name, content=b"rows", headers=digest(b"rows")).status_code == 507


def test_a_file_with_two_lengths_is_refused(
    http: httpx.Client, settings: Settings, claim: Claim, address: str
) -> None:
    said = {"Content-Length": "4", "Transfer-Encoding": "chunked"}
    headers = digest(b"rows more") | said
    answer = http.put(f"{address}/files/block0-a1", content=iter([b"rows more"]), headers=headers)
    assert answer.status_code == 400
    assert "both a Content-Length and a Transfer-Encoding" in answer.json()["detail"]
    assert not (settings.running_folder(claim.job.id) / "block0-a1").exists()


def test_a_block_is_that_of_the_key_that_claimed_it(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required")
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    solver = own_solver()
    asked = {"version": solver.version, "processor": solver.processor, "worker": "w", "wait": 0}
    asked["program"] = version("jointplay")
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("lab", "worker") as first, guarded.as_("cloud", "worker") as second:
            with guarded.as_("ada", "jobs:write") as ada:
                assert ada.post("/v1/jobs", json=SWING).status_code == 202
            block = first.post("/v1/worker/claims", json=asked).json()["claim"]["block"]
            address = f"/v1/worker/blocks/{block['id']}/{block['attempt']}"
            assert second.post("/v1/worker/claims", json=asked).status_code == 204
            assert second.post(f"{address}/release").status_code == 409
            assert second.get(f"{address}/files").status_code == 409
            assert first.post(f"{address}/heartbeat").status_code == 200
    catalogue.close()


def test_names_of_workers_are_no_more_than_a_key_may_have(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each has a row in the catalogue, and may have a line in the metrics."""
    monkeypatch.setattr(solvers, "MOST_OF_KEY", 3)
    settings = Settings(data=tmp_path, keys="required")
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    catalogue.note_worker("own", own_solver())
    asked = {**vars(own_solver()), "program": version("jointplay"), "wait": 0}
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("lab", "worker") as first, guarded.as_("cloud", "worker") as second:

            def claim(client: httpx.Client, name: str) -> httpx.Response:
                return client.post("/v1/worker/claims", json=asked | {"worker": name})

            assert [claim(first, name).status_code for name in "abcabc"] == 6 * [204]
            refused = claim(first, "d")
            assert (refused.status_code, refused.headers["Retry-After"]) == (429, "60")
            assert "3 workers of this key" in refused.json()["detail"]
            assert claim(second, "d").status_code == 204
    assert len(catalogue.workers()) == 5
    catalogue.close()


def test_a_file_in_place_of_a_folder_is_refused_and_leaves_nothing(
    http: httpx.Client, settings: Settings, claim: Claim, address: str
) -> None:
    put = {"content": b"rows", "headers": digest(b"rows")}
    assert http.put(f"{address}/files/a1/parts/00000001", **put).status_code == 204
    for name in ("a1/parts", "a1/parts/00000001/more"):
        assert http.put(f"{address}/files/{name}", **put).status_code in (404, 422)
    found = [one.name for one in settings.running_folder(claim.job.id).rglob("*") if one.is_file()]
    assert found == ["00000001"]


def test_a_folder_is_no_file_that_can_be_read(http: httpx.Client, address: str) -> None:
    put = {"content": b"rows", "headers": digest(b"rows")}
    assert http.put(f"{address}/files/a1/parts/00000001", **put).status_code == 204
    assert http.get(f"{address}/files/a1/parts/00000001").content == b"rows"
    for name in ("a1/parts", "a1", "a1/parts/00000001/more"):
        assert http.get(f"{address}/files/{name}").status_code in (404, 422)


def test_empty_files_count_too(
    http: httpx.Client, claim: Claim, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    few = expected_of(claim.job)._replace(most=3 * LEAST)
    monkeypatch.setattr(handed_in, "expected_of", lambda _: few)
    put = {"content": b"", "headers": digest(b"")}
    answers = [http.put(f"{address}/files/a1/parts/{k}", **put).status_code for k in range(5)]
    assert answers == [204, 204, 204, 422, 409]  # the block is taken back


def test_documents_that_are_read_whole_are_small(claim: Claim) -> None:
    expected = expected_of(claim.job)._replace(most=2**35)
    assert largest("a1/documents.zip", expected) == LARGEST_DOCUMENT
    assert largest("a1/rows/history-0.zip", expected) == 2**35


UPWARDS = ("../x", "a1/../../x", "/etc/x", "a1/rows/../../../x", "sealed/../x")
OTHERS = (
    "a1//x",
    "",
    "a1/x.partial",
    "x\n",
    "sealed/2",
    "sealed/0",
    "sealed/",
    "a/b/c/d",
    ".hidden",
)


@pytest.mark.parametrize("name", UPWARDS + OTHERS)
def test_a_name_leads_nowhere_else(settings: Settings, claim: Claim, name: str) -> None:
    with pytest.raises(ValueError, match="is no"):
        AttemptFiles(settings, claim.block).put(name, [b"x"])
