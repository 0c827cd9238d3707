"""Bodies that are wrong in many ways, and scenes that are slow to look at."""

import json
import random
from collections.abc import Iterator
from typing import Any, NamedTuple

from jointplay.service.body import LARGEST_BATCH

PRESS: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 2.0,
}
ODD = 300
"""Bodies that are sent which must be refused."""


class Hostile(NamedTuple):
    """A body, where it is sent, and what is wrong with it."""

    label: str
    path: str
    body: bytes


def hostile_bodies() -> Iterator[Hostile]:
    """Yield bodies that are wrong, and others that are slow to look at, of which some are right."""
    chance = random.Random(0)
    kinds = (_too_large, _too_deep, _long_lists, _wrong_types, _unknown_names, _huge_numbers)
    for number in range(ODD):
        kind = kinds[number % len(kinds)]
        label = kind.__name__.removeprefix("_").replace("_", " ")
        yield Hostile(label, "/v1/jobs", kind(chance))
    for document in slow_scenes():
        yield Hostile(document["label"], "/v1/jobs", json.dumps(document).encode())
    scene = job("", chain(64))
    body = json.dumps({"jobs": [scene] * (LARGEST_BATCH // (len(json.dumps(scene)) + 2) - 1)})
    yield Hostile("a batch of 64 chained bodies", "/v1/batches", body.encode())
    body = json.dumps({"jobs": [PRESS | {"label": f"{i}"} for i in range(10_000)]})
    yield Hostile("a batch of 10 000 jobs", "/v1/batches", body.encode())


def _too_large(chance: random.Random) -> bytes:
    return json.dumps({**PRESS, "label": "x" * chance.randrange(1_000_000, 9_000_000)}).encode()


def _too_deep(chance: random.Random) -> bytes:
    depth = chance.randrange(500, 200_000)
    return b"[" * depth + b"]" * depth


def _long_lists(chance: random.Random) -> bytes:
    names = [f"no.{chance.random()}" for _ in range(chance.randrange(1000, 100_000))]
    return json.dumps({**PRESS, "channels": names}).encode()


def _wrong_types(chance: random.Random) -> bytes:
    wrong: list[object] = [None, [], {}, "x", True, -1, 1e400, [[[]]]]
    return json.dumps({name: chance.choice(wrong) for name in PRESS}).encode()


def _unknown_names(chance: random.Random) -> bytes:
    extra = {f"field{i}": chance.random() for i in range(chance.randrange(1, 50_000))}
    return json.dumps({**PRESS, **extra}).encode()


def _huge_numbers(chance: random.Random) -> bytes:
    return b'{"kind": "simulate", "duration": ' + b"9" * chance.randrange(10, 1_000_000) + b"}"


def slow_scenes() -> Iterator[dict[str, Any]]:
    """Yield jobs of many bodies and of many points; some are accepted."""
    for count in (12, 16, 64):
        yield job(f"{count} chained bodies", chain(count))
    for count in (20, 64):
        yield job(f"{count} free bodies", free(count))
    yield {
        "kind": "sweep",
        "label": "100 000 points",
        "scene": {"preset": "seven-bar-press"},
        "grid": {
            "clearance": {"from": 1e-4, "to": 1e-3, "count": 1000},
            "friction": {"from": 0.01, "to": 0.2, "count": 100},
        },
        "periods": 1.0,
    }


def job(label: str, scene: dict[str, Any]) -> dict[str, Any]:
    """Return a short simulation of a scene."""
    return {"kind": "simulate", "label": label, "scene": scene, "duration": 0.1}


def chain(count: int) -> dict[str, Any]:
    """Return a pendulum of many rods: everything depends on everything before it."""
    rod = {"mass": 1.0, "inertia": 0.1, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    ends = ["ground.O", *(f"r{i}.b" for i in range(count))]
    joints = {
        f"j{i}": {"type": "revolute", "bearing": ends[i], "journal": f"r{i}.a"}
        for i in range(count)
    }
    return _scene({f"r{i}": rod for i in range(count)}, joints)


def free(count: int) -> dict[str, Any]:
    """Return bodies that each rest in a bearing with play and friction."""
    clearance = {
        "radial_clearance": 1e-3,
        "bearing_radius": 1e-2,
        "contact": {"law": "lankarani-nikravesh", "stiffness": 1e9, "restitution": 0.9},
        "friction": {"law": "modified-coulomb", "coefficient": 0.1},
    }
    body = {"mass": 1.0, "inertia": 1.0, "points": {"a": [0.0, 0.0]}}
    joints = {
        f"j{i}": {
            "type": "revolute",
            "bearing": "ground.O",
            "journal": f"b{i}.a",
            "clearance": clearance,
        }
        for i in range(count)
    }
    return _scene({f"b{i}": body for i in range(count)}, joints)


def _scene(bodies: dict[str, Any], joints: dict[str, Any]) -> dict[str, Any]:
    ground = {"points": {"O": [0.0, 0.0]}}
    return {
        "name": "many-bodies",
        "gravity": [0.0, -9.81],
        "ground": ground,
        "bodies": bodies,
        "joints": joints,
    }
