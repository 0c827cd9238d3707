"""Waiting and transfer of a client of a long history: opening, slices, overviews.

The service runs in a process of its own; the store of ten million samples is written here.
"""

import multiprocessing
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import uvicorn
import xarray
import zarr
from obstore.store import HTTPStore
from zarr.storage import ObjectStore

from jointplay.records.run_rows import RunRows
from jointplay.service.app import create_app
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.writer import ResultWriter
from jointplay.storage.settings import Settings

REPEATS = 15
STEP = 2e-7  # s; ten million samples of 2 s
FEW = ["slider7.x", "acceleration"]


class Counted:
    """Counts what the application sends, headers and bodies, and prints it when asked."""

    def __init__(self, app: Any) -> None:
        self.app = app
        self.sent = 0

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        """Answer a request, or say what was sent since the last question."""
        if scope.get("path") == "/sent":
            body = str(self.sent).encode()
            self.sent = 0
            headers = [(b"content-length", str(len(body)).encode())]
            await send({"type": "http.response.start", "status": 200, "headers": headers})
            await send({"type": "http.response.body", "body": body})
            return

        async def counted(message: Any) -> None:
            self.sent += len(message.get("body", b""))
            self.sent += sum(len(a) + len(b) + 4 for a, b in message.get("headers", ()))
            await send(message)

        await self.app(scope, receive, counted)


def serve(folder: str, port: Any) -> None:
    app = Counted(create_app(Settings(data=Path(folder))))
    server = uvicorn.Server(uvicorn.Config(app, port=0, log_level="warning", lifespan="on"))
    started = server.startup

    async def startup(sockets: Any = None) -> None:
        await started(sockets)
        port.send(server.servers[0].sockets[0].getsockname()[1])

    server.startup = startup  # type: ignore[method-assign]
    server.run()


@contextmanager
def service(folder: Path) -> Iterator[str]:
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe()
    process = context.Process(target=serve, args=(str(folder), sender), daemon=True)
    process.start()
    try:
        yield f"http://127.0.0.1:{receiver.recv()}"
    finally:
        process.terminate()
        process.join()


def stored(http: httpx.Client, settings: Settings, channels: list[str], samples: int) -> str:
    """Submit a job of ten million samples and play its worker; `samples` are really written."""
    job = {
        "kind": "simulate",
        "scene": {"preset": "seven-bar-press"},
        "duration": 2.0,
        "output_step": STEP,
        "channels": channels,
    }
    job_id = http.post("/v1/jobs", json=job).raise_for_status().json()["id"]
    catalogue = Catalogue(settings.catalogue_url)
    claim = catalogue.claim_block(catalogue.blocks(job_id)[0].id, "benchmark", 3600.0)
    assert claim is not None
    admission = admit(claim.job.spec)
    assert isinstance(admission, Admission)
    specs = admission.channels
    attributes = {"job": admission.job, "scene": admission.scene_document()}
    layout = ResultLayout(specs, admission.samples, 0, admission.joints, attributes)
    attempt = job_id, claim.block.attempt
    begun = time.perf_counter()
    writer = ResultWriter.create(settings.running_run(*attempt).folder, layout)
    show(f"create the arrays of {len(specs)} channels", time.perf_counter() - begun)
    noise = np.random.default_rng(0).normal(size=(50_000, len(specs)))
    while writer.samples < samples:
        first = writer.samples
        count = min(len(noise), samples - first)
        moments = (first + np.arange(count, dtype=np.float64)) * STEP
        values = noise[:count] + 3.0 * np.sin(30.0 * moments)[:, None]
        writer.append(RunRows(first_sample=first, sample_time=moments, samples=values))
    target = settings.sealed_run(*attempt)
    begun = time.perf_counter()
    writer.seal(target, peaks={}, summary={}, complete=samples == admission.samples)
    show(f"seal {target.size() / 1e6:.0f} MB", time.perf_counter() - begun)
    shutil.rmtree(settings.running_folder(job_id))
    catalogue.finish(claim.block.id, claim.block.attempt, BlockEnd(BlockState.done))
    catalogue.close()
    return str(job_id)


def show(what: str, seconds: float) -> None:
    print(f"{what:<58}{1e3 * seconds:10.2f} ms")


def timed(what: str, action: Callable[[], object]) -> None:
    """Print the first time and the median of the others."""
    seconds = []
    for _ in range(REPEATS):
        begun = time.perf_counter()
        action()
        seconds.append(time.perf_counter() - begun)
    show(f"{what}, first", seconds[0])
    show(f"{what}, warm", statistics.median(seconds[1:]))


def opened(http: httpx.Client, what: str, action: Callable[[], object]) -> None:
    http.get("/sent")
    action()
    kilobytes = int(http.get("/sent").text) / 1e3
    print(f"open with {what:<48}{kilobytes:10.1f} kB sent")
    timed(f"open with {what}", action)


def main() -> None:
    folder = Path(tempfile.mkdtemp(prefix="results_http_"))
    settings = Settings(data=folder)
    try:
        with service(folder) as url, httpx.Client(base_url=url, trust_env=False) as http:
            wide = f"{url}/v1/jobs/{stored(http, settings, ['*'], 0)}/zarr"
            job = stored(http, settings, FEW, 10_000_001)
            long = f"{url}/v1/jobs/{job}/zarr"

            def through_obstore() -> object:
                store = HTTPStore(wide, client_options={"allow_http": True})
                return zarr.open_group(ObjectStore(store, read_only=True), mode="r")

            opened(http, "xarray, 96 channels", lambda: xarray.open_zarr(wide))
            opened(http, "zarr and obstore, 96 channels", through_obstore)
            opened(http, "xarray, 2 channels", lambda: xarray.open_zarr(long))
            array = zarr.open_group(long, mode="r")["slider7.x"]
            assert isinstance(array, zarr.Array)
            timed("slice of 1000 samples, zarr", lambda: array[5_000_000:5_001_000])
            timed("all of a channel (80 MB), zarr", lambda: array[:])
            for what, window in (
                ("10 million samples", {}),
                ("4.5 million samples", {"start": 0.3, "stop": 1.2}),
                ("400 000 samples", {"start": 0.3, "stop": 0.38}),
            ):
                query = {"channels": "slider7.x", "points": 2000} | window
                address = f"/v1/jobs/{job}/history"

                def overview(query: dict[str, Any] = query, address: str = address) -> object:
                    return http.get(address, params=query).raise_for_status().json()

                timed(f"2000 points of {what}", overview)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
