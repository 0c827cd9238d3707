"""A machine that is lost with everything on it: another one, which shares nothing but the catalogue
and the object store, goes on where it was.
"""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from jobs import IMPATIENT, ended, in_mid_block, submit

from jointplay.service.processes import running_service
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.installation import MARK
from jointplay.storage.settings import Settings
from jointplay.worker.execute import execute
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store
from tests.stores import files_of, packed, target
from tests.waiting import until

# some seconds of computing; more samples than one shard holds
JOB = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {"clearance": 5e-4, "friction": 0.1}},
    "duration": 400.0,
    "output_step": 2e-3,
    "channels": ["slider7.*", "A.*"],
    "certificate": False,
}


@contextmanager
def machine(folder: Path, shared: dict[str, str]) -> Iterator["subprocess.Popen[bytes]"]:
    """Keep a worker running whose every file of its own is in one folder."""
    scratch = folder / "scratch"
    scratch.mkdir(parents=True)
    environment = shared | {"JOINTPLAY_DATA": str(folder / "data"), "TMPDIR": str(scratch)}
    (folder / "data").mkdir()
    with (folder / "log").open("wb") as log:
        worker = subprocess.Popen(
            [sys.executable, "-P", "-m", "jointplay.worker"],
            env=os.environ | environment,
            stdout=log,
            stderr=log,
            start_new_session=True,
        )
    try:
        yield worker
    finally:
        if worker.poll() is None:
            os.killpg(worker.pid, signal.SIGKILL)
        worker.wait()


@pytest.mark.long
def test_another_machine_goes_on_without_the_files_of_a_lost_one(tmp_path: Path) -> None:
    admission = admit(JOB)
    assert isinstance(admission, Admission)
    undisturbed = tmp_path / "undisturbed"
    execute(admission, undisturbed, target(undisturbed), report=lambda _: "continue")
    with running_server() as server, running_store() as endpoint:
        data = tmp_path / "service"
        shared = IMPATIENT | {
            "JOINTPLAY_CATALOGUE_URL": server.new("template0"),
            "JOINTPLAY_RESULTS_URL": f"s3://{BUCKET}/lost?endpoint={endpoint}",
        }
        settings = Settings(
            data=tmp_path,
            catalogue_url=shared["JOINTPLAY_CATALOGUE_URL"],
            results_url=shared["JOINTPLAY_RESULTS_URL"],
        )
        with running_service(data, 0, shared):
            shared["JOINTPLAY_REDIS_URL"] = f"unix://{data / 'broker' / 'redis.sock'}"
            catalogue = Catalogue(settings.catalogue_url)
            with machine(tmp_path / "first", shared) as lost:
                job = submit(catalogue, admission)
                until(lambda: catalogue.blocks(job)[0].watermark > 0)
                in_mid_block(catalogue, job)
                os.killpg(lost.pid, signal.SIGKILL)
                lost.wait()
                shutil.rmtree(tmp_path / "first")
            reached = catalogue.blocks(job)[0].watermark
            with machine(tmp_path / "second", shared):
                until(lambda: catalogue.blocks(job)[0].watermark != reached)
                assert catalogue.blocks(job)[0].watermark > reached
                finished = ended(catalogue, job)
                assert (finished.state, finished.attempt) == (JobState.succeeded, 2)
                sealed = settings.sealed_run(job, 2)
                until(lambda: {*settings.object_store.list("")} == {sealed.key, MARK})
            catalogue.close()
        stored, expected = files_of(sealed), files_of(packed(undisturbed))
        chunks = [key for key in expected if "/c/" in key]
        assert len(chunks) > 50
        assert [key for key in chunks if stored.get(key) != expected[key]] == []
        assert not (data / "running" / job[-2:]).exists()
