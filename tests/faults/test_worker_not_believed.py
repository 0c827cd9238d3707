"""Workers that joined and lie: nothing that they hand in becomes results that are not there."""

from collections.abc import Iterator
from typing import Any

import pytest

from jointplay.command_line.application import run as command
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NOT_REPRODUCED, BlockState
from jointplay.storage.packed import pack
from jointplay.storage.packed.ranges import InMemory
from jointplay.storage.packed.reading import Packed
from jointplay.storage.reconciliation import findings
from jointplay.storage.results.layout import MANIFEST
from jointplay.storage.results.manifest import listed
from tests.backends import BACKENDS
from tests.joined_by_hand import (
    NOT_HELD,
    REFUSED,
    SWEEP,
    SWING,
    Held,
    Installation,
    installation,
    said,
    sealed_run,
    study_files,
    without,
)


@pytest.fixture(scope="module", params=BACKENDS)
def service(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Installation]:
    with installation(request.param, tmp_path_factory.mktemp("lab") / "data") as found:
        yield found


def repacked(content: bytes, **changed: bytes) -> bytes:
    """Bytes of a store, sealed anew, with another content of some files."""
    files = Packed(InMemory("store", content))
    entries = [(key, changed.get(key, files.read(key))) for key in files if key != MANIFEST]
    return b"".join(pack(listed(entries)))


ATTACKS = (
    *("nothing", "empty", "garbage", "a half", "the end", "another job's", "half a run"),
    *("a chunk less", "a chunk that is none", "a byte flipped"),
)


def attacks() -> dict[str, bytes | None]:
    """Contents that a sealed run of two seconds must not have."""
    whole = sealed_run(2.0)
    chunk = next(key for key in Packed(InMemory("store", whole)) if key.endswith("/c/0"))
    return {
        "nothing": None,
        "empty": b"",
        "garbage": b"garbage" * 1000,
        "a half": whole[: len(whole) // 2],
        "the end": whole[len(whole) // 2 :],
        "another job's": sealed_run(1.0),
        "half a run": sealed_run(2.0, half=True),
        "a chunk less": without(whole, chunk),
        "a chunk that is none": repacked(whole, **{chunk: b"garbage" * 10}),
        "a byte flipped": whole[:200] + bytes([whole[200] ^ 1]) + whole[201:],
    }


@pytest.mark.parametrize("attack", ATTACKS)
def test_a_run_that_is_not_whole_is_computed_again(service: Installation, attack: str) -> None:
    job, content = service.submit(SWING), attacks()[attack]
    held = service.claim()
    assert held.job.id == job.id
    put = held.put("sealed/1", content) if content is not None else None
    finished = held.finish()
    answers = [said(one) for one in (put, finished) if one is not None and one.is_error]
    assert answers[0] == REFUSED
    assert service.outcomes(job) == ["refused"]
    assert service.catalogue.get(job.id).state == "running"
    assert not service.settings.sealed_run(job.id, 1).exists()
    refused = service.catalogue.events(job.id)[-1]
    assert (refused.type, refused.data["reason"] != "") == ("refused", True)
    service.work()
    assert service.outcomes(job) == ["refused", "done"]
    service.require_right(job)


def test_a_run_ends_as_what_is_stored_says(service: Installation) -> None:
    """Else its results would be answered with 410."""
    ends = [
        (sealed_run(2.0), {"steps": 12345678}),
        (sealed_run(2.0), {"outcome": "failed", "error": FAULT}),
    ]
    for content, told in ends:
        job = service.submit(SWING)
        held = service.claim()
        assert held.put("sealed/1", content).status_code == 204
        assert said(held.finish(**told)) == REFUSED
        service.work()
        service.require_right(job)


FAULT = {"error_class": "solver", "code": "odd", "detail": "It was odd.", "time": 1.0}


def test_results_that_are_right_are_taken_and_no_others_beside_them(service: Installation) -> None:
    job = service.submit(SWING)
    held, content = service.claim(), sealed_run(2.0)
    assert held.put("sealed/1", content).status_code == 204
    assert held.put("sealed/1", content).status_code == 204  # the first answer was lost
    assert held.finish().status_code == 200
    service.require_right(job)
    job = service.submit(SWING)
    held = service.claim()
    assert held.put("sealed/1", content).status_code == 204
    other = Packed(InMemory("store", content))
    chunks = [key for key in other if "/c/" in key and "time" not in key]
    swapped = {chunks[0]: other.read(chunks[1]), chunks[1]: other.read(chunks[0])}
    assert said(held.put("sealed/1", repacked(content, **swapped))) == REFUSED
    assert said(held.finish()) == NOT_HELD
    service.work()
    service.require_right(job)


def test_what_the_next_attempt_has_stored_by_then_stays(
    service: Installation, monkeypatch: pytest.MonkeyPatch
) -> None:
    refuse = Catalogue.refuse

    def refused(catalogue: Catalogue, *asked: Any) -> BlockState:
        """Have the block claimed again before what was refused is removed."""
        state = refuse(catalogue, *asked)
        assert service.claim().put("a2/rows/0", b"x").status_code == 204
        return state

    job = service.submit(SWING)
    held = service.claim()
    assert held.put("a1/rows/0", b"x").status_code == 204
    with monkeypatch.context() as patched:
        patched.setattr(Catalogue, "refuse", refused)
        assert said(held.finish()) == REFUSED
    assert [*service.settings.running_files(job.id).names()] == ["a2/rows/0"]
    service.http.post(f"/v1/worker/blocks/{held.block}/2/release")
    service.work()
    service.require_right(job)


def test_a_worker_whose_results_are_never_right_ends_the_job_not_for_ever(
    service: Installation,
) -> None:
    job = service.submit(SWING)
    for number in range(service.settings.max_attempts):
        held = service.claim(f"machine{number}")
        assert held.job.id == job.id
        assert said(held.finish()) == REFUSED
    ended = service.catalogue.get(job.id)
    assert (ended.state, ended.error and ended.error.code) == ("failed", "results-refused")


def blocks_of(service: Installation) -> list[Held]:
    """Claim both blocks of a new sweep, in their order."""
    service.submit(SWEEP)
    return sorted((service.claim() for _ in range(2)), key=lambda held: held.index)


def test_no_block_touches_what_is_another_s(service: Installation) -> None:
    first, second = blocks_of(service)
    files = study_files(12)
    for name in ("study/documents.zip", "study/parts/00001"):
        assert second.put(name, files[name]).status_code == 204
    names = ("sealed/study", "sealed/1", "study/parts/00001", "study/parts/00001-a1", "a1/x")
    for name in names:
        assert said(first.put(name, files.get(name, b"x"))) == NOT_HELD
    for name in ("study/parts/00001", "study/documents.zip"):
        assert said(first.delete(name)) == NOT_HELD
    assert second.finish().status_code == 200
    for name in ("study/parts/00000",):
        assert first.put(name, files[name]).status_code == 204
    assert first.finish().status_code == 200
    sealing = service.claim()
    for name in ("study/parts/00000", "study/documents.zip"):
        assert said(sealing.put(name, files[name])) == NOT_HELD
    assert sealing.put("sealed/study", files["sealed/study"]).status_code == 204
    assert sealing.finish().status_code == 200
    service.require_right(first.job, "sweep")


@pytest.mark.parametrize("attack", ["nothing", "garbage", "another block's", "another job's"])
def test_a_block_of_a_study_without_its_part_is_computed_again(
    service: Installation, attack: str
) -> None:
    first, second = blocks_of(service)
    files = study_files(12)
    content = {
        "garbage": b"garbage",
        "another block's": files["study/parts/00001"],
        "another job's": study_files(10)["study/parts/00000"],
    }
    assert first.put("study/documents.zip", files["study/documents.zip"]).status_code == 204
    if attack in content:
        assert first.put("study/parts/00000", content[attack]).status_code == 204
    assert said(first.finish()) == REFUSED
    assert second.put("study/parts/00001", files["study/parts/00001"]).status_code == 204
    assert second.finish().status_code == 200
    service.work()
    assert service.outcomes(first.job).count("refused") == 1
    service.require_right(first.job, "sweep")


@pytest.mark.parametrize("attack", ["nothing", "garbage", "another job's", "another's documents"])
def test_a_study_is_sealed_whole_or_again(service: Installation, attack: str) -> None:
    first, second = blocks_of(service)
    files, other = study_files(12), study_files(10)
    if attack == "another's documents":
        assert said(first.put("study/documents.zip", other["study/documents.zip"])) == REFUSED
        first = service.claim()
    assert first.put("study/documents.zip", files["study/documents.zip"]).status_code == 204
    for held in (first, second):
        name = f"study/parts/0000{held.index}"
        assert held.put(name, files[name]).status_code == 204
        assert held.finish().status_code == 200
    sealing = service.claim()
    content = {"garbage": b"garbage", "another job's": other["sealed/study"]}
    if attack in content:
        assert said(sealing.put("sealed/study", content[attack])) == REFUSED
    else:
        assert said(sealing.finish()) == REFUSED
    service.work()
    service.require_right(first.job, "sweep")


def test_of_two_seals_that_differ_none_is_a_success(service: Installation) -> None:
    first, second = blocks_of(service)
    files = study_files(12)
    assert first.put("study/documents.zip", files["study/documents.zip"]).status_code == 204
    for held in (first, second):
        name = f"study/parts/0000{held.index}"
        assert held.put(name, files[name]).status_code == 204
        assert held.finish().status_code == 200
    sealing = service.claim()
    sealed = files["sealed/study"]
    store = Packed(InMemory("store", sealed))
    chunks = [key for key in store if key.startswith("statistics/") and "/c/" in key]
    lie = repacked(sealed, **{chunks[0]: store.read(chunks[1])})
    assert sealing.put("sealed/study", lie).status_code == 204  # it may be true
    sealing.service.http.post(f"{sealing.path}/release")
    again = service.claim()
    assert said(again.put("sealed/study", sealed)) == REFUSED
    assert not service.settings.sealed_study(first.job.id).exists()
    service.work()
    target = service.settings.sealed_study(first.job.id)
    assert Packed(target).read(chunks[0]) == store.read(chunks[0])
    service.require_right(first.job, "sweep")


def test_a_job_whose_repetition_gives_other_results_can_be_sent_again(
    service: Installation,
) -> None:
    """Numbers that are wrong, in a store that is whole, only a repetition tells."""
    document = SWING | {"duration": 1.5}  # of no other job here
    job = service.submit(document)
    held, content = service.claim(), sealed_run(1.5)
    files = Packed(InMemory("store", content))
    chunk, other = [key for key in files if key.startswith("rod.") and "/c/" in key][:2]
    lie = repacked(content, **{chunk: files.read(other)})
    assert held.put("sealed/1", lie).status_code == 204
    assert held.finish().status_code == 200
    answer = service.http.post("/v1/jobs", json=document)
    assert (answer.status_code, answer.json()["id"]) == (200, job.id)
    assert command(["verify", job.id, "--processes", "1", "--url", service.url]) == 1
    (found,) = findings(service.settings, service.catalogue)  # which stays
    assert (found.found, found.mend) == (NOT_REPRODUCED, None)
    answer = service.http.post("/v1/jobs", json=document)
    assert answer.status_code == 202
    assert answer.json()["id"] != job.id
    service.work()
    service.require_right(service.catalogue.get(answer.json()["id"]))
    assert service.http.post("/v1/jobs", json=document).json()["id"] == answer.json()["id"]
