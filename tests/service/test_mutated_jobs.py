"""Jobs spoilt at random places: accepted or refused with a problem, never a failure of ours."""

import copy
import json
import random
from typing import Any

import pytest

from jointplay.solver.scene import presets
from tests.presets_given import REQUIRED

EXTREMES: list[Any] = [
    None,
    True,
    -1,
    0,
    1,
    10**18,
    1.5,
    -1e308,
    1e308,
    5e-324,
    1e-300,
    1e16,
    "",
    "x",
    "../..",
    "NaN",
    "ground.o",
    [],
    [[]],
    [0.0, 0.0],
    [1e308, 1e308],
    {},
    {"a": 1},
]


def sound_jobs() -> list[dict[str, Any]]:
    jobs: list[dict[str, Any]] = []
    for name in presets.names():
        scene = presets.document(name)
        parameters = {key: one.get("default") for key, one in scene["parameters"].items()}
        by_name = {"preset": name, "parameters": parameters | REQUIRED.get(name, {})}
        more = {"output_step": 0.01, "channels": ["*"], "section": {"crank_angle": 0.1}}
        jobs += [
            {"kind": "simulate", "scene": by_name, "duration": 1.0, "tolerance": 1e-6} | more,
            {"kind": "simulate", "scene": scene, "duration": 1.0},
        ]
    values = {"from": 1e-4, "to": 5e-4, "count": 9, "spacing": "log"}
    study = {"scene": {"preset": "slider-crank"}, "tolerance": 1e-6}
    sections = {"settle": 3, "record": 4, "section": {"onset": "B"}, "indicators": ["lyapunov"]}
    over = {"parameter": "clearance", "values": values, "continuation": "both", "chains": 2}
    grid = {"grid": {"clearance": values, "restitution": [0.5, 0.9]}, "periods": 2, "settle": 1}
    return [
        *jobs,
        {"kind": "bifurcation", **study, **sections, **over},
        {"kind": "poincare", **study, **sections},
        {"kind": "ensemble", **study, **sections, "members": 5, "spread": 1e-2, "seed": 7},
        {"kind": "sweep", **study, **grid},
        {
            "kind": "accuracy-study",
            "scene": {"preset": "slider-crank"},
            "duration": 0.01,
            "methods": ["rodas"],
            "tolerances": [1e-4],
        },
    ]


def spoilt(job: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    """Replace, remove or add something at up to three random places."""
    job = copy.deepcopy(job) | {"cache": True}
    for _ in range(chance.randint(1, 3)):
        node: Any = job
        while True:
            keys = list(node) if isinstance(node, dict) else list(range(len(node)))
            if not keys:
                break
            key = chance.choice(keys)
            if isinstance(node[key], dict | list) and node[key] and chance.random() < 0.85:
                node = node[key]
                continue
            what = chance.random()
            alike = [value for value in EXTREMES if type(value) is type(node[key])]
            if what < 0.5 and alike:
                node[key] = chance.choice(alike)
            elif what < 0.8:
                node[key] = chance.choice(EXTREMES)
            elif what < 0.9:
                del node[key]
            elif isinstance(node, dict):
                node[chance.choice(["zz", "type", "preset", "bodies", ""])] = 1
            break
    return job


@pytest.mark.parametrize("seed", range(4))
def test_a_spoilt_job_is_accepted_or_refused_but_never_a_failure(http, seed):
    chance = random.Random(seed)
    jobs = sound_jobs()
    answers = set()
    for _ in range(150):
        job = spoilt(chance.choice(jobs), chance)
        answer = http.post("/v1/jobs", json=job)
        answers.add(answer.status_code)
        assert answer.status_code in {200, 202, 422}, (json.dumps(job), answer.text)
        if answer.status_code == 422:
            problem = answer.json()
            assert problem["errors"]
            assert all(error["pointer"] is not None for error in problem["errors"])
    assert answers >= {202, 422}  # both kinds were tried
