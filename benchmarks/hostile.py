"""Seconds in which hostile bodies are answered, and those of the API's processor that they take.

python -m benchmarks hostile
"""

import os
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import httpx

from benchmarks.hostile_bodies import Hostile, hostile_bodies
from jointplay.chaos.inside import FOLDER_VARIABLE
from jointplay.chaos.processes import running
from jointplay.service.processes import running_service

_TICKS = os.sysconf("SC_CLK_TCK")


class Answered(NamedTuple):
    """One answer: seconds of waiting, seconds of the API's processor, status and problem."""

    waited: float
    spent: float
    answer: str


def send(http: httpx.Client, one: Hostile) -> httpx.Response:
    """Send a body."""
    head = {"Content-Type": "application/json"}
    return http.post(one.path, content=one.body, headers=head)


def answered(http: httpx.Client, one: Hostile, api: int) -> Answered:
    """Send a body and return what it took; what is accepted is cancelled."""
    begun, spent = time.perf_counter(), processor_seconds(api)
    answer = send(http, one)
    took = time.perf_counter() - begun, processor_seconds(api) - spent
    if answer.is_success:
        http.post(f"{answer.headers['Location']}/cancel").raise_for_status()
        return Answered(*took, f"{answer.status_code}")
    return Answered(*took, f"{answer.status_code} {answer.json()['type'].rsplit('/', 1)[-1]}")


def processor_seconds(pid: int) -> float:
    """Return the seconds of processor time that a process has had, its children's not included."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


def main() -> None:
    """Print the table: the longest of each kind."""
    found: defaultdict[str, list[Answered]] = defaultdict(list)
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        mark = {FOLDER_VARIABLE: made}
        with (
            running_service(folder / "data", environment=mark) as url,
            httpx.Client(base_url=url, trust_env=False, timeout=600.0) as http,
        ):
            (api,) = running(folder, "api")
            for one in hostile_bodies():
                found[one.label].append(answered(http, one, api.pid))
    print(f"{'body':<32}{'sent':>6}{'s, longest':>12}{'s of the API':>14}  answers")
    for label, ones in found.items():
        longest = max(one.waited for one in ones)
        spent = max(one.spent for one in ones)
        answers = ", ".join(sorted({one.answer for one in ones}))
        print(f"{label:<32}{len(ones):6d}{longest:12.2f}{spent:14.2f}  {answers}")


if __name__ == "__main__":
    main()
