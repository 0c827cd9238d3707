"""A service whose catalogue is in PostgreSQL and whose results are in a bucket."""

from pathlib import Path

import numpy as np
import pytest

from jointplay.client import Client
from jointplay.command_line.application import run as command
from jointplay.local.running import run
from jointplay.service.processes import running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.installation import MARK
from jointplay.storage.object_stores import object_store_at
from jointplay.storage.reconciliation import findings
from jointplay.storage.settings import Settings
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store
from tests.waiting import until

SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 2.0}
SWEEP = {
    "kind": "sweep",
    "scene": {"preset": "slider-crank"},
    "grid": {"clearance": [1e-4, 2e-4]},
    "periods": 1,
}


@pytest.mark.long
def test_results_are_those_of_a_local_run(tmp_path: Path) -> None:
    with running_server() as server, running_store() as endpoint:
        backends = {
            "JOINTPLAY_CATALOGUE_URL": server.new("template0"),
            "JOINTPLAY_RESULTS_URL": f"s3://{BUCKET}/lab?endpoint={endpoint}",
        }
        data = tmp_path / "data"
        with running_service(data, 2, backends) as url, Client(url) as client:
            job, study = client.submit(SWING).wait(), client.submit(SWEEP).wait()
            assert (job.state, study.state) == ("succeeded", "succeeded")
            assert study.points["status"].tolist() == ["done", "done"]
            local = run(SWING, output=tmp_path / "local")
            stored, window = job.open(), local.window("rod.theta")
            np.testing.assert_array_equal(stored["rod.theta"], window["rod.theta"])
            assert not (data / "results").exists()
            settings = Settings(
                data=data,
                catalogue_url=backends["JOINTPLAY_CATALOGUE_URL"],
                results_url=backends["JOINTPLAY_RESULTS_URL"],
                lease=0.2,
                heartbeat=0.1,
            )
            catalogue = Catalogue(settings.catalogue_url)
            store = object_store_at(settings.results_url)
            keys = {settings.sealed_run(job.id, 1).key, settings.sealed_study(study.id).key}
            assert set(store.list("")) == keys | {MARK}
            assert [*findings(settings, catalogue)] == []
            for one, sealed in (
                (job, settings.sealed_run(job.id, 1)),
                (study, settings.sealed_study(study.id)),
            ):
                verify = ["verify", one.id, "--processes", "1", "--url", url]
                assert command(verify) == 0
                content = sealed.read(0, sealed.size())
                store.replace(sealed.key, [content[:-3] + bytes([content[-3] ^ 1]) + content[-2:]])
                assert command(verify) == 1
                store.replace(sealed.key, [content])
            job.delete()
            until(lambda: len([*store.list("")]) == len(keys))
            catalogue.close()
