"""Attacks by who has a key for workers."""

import shutil
import time
from concurrent.futures import ThreadPoolExecutor

from benchmarks.single_attacks.attacked import SWING, Attacked, Held

_SWEEP = {
    "kind": "sweep",
    "scene": {"preset": "slider-crank"},
    "grid": {"clearance": {"from": 1e-4, "to": 2e-4, "count": 12}},
    "periods": 1,
}
"""Two blocks."""
_MEGABYTE = 10**6


def _finish(service: Attacked, held: Held) -> int:
    with service.as_("lab") as lab:
        return lab.post(f"{held.path}/finish", json={"outcome": "done"}).status_code


def finish(service: Attacked) -> str:
    """Say that a run is done of which nothing was sent, or garbage."""
    found = []
    for content in (None, b"garbage" * 1000):
        job = service.submit(SWING)
        held = service.claim()
        if content is not None:
            service.put(held, "sealed/1", content)
        told = _finish(service, held)
        with service.joined(), service.as_("bob") as bob:
            state = service.ended(job)["state"]
            peaks = bob.get(f"/v1/jobs/{job}/peaks").status_code
        found.append(f"{told}, {state}, peaks {peaks}")
    return "; ".join(dict.fromkeys(found))


def parts(service: Attacked) -> str:
    """Seal a study, write another block's part and remove it, as the holder of its first block."""
    job = service.submit(_SWEEP)
    first, second = sorted((service.claim(n) for n in (1, 2)), key=lambda held: held.number)
    names = ("sealed/study", "study/parts/00001", "study/parts/00001-a1")
    statuses = [service.put(first, name, b"garbage" * 1000) for name in names]
    with service.as_("lab") as lab:
        statuses += [lab.delete(f"{first.path}/files/{name}").status_code for name in names[1:]]
        for held in (first, second):
            lab.post(f"{held.path}/release")
    with service.joined(), service.as_("bob") as bob:
        state = service.ended(job)["state"]
        results = bob.get(f"/v1/jobs/{job}/sweep").status_code
    told = ", ".join(map(str, statuses))
    return f"PUT, PUT, PUT, DELETE, DELETE {told}; then {state}, results {results}"


def uploads(service: Attacked) -> str:
    """Send six files of 200 MB at once, then as many of 20 MB as are taken, on a small disk."""

    def room() -> int:
        return shutil.disk_usage(service.folder / "data").free

    service.submit(SWING)
    held, big, left = service.claim(), bytes(200 * _MEGABYTE), room()
    with ThreadPoolExecutor(6) as threads:
        sent = [threads.submit(service.put, held, held.rows(n), big) for n in range(6)]
        while not all(one.done() for one in sent):
            left = min(left, room())
            time.sleep(0.01)
        statuses = sorted(one.result() for one in sent)
    service.submit(SWING)
    held, taken, some = service.claim(2), 0, bytes(20 * _MEGABYTE)
    while taken < 40 and (last := service.put(held, held.rows(taken), some)) == 204:
        taken += 1
        left = min(left, room())
    told = f"{', '.join(map(str, statuses))}; then {taken} of 40 of 20 MB"
    return f"{told}{f', then {last}' if taken < 40 else ''}; at least {left // _MEGABYTE} MB left"
