"""Metrics that Prometheus is shown, and whether the service says that it is ready."""

import asyncio
import os
import shutil
from contextlib import suppress
from pathlib import Path

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families

from jointplay.service import metrics, readiness
from jointplay.service.app import create_app
from jointplay.service.readiness import Readiness
from jointplay.service.vital import VitalThreads
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.counters import (
    COMPILING,
    ON_DEVICES,
    OUTCOMES,
    PUBLISHED,
    PUBLISHING,
)
from jointplay.storage.catalogue.records import (
    QUEUES,
    BlockEnd,
    BlockState,
    NewJob,
    Solver,
    WorkerDevice,
)
from jointplay.storage.installation import MARK
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving
from tests.waiting import until

NEW = NewJob("simulate", {}, "d" * 64, "1")
SOLVER = Solver("1", "zen4")


@pytest.fixture(autouse=True)
def forgetful(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(metrics, "_REMEMBERED", 0.0)


def shown(answer: httpx.Response) -> dict[str, float]:
    """Read it as Prometheus does; names are those of a number with its label."""
    assert answer.status_code == 200
    return {
        " ".join([sample.name, *sample.labels.values()]): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


def test_what_waits_and_what_runs_is_counted(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path)
    with (
        serving(create_app(settings)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        before = shown(http.get("/metrics"))
        assert before["jointplay_jobs queued"] == before["jointplay_blocks_running"] == 0
        for queue in QUEUES:
            assert before[f"jointplay_blocks_waiting {queue}"] == 0
            assert before[f"jointplay_longest_wait_seconds {queue}"] == 0
        assert {before[f"jointplay_attempts_total {outcome}"] for outcome in OUTCOMES} == {0}
        catalogue = Catalogue(settings.catalogue_url)
        jobs = [catalogue.submit(NEW).job.id for _ in range(5)]
        for job in jobs[:3]:
            assert catalogue.claim_block(f"{job}-0", "worker", 0.0 if job == jobs[0] else 60.0)
        catalogue.release(f"{jobs[2]}-0", 1)
        catalogue.mark_published((f"{jobs[3]}-0",), 20.0)
        found = shown(http.get("/metrics"))
        assert found["jointplay_jobs queued"] == 2
        assert found["jointplay_jobs running"] == 3
        assert found["jointplay_blocks_waiting interactive"] == 2
        assert found["jointplay_blocks_waiting recovered"] == 1
        assert found["jointplay_longest_wait_seconds interactive"] >= 0
        assert found["jointplay_blocks_running"] == 2
        assert found["jointplay_blocks_overdue"] == 1
        assert found["jointplay_wake_ups_on_the_way"] == 1
        assert abs(found["jointplay_clock_ahead_seconds"]) < 1
        assert found["process_resident_memory_bytes"] > 1e6
        assert catalogue.reap(3).requeued == (f"{jobs[0]}-0",)
        spent = {PUBLISHED: 2, PUBLISHING: 0.5, COMPILING: 3.0, ON_DEVICES: 64}
        catalogue.note_spent("worker", spent)
        for name, rate in (("first", 4e8), ("second", 5e8)):
            catalogue.note_worker(name, SOLVER, WorkerDevice("a card", rate, 33792))
        catalogue.note_worker("third", SOLVER)
        found = shown(http.get("/metrics"))
        assert found["jointplay_devices a card"] == 2
        assert found["jointplay_device_steps_per_second a card"] == 9e8
        assert catalogue.finish(f"{jobs[1]}-0", 1, BlockEnd(BlockState.done)).terminal
        for _ in range(2):
            found = shown(http.get("/metrics"))
            assert found["jointplay_attempts_total lost"] == 1
            assert found["jointplay_attempts_total released"] == 1
            assert found["jointplay_attempts_total done"] == 1
            assert found["jointplay_publish_seconds_count"] == 2
            assert found["jointplay_publish_seconds_sum"] == 0.5
            assert found["jointplay_compile_seconds_total"] == 3
            assert found["jointplay_device_points_total"] == 64
            assert found["jointplay_jobs_unserved"] == 0
            catalogue.forget_workers(["worker"])
        catalogue.close()


def test_numbers_need_a_key_for_them(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required")
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    keys = {scope: catalogue.make_key("ada", [scope], "", None)[0] for scope in ("metrics",)}
    keys["results:read"] = catalogue.make_key("ada", ["results:read"], "", None)[0]
    with serving(create_app(settings)) as url:
        answers = {
            scope: httpx.get(
                f"{url}/metrics",
                headers={"Authorization": key and f"Bearer {key}"},
                trust_env=False,
            ).status_code
            for scope, key in (keys | {"": ""}).items()
        }
    assert answers == {"metrics": 200, "results:read": 403, "": 401}
    catalogue.close()


def test_ready_is_who_can_write(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path / "data")
    with (
        serving(create_app(settings)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        assert http.get("/readyz").status_code == 200
        assert not list((tmp_path / "data" / "running").iterdir())
        shutil.rmtree(tmp_path / "data" / "running")
        (tmp_path / "data" / "running").write_text("a file where a folder has to be")
        until(lambda: not http.get("/readyz").is_success)
        answer = http.get("/readyz")
        assert (answer.status_code, answer.headers["Retry-After"]) == (503, "5")
        assert answer.json()["detail"] == "Results cannot be stored."
        (tmp_path / "data" / "running").unlink()
        until(lambda: http.get("/readyz").is_success)


def test_who_has_the_files_of_no_catalogue_is_not_ready(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where the disk with the data folder is not mounted."""
    monkeypatch.setattr(readiness, "_OBJECT_STORE_PERIOD", 0.0)
    mark, away = tmp_path / MARK, tmp_path / "away"
    with (
        serving(create_app(Settings(data=tmp_path))) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        assert http.get("/readyz").is_success
        mark.rename(away)
        until(lambda: http.get("/readyz").status_code == 503)
        away.rename(mark)
        until(lambda: http.get("/readyz").is_success)


def test_readiness_leaves_the_files_of_other_services_alone(tmp_path: Path) -> None:
    """In containers, services that share a data folder have one process id."""
    settings = Settings(data=tmp_path)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    (settings.data / "running").mkdir()
    others = settings.data / "running" / f".{os.getpid()}.trial"
    others.write_bytes(b"another")
    Readiness(catalogue, settings, VitalThreads()).prove()
    assert others.read_bytes() == b"another"
    assert [*others.parent.iterdir()] == [others]
    catalogue.close()


class Counted(Readiness):
    """Readiness that tells how often it was proved."""

    proofs = 0

    def prove(self) -> None:
        self.proofs += 1
        super().prove()


def test_many_who_ask_at_once_have_it_proved_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Anyone may ask, also without a key; nobody may have the catalogue written all the time."""
    monkeypatch.setattr(readiness, "_PERIOD", 3600.0)
    catalogue = Catalogue(Settings(data=tmp_path).catalogue_url)
    catalogue.migrate()
    ready = Counted(catalogue, Settings(data=tmp_path), VitalThreads())
    lacking = Counted(catalogue, Settings(data=tmp_path / "lacking"), VitalThreads())

    async def asked(one: Readiness) -> list[BaseException | None]:
        found = await asyncio.gather(*(one.proved() for _ in range(20)), return_exceptions=True)
        with suppress(FileNotFoundError):
            await one.proved()
        return found

    assert asyncio.run(asked(ready)) == [None] * 20
    assert {type(one) for one in asyncio.run(asked(lacking))} == {FileNotFoundError}
    assert (ready.proofs, lacking.proofs) == (1, 1)
    catalogue.close()
