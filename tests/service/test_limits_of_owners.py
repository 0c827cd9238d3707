"""Limits of one owner: requests in a time, jobs at a time, bytes of results, processor time."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob, Solver
from jointplay.storage.settings import Settings
from jointplay.worker.measuring import measure_results
from jointplay.worker.removal import remove_expired
from tests.service.guarded import SWING, Guarded
from tests.service_in_thread import serving


def test_whoever_asks_too_often_is_told_when_to_come_back(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required", rate=0.5)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("ada") as ada, guarded.as_("bob") as bob:
            answers = [ada.get("/v1/jobs") for _ in range(12)]  # two windows at most
            refused = [answer for answer in answers if answer.status_code == 429]
            assert len(refused) >= 2
            assert 1 <= int(refused[0].headers["Retry-After"]) <= 10
            assert "more than 5 requests in 10 s" in refused[0].json()["detail"]
            assert bob.get("/v1/jobs").status_code == 200
    catalogue.close()


def test_workers_hold_blocks_at_any_rate(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required", rate=0.5)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    job = catalogue.submit(NewJob("simulate", {}, "d" * 64, "1")).job.id
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("lab", "worker") as lab, guarded.as_("ada") as ada:
            worker = f"{lab.headers['authorization'].split('_')[1]}@w"  # of this key
            assert catalogue.claim_block(f"{job}-0", worker, 600.0, Solver("1", "zen4"))
            beat = f"/v1/worker/blocks/{job}-0/1/heartbeat"
            assert {lab.post(beat).status_code for _ in range(12)} == {200}
            # whose key is for something else is counted there, too
            assert {ada.post(beat).status_code for _ in range(12)} == {403, 429}
    catalogue.close()


def test_an_owner_has_so_many_jobs_at_a_time(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required", most_live=3)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("ada") as ada, guarded.as_("root", "admin") as root:
            batch = {"jobs": [SWING, SWING]}
            assert ada.post("/v1/batches", json=batch).status_code == 202
            refused = ada.post("/v1/batches", json=batch)
            assert refused.status_code == 403
            assert refused.json()["type"] == "/problems/quota-exceeded"
            assert "has 2 jobs that have not ended, and may have 3" in refused.json()["detail"]
            again = {"Idempotency-Key": "again"}
            last, same = (
                ada.post("/v1/jobs", json=SWING | {"cache": False}, headers=again) for _ in "ab"
            )
            assert (last.status_code, same.status_code) == (202, 202)
            assert same.json()["id"] == last.json()["id"]
            assert ada.post("/v1/jobs", json=SWING | {"cache": False}).status_code == 403
            assert root.post("/v1/batches", json=batch).status_code == 202
            ada.post(f"/v1/jobs/{last.json()['id']}/cancel")
            assert ada.post("/v1/jobs", json=SWING | {"cache": False}).status_code == 202
    catalogue.close()


def test_twenty_jobs_at_once_do_not_exceed_the_limit(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required", most_live=3)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with (
        serving(create_app(settings)) as url,
        Guarded(url, catalogue, "", "").as_("ada") as http,
    ):

        def sent(number: int) -> int:
            return http.post("/v1/jobs", json=SWING | {"duration": 1.0 + number}).status_code

        with ThreadPoolExecutor(20) as threads:
            answers = list(threads.map(sent, range(20)))
        assert sorted(answers) == [202] * 3 + [403] * (20 - 3)
        # what is there already is found at the limit, and an estimate says so
        there = SWING | {"duration": 1.0 + answers.index(202)}
        assert http.post("/v1/jobs", json=there).status_code == 200
        assert http.post("/v1/estimates", json=there).json()["cached"]
    catalogue.close()


def test_an_owner_has_so_many_bytes_of_results(tmp_path: Path) -> None:
    most = {"most_running": 1, "most_stored": 1000, "most_computed": 50.0}
    settings = Settings(data=tmp_path, keys="required", **most)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("ada") as ada, guarded.as_("root", "admin") as root:
            job = ada.post("/v1/jobs", json=SWING).json()["id"]
            limits = {"most_live_jobs": 0, "most_stored_bytes": 1000, "most_core_seconds": 50.0}
            limits["most_running_blocks"] = 1
            nothing = {"running_blocks": 0, "stored_bytes": 0, "core_seconds": 0.0}
            used = {"owner": "ada", "live_jobs": 1} | nothing | limits
            assert ada.get("/v1/usage").json() == used
            ada.post(f"/v1/jobs/{job}/cancel")
            settings.sealed_run(job, 1).put([bytes(700), bytes(300)])
            measure_results(catalogue, settings)
            assert ada.get("/v1/usage").json() == used | {"live_jobs": 0, "stored_bytes": 1000}
            refused = ada.post("/v1/jobs", json=SWING)
            assert refused.status_code == 403
            assert refused.json()["type"] == "/problems/quota-exceeded"
            assert "has 1000 bytes of results, and may have 1000" in refused.json()["detail"]
            assert root.post("/v1/jobs", json=SWING).status_code == 202
            assert root.get("/v1/usage").json()["most_stored_bytes"] == 0
            ada.delete(f"/v1/jobs/{job}")
            remove_expired(catalogue, settings)
            assert ada.post("/v1/jobs", json=SWING).status_code == 202
    catalogue.close()
