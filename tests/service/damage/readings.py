"""The ways to a job's results: every address, the client, and the commands."""

import io
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import httpx
import numpy as np

from jointplay.client import Client, Job, NotFound, Refused
from jointplay.command_line.application import run as run_command
from jointplay.service.results.forms import ARROW, CSV, MATLAB, NPZ
from jointplay.service.zarr.contents import is_key
from jointplay.storage.packed import Packed
from tests.service.damage.subjects import Subject

FORMS: Final = {"CSV": CSV, "NPZ": NPZ, "MATLAB": MATLAB, "Arrow": ARROW}
_MATLAB_HEADER: Final = 128  # says when the file was made
_RESULTS: Final = (
    "statistics",
    "peaks",
    "impacts",
    "certificate",
    "poincare",
    "bifurcation",
    "sweep",
    "accuracy",
    "calibration",
)


class Denied(Exception):
    """Nothing was given out; the text says why."""


@dataclass(frozen=True)
class Reading:
    """One way to some results: `read` gives what is served, or raises `Denied`."""

    way: str
    name: str
    read: Callable[[], bytes] = field(repr=False, compare=False)
    key: str | None = None


def readings(http: httpx.Client, client: Client, subject: Subject, scratch: Path) -> list[Reading]:
    """Return every way to a job's results; some lead to none, such as sections of a sweep."""
    links = http.get(f"/v1/jobs/{subject.job}").json()["links"]
    return [
        *_addresses(http, links),
        *_keys(http, subject),
        *_of_client(client, subject.job, links),
        *_commands(http, subject, links, scratch),
    ]


def _addresses(http: httpx.Client, links: dict[str, str]) -> Iterator[Reading]:
    """Yield addresses in every form that they have."""
    for name in _RESULTS:
        if name in links:
            yield _get(http, "JSON", links[name])
    if "history" in links:
        history = f"{links['history']}?channels=slider7.*"
        yield _get(http, "JSON", history)
        yield _get(http, "window", f"{history}&start=0.1&stop=0.3")
        yield _get(http, "window", f"{links['history']}?channels=slider7.x&points=20")
        for form, accepted in FORMS.items():
            yield _get(http, form, history, Accept=accepted)
            yield _get(http, form, links["poincare"], Accept=accepted)
    if "figures" in links:
        for one in http.get(links["figures"]).json()["figures"]:
            yield _get(http, "figure", one["png"])


def _keys(http: httpx.Client, subject: Subject) -> Iterator[Reading]:
    """Yield the keys of the store, as stock Zarr clients ask for them, and a range of each."""
    base = f"/v1/jobs/{subject.job}/zarr"
    if subject.running:
        keys = set(_announced(http.get(f"{base}/zarr.json").json()))
    else:
        (file,) = subject.files
        keys = {key for key in Packed(file.stored) if is_key(key)}
    for key in sorted(keys | {"zarr.json"}):
        yield _get(http, "Zarr key", f"{base}/{key}", key)
        if not key.endswith("zarr.json"):
            yield _get(http, "Zarr key", f"{base}/{key}", key, Range="bytes=-20")


def _announced(root: dict[str, Any]) -> Iterator[str]:
    """Yield the keys of all documents and chunks of a store by its root's document."""
    for path, node in root["consolidated_metadata"]["metadata"].items():
        yield f"{path}/zarr.json"
        if node["node_type"] == "array":
            chunk = node["chunk_grid"]["configuration"]["chunk_shape"]
            cuts = [-(-size // step) for size, step in zip(node["shape"], chunk, strict=True)]
            for index in np.ndindex(*cuts):
                yield "/".join([path, "c", *map(str, index)])


def _get(
    http: httpx.Client, way: str, address: str, key: str | None = None, **headers: str
) -> Reading:
    def read() -> bytes:
        answer = http.get(address, headers=headers)
        if answer.status_code not in (200, 206):
            raise Denied(f"{answer.status_code} {answer.text}")
        return answer.content[_MATLAB_HEADER if way == "MATLAB" else 0 :]

    return Reading(way, f"{address} {' '.join(headers.values())}", read, key)


def _of_client(client: Client, job: str, links: dict[str, str]) -> Iterator[Reading]:
    """Yield what the Python client gives: tables, windows, pictures, and arrays by xarray."""
    ways: dict[str, Callable[[Job], object]] = {
        "poincare": lambda job: job.poincare.to_csv(),
        "open": lambda job: [repr(one.to_numpy().tobytes()) for one in job.open().values()],
        "figures": lambda job: job.figures,
    }
    if "history" in links:
        ways |= {
            "history": lambda job: job.history["slider7.x"].to_numpy().tobytes(),
            "peaks": lambda job: job.peaks.to_csv(),
            "impacts": lambda job: job.impacts.to_csv(),
            "statistics": lambda job: job.statistics,
            "certificate": lambda job: job.certificate,
            "window": lambda job: job.window("slider7.x", points=20)["slider7.x"].tobytes(),
        }
    elif "accuracy" in links:
        ways["accuracy"] = lambda job: job.accuracy
    elif "calibration" in links:
        ways["calibration"] = lambda job: job.calibration
    else:
        ways["points"] = lambda job: job.points.to_csv()
    for name, way in ways.items():
        yield Reading("client", name, _asked(client, job, way))


def _asked(client: Client, job: str, way: Callable[[Job], object]) -> Callable[[], bytes]:
    def read() -> bytes:
        try:
            return repr(way(client.job(job))).encode()
        except (Refused, NotFound) as error:
            raise Denied(str(error)) from error
        except Exception as error:
            status = getattr(error, "status", None)  # of aiohttp, which stock Zarr reads with
            if status is None:
                raise
            raise Denied(f"{status} for stock Zarr: damaged") from error

    return read


def _commands(
    http: httpx.Client, subject: Subject, links: dict[str, str], scratch: Path
) -> Iterator[Reading]:
    """Yield the commands that print results, or write them."""
    job, url = subject.job, ["--url", str(http.base_url)]
    tables = ("history", "poincare", "peaks", "impacts") if "history" in links else ()
    for table in tables or ("poincare", "points"):
        typed = ["export", job, "--table", table]
        yield Reading("command", f"export {table}", _typed([*typed, *url]))
        yield Reading("command", f"export {table} --json", _typed([*typed, "--json", *url]))
    if not subject.running:  # of a running job it shows what can be read, here nothing
        yield Reading("command", "show", _typed(["show", job, *url]))
    if "certificate" in links:
        yield Reading("command", "certificate", _typed(["certificate", job, *url]))
    if "history" in links:
        typed = ["compare", job, job, "--channels", "slider7.x", "-o", str(scratch / "both.png")]
        yield Reading("command", "compare", _typed([*typed, *url]))


def _typed(arguments: list[str]) -> Callable[[], bytes]:
    def read() -> bytes:
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            code = run_command(arguments)
        if code:
            raise Denied(f"exit {code}: {err.getvalue()}")
        return out.getvalue().encode()

    return read
