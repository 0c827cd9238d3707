"""Every file of a store of every kind, damaged: nothing is served that is not what was stored.

Each answer is what it was before, or a problem document that names the file; the job is marked then
and computed anew when its document is submitted again.
"""

import random
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
import zarr

from jointplay.records.impact import IMPACT
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.packed import Packed
from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from jointplay.storage.results.layout import Partition, ResultLayout
from jointplay.storage.results.writer import ResultWriter
from jointplay.storage.settings import Settings
from tests.service_in_thread import ACCURACY_STUDY, BIFURCATION, SWEEP, Worker

# aiohttp leaves its connections to the garbage collector
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")

OTHER = {"scene": {"preset": "seven-bar-press", "parameters": {"clearance": 3e-4}}}
"""Makes a job of the same shape and another document."""
POINCARE = {"kind": "poincare", "record": 40}
SMALL = Partition(chunk_rows=64, shard_chunks=4, buffer_bytes=2**24)  # 256 samples a file
CSV = {"Accept": "text/csv"}
Answer = tuple[int, bytes]
Request = tuple[str, tuple[tuple[str, str], ...]]
"""Address and headers."""


@dataclass
class Subject:
    """A job, the files of its results, and those of another job to exchange them with."""

    job: str
    files: dict[Path, Path]
    requests: list[Request] = field(default_factory=list)


def sealed(settings: Settings, job: str, *, study: bool) -> Path:
    found = settings.sealed_study(job) if study else settings.sealed_run(job, 1)
    return settings.data / "results" / found.key


def growing_run(worker: Worker, catalogue: Catalogue, settings: Settings, **fields: Any) -> str:
    """A run with three full files of rows, and some that wait for the fourth."""
    claim = worker.start(worker.submit(duration=2.0, **fields))
    admission = admit(claim.job.spec)
    assert isinstance(admission, Admission)
    attributes = {"job": admission.job, "digest": admission.digest, "section_note": ""}
    layout = ResultLayout(
        admission.channels,
        admission.samples,
        admission.sections,
        admission.joints,
        attributes,
        SMALL,
    )
    writer = ResultWriter.create(settings.running_run(claim.job.id, 1).folder, layout)
    columns = np.arange(len(layout.channels))
    time = np.linspace(0.0, 2.0, admission.samples)[:800]
    impacts = np.array([(1, 0.5, np.nan, 0.01, 100.0, 0.2)], IMPACT)
    nothing = np.empty(0), np.empty((0, len(columns)))
    shift = float(len(fields))  # another job's rows are others
    writer.append(0, time, columns + shift + time[:, None], 0, *nothing, impacts)
    writer.checkpoint()
    name = "block0-a1"
    catalogue.record_checkpoint(claim.block.id, 1, watermark=800, checkpoint=name)
    return claim.job.id


def growing_study(worker: Worker, catalogue: Catalogue, settings: Settings, **fields: Any) -> str:
    """A bifurcation diagram with a block that is done, and one with some points."""
    job = worker.submit(**{**BIFURCATION, "record": 5000}, **fields)
    for index, points in ((0, None), (1, 3)):
        claim = worker.start(job, index)
        worker.compute(claim, points=points)
        block = claim.block
        catalogue.record_checkpoint(
            block.id, 1, watermark=points or block.count, checkpoint=f"{index:05d}-a1"
        )
    return job


def pairs(folder: Path, other: Path) -> dict[Path, Path]:
    """Every file of a folder, and the one of the same name in another."""
    found = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    return {path: other / path.relative_to(folder) for path in found}


@pytest.fixture(scope="module")
def subjects(
    worker: Worker, catalogue: Catalogue, settings: Settings, http: httpx.Client
) -> dict[str, Subject]:
    makers: dict[str, Callable[..., str]] = {
        "simulate": lambda **more: worker.finished(**more),
        "bifurcation": lambda **more: worker.finished_study(**BIFURCATION, failing=(3,), **more),
        "sweep": lambda **more: worker.finished_study(**SWEEP, **more),
        "poincare": lambda **more: worker.finished_study(**POINCARE, **more),
        "accuracy-study": lambda **more: worker.finished_study(**ACCURACY_STUDY, **more),
    }
    found = {}
    for kind, make in makers.items():
        one, other = make(), make(**OTHER)
        study = kind != "simulate"
        found[kind] = Subject(
            one, {sealed(settings, one, study=study): sealed(settings, other, study=study)}
        )
    run, other_run = (growing_run(worker, catalogue, settings, **more) for more in ({}, OTHER))
    folders = (settings.running_run(job, 1).folder for job in (run, other_run))
    found["running simulate"] = Subject(run, pairs(*folders))
    study, other_study = (
        growing_study(worker, catalogue, settings, **more) for more in ({}, OTHER)
    )
    folders = (settings.running_study(job).folder for job in (study, other_study))
    found["running bifurcation"] = Subject(study, pairs(*folders))
    for one in found.values():
        one.requests = [
            request for request in requests_to(http, one) if ask(http, request)[0] in (200, 206)
        ]
    return found


def requests_to(http: httpx.Client, subject: Subject) -> Iterator[Request]:
    """Yield requests for everything that a job has, and for some of the keys of its store."""
    base = f"/v1/jobs/{subject.job}"
    links = http.get(base).json()["links"]
    for name in ("statistics", "peaks", "impacts", "bifurcation", "sweep", "accuracy", "poincare"):
        if name in links:
            yield links[name], ()
    if "history" in links:
        yield f"{links['history']}?channels=slider7.*", ()
        yield f"{links['history']}?channels=slider7.*&start=0.1&stop=0.3", tuple(CSV.items())
        yield f"{links['history']}?channels=slider7.x&points=20", ()
    figures = http.get(links["figures"]).json()["figures"] if "figures" in links else []
    for one in figures[:1]:
        yield one["png"], ()
    root = http.get(f"{base}/zarr/zarr.json").json()
    yield f"{base}/zarr/zarr.json", ()
    arrays = root["consolidated_metadata"]["metadata"]
    chosen = random.Random(subject.job).sample(sorted(arrays), min(8, len(arrays)))
    for path in {*chosen, "time", "sections/time"} & arrays.keys():
        yield f"{base}/zarr/{path}/zarr.json", ()
        if arrays[path]["node_type"] == "array":
            for place in "03":
                key = f"{path}/c/" + "/".join([place, *["0"] * (len(arrays[path]["shape"]) - 1)])
                yield f"{base}/zarr/{key}", ()
                yield f"{base}/zarr/{key}", (("Range", "bytes=-20"),)


def ask(http: httpx.Client, request: Request) -> Answer:
    answer = http.get(request[0], headers=dict(request[1]))
    return answer.status_code, answer.content


def flips(path: Path, content: bytes, chance: random.Random) -> Iterator[tuple[str, int]]:
    """Yield places in a file: of each kind of its bytes one."""
    size = len(content)
    if not path.name.endswith(".zip"):
        yield "content", chance.randrange(size)
        return
    found = Packed(StoredObject(Folder(str(path.parent)), path.name), owner_of(path))
    key = chance.choice(list(found))
    entry = found.entry(key)
    yield "header", entry.offset - 1 - chance.randrange(30)
    if entry.size:
        yield "content", entry.offset + chance.randrange(entry.size)
    behind = max(one.offset + one.size for one in found.entries.values())
    yield "directory", chance.randrange(behind, size - 21)
    yield "comment", chance.randrange(size - 21, size)


def owner_of(path: Path) -> bytes:
    """The owner of a file of rows, as its store says it."""
    from jointplay.storage.packed import Running

    return Running(path.parent.parent).owner if path.parent.name == "rows" else b""


def damages(path: Path, other: Path, chance: random.Random) -> Iterator[tuple[str, bytes | None]]:
    """Yield names of damages, and what the file holds then; none: it is gone."""
    content = path.read_bytes()
    for what, at in flips(path, content, chance):
        flipped = bytearray(content)
        flipped[at] ^= 1 << chance.randrange(8)
        yield f"flip {what}", bytes(flipped)
    yield "truncate", content[: chance.randrange(len(content) // 2, len(content))]
    yield "empty", b""
    yield "remove", None
    yield "swap", other.read_bytes()


def put(path: Path, content: bytes | None) -> None:
    if content is None:
        path.unlink(missing_ok=True)
    else:
        path.write_bytes(content)


KINDS = (
    "simulate",
    "bifurcation",
    "sweep",
    "poincare",
    "accuracy-study",
    "running simulate",
    "running bifurcation",
)


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_served_that_was_not_stored(
    http: httpx.Client, catalogue: Catalogue, subjects: dict[str, Subject], kind: str
) -> None:
    """A seeded sample of what the next test does."""
    strike(http, catalogue, subjects[kind], kind, most=3)


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_served_that_was_not_stored_whatever_happens_to_any_file(
    http: httpx.Client, catalogue: Catalogue, subjects: dict[str, Subject], kind: str
) -> None:
    strike(http, catalogue, subjects[kind], kind, most=1000)


def strike(
    http: httpx.Client, catalogue: Catalogue, subject: Subject, kind: str, *, most: int
) -> None:
    """Damage files, one after the other, and ask for everything each time."""
    chance = random.Random(kind)
    running = kind.startswith("running")
    requests = chance.sample(subject.requests, min(4 * most, len(subject.requests)))
    before = {request: ask(http, request) for request in requests}
    assert len(before) > 5
    cases = [
        (path, name, content)
        for path, other in subject.files.items()
        for name, content in damages(path, other, chance)
    ]
    counts: Counter[tuple[str, str]] = Counter()
    for path, name, content in chance.sample(cases, min(most, len(cases))):
        whole = path.read_bytes()
        put(path, content)
        detected = 0
        for request, expected in before.items():
            found = ask(http, request)
            if found != expected:
                place = f"{name} of {path.name}: {request}: {found[0]} {found[1][:300]!r}"
                assert found[0] == (409 if running else 410), place
                assert b"damaged" in found[1], place
                detected += 1
        counts[name, "detected"] += detected
        counts[name, "no effect"] += len(before) - detected
        marked = http.get(f"/v1/jobs/{subject.job}").json()["damaged"]
        assert (marked is not None) == (detected > 0 and not running)
        if not running and name in ("flip directory", "truncate", "empty", "remove", "swap"):
            assert detected == len(before), name  # the whole store is in this file
        put(path, whole)
        catalogue.mark_damaged(subject.job, None)
    assert {request: ask(http, request) for request in before} == before
    lines = [f"{kind:20} {damage:16} {what:10} {n:5}" for (damage, what), n in counts.items()]
    print("\n" + "\n".join(sorted(lines)))  # noqa: T201 - the table, shown by -s


def test_a_damaged_job_is_computed_anew_when_it_is_submitted_again(
    http: httpx.Client, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="to be damaged", duration=1.0)
    document = http.get(f"/v1/jobs/{job}").json()["job"]
    assert http.post("/v1/jobs", json=document).json()["id"] == job
    path = sealed(settings, job, study=False)
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


def test_stock_zarr_raises_and_shows_no_fill_values(
    service_url: str, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="for zarr", duration=1.0)
    history = zarr.open_group(f"{service_url}/v1/jobs/{job}/zarr", mode="r")
    assert float(history["time"][-1]) == 1.0
    path = sealed(settings, job, study=False)
    found = Packed(StoredObject(Folder(str(path.parent)), path.name)).entry("time/c/0")
    content = bytearray(path.read_bytes())
    content[found.offset + 7] ^= 1
    path.write_bytes(content)
    with pytest.raises(Exception, match="410"):
        history["time"][:]
    path.unlink()
    with pytest.raises(Exception, match="410"):
        history["slider7.x"][:]
