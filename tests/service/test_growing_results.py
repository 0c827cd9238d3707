"""A simulation that is read while it runs: what is committed is there, and nothing else."""

import shutil
from dataclasses import dataclass

import numpy as np
import pytest
import xarray
import zarr

from jointplay.records.impact import IMPACT
from jointplay.records.job import JobError
from jointplay.records.run_rows import RunRows
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.records import BlockState, Claim
from jointplay.storage.results.layout import Partition, ResultLayout
from jointplay.storage.results.writer import ResultWriter
from tests.worker_by_hand import BIFURCATION, SWEEP, known_section

pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")
SMALL = Partition(chunk_rows=64, shard_chunks=4, buffer_bytes=2**24)  # 256 samples a file


@dataclass
class Running:
    """A job of known numbers: the column's index plus the time."""

    worker: object
    catalogue: object
    settings: object
    claim: Claim
    admission: Admission
    writer: ResultWriter

    @property
    def address(self):
        return f"/v1/jobs/{self.claim.job.id}"

    def append(self, samples):
        """Add rows; the worker has them in memory, or in shards that nobody has been told of."""
        first = self.writer.samples
        time = self.time[first : first + samples]
        columns = np.arange(len(self.admission.channels))
        impacts = np.array([(1, 0.5, np.nan, 0.01, 100.0, 0.2)], IMPACT)
        samples = columns + time[:, None]
        self.writer.append(
            RunRows(first_sample=first, sample_time=time, samples=samples, impacts=impacts)
        )

    def commit(self):
        token = self.writer.checkpoint()
        block = self.claim.block
        name = f"block0-a{block.attempt}"
        self.catalogue.record_checkpoint(
            block.id, block.attempt, watermark=self.writer.samples, checkpoint=name
        )
        return token

    def seal(self):
        target = self.settings.sealed_run(self.claim.job.id, self.claim.block.attempt)
        self.writer.seal(target, peaks={}, summary={}, complete=False)
        shutil.rmtree(self.settings.running_folder(self.claim.job.id))
        error = JobError("solver", "step-size-underflow", "No step.")
        self.worker.finish(self.claim, BlockState.failed, error)

    @property
    def time(self):
        return np.linspace(0.0, 2.0, self.admission.samples)


def layout_of(admission):
    channels = admission.channels
    attributes = {"job": admission.job, "scene": admission.scene_document(), "section_note": ""}
    counts = admission.samples, admission.sections
    return ResultLayout(channels, *counts, admission.joints, attributes, SMALL)


@pytest.fixture
def start(worker, catalogue, settings):
    def start(**fields):
        claim = worker.start(worker.submit(**fields))
        admission = admit(claim.job.spec)
        folder = settings.running_run(claim.job.id, claim.block.attempt).folder
        writer = ResultWriter.create(folder, layout_of(admission))
        return Running(worker, catalogue, settings, claim, admission, writer)

    return start


def history_of(http, running, **query):
    answer = http.get(f"{running.address}/history", params={"channels": "slider7.x"} | query)
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_the_history_of_a_running_job_ends_where_it_is_committed(http, start):
    running = start(duration=2.0)
    assert history_of(http, running)["time"]["values"] == []
    for count in (100, 200, 300):
        running.append(count)
        before = len(history_of(http, running)["time"]["values"])
        running.commit()
        shown = history_of(http, running)
        assert before < len(shown["time"]["values"]) == running.writer.samples
        assert shown["complete"] is False
        assert shown["time"]["values"] == running.time[: running.writer.samples].tolist()
    assert history_of(http, running, start=0.52)["time"]["values"][0] == 0.52
    impacts = http.get(f"{running.address}/impacts").json()
    assert len(impacts["impacts"]) == 3
    assert http.get(f"{running.address}/figures/displacement.png").status_code == 200


@pytest.mark.parametrize("count", [1, 63, 64, 100, 255, 256, 257, 300, 400, 511, 512, 513, 1000])
def test_stock_clients_see_committed_samples_and_no_other(http, service_url, start, count):
    running = start(duration=2.0, label=str(count))
    url = f"{service_url}{running.address}/zarr"
    running.append(count)
    assert xarray.open_zarr(url).sizes["sample"] == 0
    running.commit()
    running.append(50)  # not committed
    history = xarray.open_zarr(url)
    assert history.sizes == {"sample": count}
    column = list(history.attrs["channels"]).index("slider7.x")
    np.testing.assert_array_equal(history["time"].to_numpy(), running.time[:count])
    values = history["slider7.x"].to_numpy()
    np.testing.assert_array_equal(values, column + running.time[:count])
    assert xarray.open_zarr(url, group="impacts").sizes == {"impact": 1}
    assert http.get(f"{running.address}/zarr/zarr.json").headers["Cache-Control"] == "no-cache"


def test_a_client_that_opened_earlier_reads_right_while_shards_fill_and_are_sealed(
    service_url, start
):
    running = start(duration=2.0)
    running.append(300)
    running.commit()
    url = f"{service_url}{running.address}/zarr"
    early = zarr.open_group(url, mode="r")["slider7.x"]
    whole = early[:]
    for step in (100, 200, 900):
        running.append(step)
        running.commit()
        np.testing.assert_array_equal(early[:], whole)
        np.testing.assert_array_equal(early[280:290], whole[280:290])
    running.seal()
    np.testing.assert_array_equal(early[:], whole)
    late = zarr.open_group(url, mode="r")["slider7.x"]
    assert late.shape == (1500,)
    np.testing.assert_array_equal(late[:300], whole)


def test_an_index_that_was_read_of_a_growing_shard_stays_right(http, start):
    """The client reads the index, then the shard grows or is finished, then it reads a chunk."""
    running = start(duration=2.0)
    running.append(300)
    running.commit()
    key = f"{running.address}/zarr/slider7.x/c/1"
    size = 16 * 4 + 4

    def chunk(first_offset, length):
        end = first_offset + length - 1
        answer = http.get(key, headers={"Range": f"bytes={first_offset}-{end}"})
        assert answer.status_code == 206
        return answer.content

    packed = http.get(key, headers={"Range": f"bytes=-{size}"}).content
    offset, length = np.frombuffer(packed[:16], "<u8").tolist()
    assert np.frombuffer(packed[16:32], "<u8").tolist() == [2**64 - 1] * 2  # rows 320 to 383
    total = int(http.head(key).headers["Content-Length"])
    first = np.frombuffer(chunk(offset, length)[16:], "<f8")
    assert np.isfinite(first).sum() == 44
    running.append(400)  # the shard is finished
    running.commit()
    assert int(http.head(key).headers["Content-Length"]) < offset
    later = np.frombuffer(chunk(offset, length)[16:], "<f8")
    np.testing.assert_array_equal(later[:44], first[:44])
    again = chunk(total - size, size)  # by those who ask for the size first
    assert np.frombuffer(again[:16], "<u8").tolist() == [offset, length]
    running.seal()
    np.testing.assert_array_equal(np.frombuffer(chunk(offset, length)[16:], "<f8"), later)


def test_the_next_attempt_shows_what_was_committed_before_it_commits(http, start, catalogue):
    running = start(duration=2.0)
    running.append(300)
    token = running.commit()
    running.append(200)  # lost with its worker
    block = running.claim.block
    catalogue.release(block.id, block.attempt)
    claim = running.worker.start(running.claim.job.id)
    assert claim.block.attempt == 2
    assert len(history_of(http, running)["time"]["values"]) == 300
    folders = [running.settings.running_run(claim.job.id, n).folder for n in (1, 2)]
    layout = layout_of(running.admission)
    running.writer = ResultWriter.resume(folders[1], layout, token, taken_over_from=folders[0])
    running.claim = claim
    assert len(history_of(http, running)["time"]["values"]) == 300
    running.append(100)
    running.commit()
    assert len(history_of(http, running)["time"]["values"]) == 400


def test_a_running_study_shows_finished_values_with_their_status(http, service_url, worker):
    job = worker.submit(**BIFURCATION, label="growing")
    claim = worker.start(job)
    worker.compute(claim, failing=(1,), points=4, sections=2)
    url = f"{service_url}/v1/jobs/{job}/zarr"
    points = xarray.open_zarr(url)
    assert points["status"].to_numpy().tolist() == [2, 3, 2, 1] + [0] * 16
    assert points["count"].to_numpy().tolist() == [6, 3, 6, 2] + [0] * 16
    assert points.attrs["failures"][int(points["failure"][1])] == "step-size-underflow"
    assert points["failure_time"][1] == 0.7
    sections = xarray.open_zarr(url, group="sections")
    column = [name for name, *_ in points.attrs["observables"]]
    name = column[2]
    expected = np.full((20, 6), np.nan)
    for point, count in enumerate([6, 3, 6, 2]):
        expected[point, :count] = known_section(point, 2, np.arange(count))
    np.testing.assert_array_equal(sections[name].to_numpy(), expected)
    assert sections[name].attrs["units"]
    exponents = xarray.open_zarr(url, group="indicators")["lyapunov"]
    np.testing.assert_array_equal(exponents.to_numpy()[:4], [0.0, np.nan, 0.2, np.nan])
    assert exponents.attrs["units"] == "1/s"
    values = xarray.open_zarr(url, group="values")["clearance"]
    np.testing.assert_allclose(values.to_numpy(), np.linspace(1e-4, 1e-3, 20))
    for key in ("zarr.json", "status/c/0"):
        assert http.get(f"/v1/jobs/{job}/zarr/{key}").headers["Cache-Control"] == "no-cache"
    for key in ("status/c/1", "status/c/0/0", "nothing/c/0", "sections/c/0", "status/zarr.json/c"):
        assert http.get(f"/v1/jobs/{job}/zarr/{key}").status_code == 404


def test_a_running_sweep_shows_the_peaks_of_finished_points(service_url, worker):
    job = worker.submit(**SWEEP, label="growing")
    worker.compute(worker.start(job), points=2)
    url = f"{service_url}/v1/jobs/{job}/zarr"
    peaks = xarray.open_zarr(url, group="peaks")
    channels = len(peaks.attrs["channels"])
    assert peaks.sizes == {"point": 6, "channel": channels}
    maxima = peaks["maximum"].to_numpy()
    np.testing.assert_array_equal(maxima[:2], [[1.0] * channels, [2.0] * channels])
    assert np.isnan(maxima[2:]).all()
