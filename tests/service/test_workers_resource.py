"""``/v1/workers``: who is alive, what each has, and that others' jobs are not told."""

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob, Solver, WorkerDevice
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving

SOLVER = Solver("1", "zen4")
DEVICE = WorkerDevice("a card", 5e8, 33792)


@pytest.fixture
def guarded(tmp_path):
    """Address of a service that asks for keys, and its catalogue."""
    settings = Settings(data=tmp_path / "data", keys="required")
    with serving(create_app(settings)) as url:
        catalogue = Catalogue(settings.catalogue_url)
        catalogue.migrate()
        yield url, catalogue
        catalogue.close()


def workers_seen_by(guarded, owner):
    url, catalogue = guarded
    key, _ = catalogue.make_key(owner, ("jobs:read",), "", None)
    headers = {"Authorization": f"Bearer {key}"}
    answer = httpx.get(f"{url}/v1/workers", headers=headers, trust_env=False)
    return answer.raise_for_status().json()["workers"]


def test_a_worker_is_listed_with_what_it_has_and_an_owner_is_told_of_his_own_jobs(guarded):
    _, catalogue = guarded
    assert workers_seen_by(guarded, "ada") == []
    new = NewJob("simulate", {}, "d" * 64, "1", owner="ada")
    job = catalogue.submit(new).job.id
    catalogue.note_worker("idle", SOLVER)
    catalogue.note_worker("busy", SOLVER)
    assert catalogue.claim_block(f"{job}-0", "busy", 60.0, SOLVER)
    busy, idle = workers_seen_by(guarded, "ada")
    assert (busy["name"], busy["version"], busy["processor"]) == ("busy", "1", "zen4")
    (block,) = busy["blocks"]
    assert (block["job"], block["block"], block["attempt"]) == (job, 0, 1)
    assert idle["blocks"] == []
    assert idle["since"] == idle["seen"]
    catalogue.note_worker("idle", SOLVER)  # again: it is there since the first time
    _, again = workers_seen_by(guarded, "ada")
    assert again["since"] == idle["since"] < again["seen"]
    (hidden,) = workers_seen_by(guarded, "bob")[0]["blocks"]
    assert hidden["job"] is None


def test_a_device_is_told_with_its_rate_until_it_is_lost(guarded):
    _, catalogue = guarded
    catalogue.note_worker("one", SOLVER, DEVICE)
    (one,) = workers_seen_by(guarded, "ada")
    assert (one["device"], one["rate"], one["lanes"]) == ("a card", 5e8, 33792)
    catalogue.note_worker("one", SOLVER)
    (one,) = workers_seen_by(guarded, "ada")
    assert (one["device"], one["rate"], one["lanes"]) == (None, None, None)


def test_a_worker_that_has_ended_is_alive_no_more(guarded):
    _, catalogue = guarded
    catalogue.note_worker("gone", SOLVER)
    assert [one["name"] for one in workers_seen_by(guarded, "ada")] == ["gone"]
    catalogue.forget_workers(["gone"])
    assert workers_seen_by(guarded, "ada") == []
