"""“Run with changes” of a job changes what was changed in its form, and nothing else."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from jointplay.solver.scene import presets
from tests.page.browsing import UNFINISHED, expect
from tests.page.test_own_mechanism import paste

Document = dict[str, Any]
ROOT = Path(__file__).resolve().parents[2]
OSCILLATOR = {"preset": "impact-oscillator", "parameters": {"damping": 2.5}}
PLACE = "/start/joints/stop/eccentricity/0"
LOG = {"from": 1.0, "to": 100.0, "count": 7, "spacing": "log"}
JOBS: list[Document] = [
    {"kind": "simulate", "duration": 0.5, "accuracy": "fine", "channels": ["stop.*"]},
    {"kind": "simulate", "duration": 0.5, "method": "rk4", "step": 1e-5, "output_step": 1e-2},
    {
        "kind": "bifurcation",
        "parameter": "speed",
        "values": [20.0, 21.0, 30.0],
        "section": {"channel": "stop.eccentricity_x", "value": 0.01},
        "indicators": ["lyapunov"],
        "tolerance": 1e-8,
    },
    {
        "kind": "sweep",
        "grid": {"speed": [20.0, 21.0, 30.0], "stiffness": LOG, "amplitude": [1e-3, 2e-3]},
        "periods": 3,
        "settle": 2,
        "statistics": ["median"],
    },
    {"kind": "sweep", "points": [{"speed": 20.0}, {"speed": 25.0}], "duration": 1.0},
    {
        "kind": "sensitivity",
        "parameters": {
            "speed": {"distribution": "triangular", "low": 20.0, "mode": 21.0, "high": 30.0},
            "amplitude": {"distribution": "uniform", "low": 1e-3, "high": 2e-3},
        },
        "samples": 4,
        "periods": 3,
        "accuracy": "draft",
    },
    {
        "kind": "basin-stability",
        "starts": {PLACE: {"distribution": "uniform", "low": -0.1, "high": 0.1}},
        "along": {"parameter": "speed", "values": LOG | {"from": 20.0, "to": 30.0}},
        "settle": "auto",
        "samples": 5,
    },
]


def made_of(http: Any, document: Document) -> Document:
    """Submit a job and cancel it; return it as the service answers it."""
    made = http.post("/v1/jobs", json=document | {"cache": False})
    assert made.status_code == 202, made.text
    http.post(f"/v1/jobs/{made.json()['id']}/cancel").raise_for_status()
    return dict(made.json())


def opened(page: Any, service_url: str, job: str) -> Document:
    """Open the form of a job that is to be changed; return the document that it shows."""
    page.goto(f"{service_url}/#/job/{job}")
    page.get_by_role("link", name="Run with changes").click()
    form = page.get_by_role("button", name="JSON")
    form.click()
    expect(form).to_have_attribute("aria-pressed", "true")
    return shown(page)


def shown(page: Any) -> Document:
    return dict(json.loads(page.get_by_label("The same job", exact=True).inner_text()))


def all_jobs() -> list[Document]:
    """Jobs that say more than the forms have fields for, and one of each other kind."""
    found = [{"scene": OSCILLATOR} | one for one in JOBS]
    for one in json.loads((ROOT / "chaos" / "jobs.json").read_text()):
        if one["kind"] not in {other["kind"] for other in found}:
            found.append(one)
    return found


def test_a_form_in_which_nothing_was_changed_makes_the_same_job(browsing, http, service_url):
    with browsing.page(f"{service_url}/#/jobs", expected=UNFINISHED) as page:
        for document in all_jobs():
            before = made_of(http, document)
            again = opened(page, service_url, before["id"])
            assert made_of(http, again)["job"] == before["job"]


def test_only_what_was_changed_is_changed(browsing, http, service_url):
    before = made_of(http, {"scene": OSCILLATOR} | JOBS[3])
    with browsing.page(f"{service_url}/#/jobs", expected=UNFINISHED) as page:
        opened(page, service_url, before["id"])
        page.get_by_label("Second parameter, values", exact=True).fill("9")
        page.get_by_label("Accuracy", exact=True).select_option("draft")
        now = made_of(http, shown(page))["job"]
    grid = before["job"]["grid"]
    grid["stiffness"]["count"] = 9
    assert now == before["job"] | {"grid": grid, "method": now["method"], "tolerance": 3e-4}


@pytest.fixture
def own() -> Document:
    document = presets.document("impact-oscillator") | {"name": "mine"}
    del document["source"]
    return document


def test_a_study_of_ones_own_mechanism_stays_one(browsing, http, service_url, own):
    before = made_of(http, {"scene": own} | JOBS[2])
    with browsing.page(f"{service_url}/#/jobs", expected=UNFINISHED) as page:
        again = opened(page, service_url, before["id"])
        assert made_of(http, again)["job"] == before["job"]
        page.go_back()
        expect(page.get_by_text("speed 20 rad/s … 30 rad/s")).to_be_visible()
        page.get_by_role("link", name="Change the mechanism").click()
        page.get_by_label("Scene document").wait_for()
        document = page.evaluate("sessionStorage.getItem('jointplay-scene')")
        paste(page, document.replace('"source": ""', '"source": "a drawing"'))
        page.get_by_role("link", name="Jobs").click()
        page.go_back()  # what was typed is still there
        expect(page.get_by_text('"a drawing"')).to_be_visible()
        page.get_by_role("button", name="Vary it …").click()
        expect(page.get_by_label("What to compute")).to_have_value("bifurcation")
        page.get_by_role("button", name="JSON").click()
        now = shown(page)
    assert now["scene"]["source"] == "a drawing"
    assert now["values"] == {"from": 20.0, "to": 30.0, "count": 3}
    assert now["tolerance"] == 1e-8


NAMES = {"damping": "duration", "amplitude": "count", "gap": "label"}


def test_parameters_with_the_names_of_fields_are_kept_apart_from_them(browsing, service_url, own):
    """One took the value of the other when the address was opened again."""
    own["parameters"] = {NAMES.get(name, name): one for name, one in own["parameters"].items()}
    with browsing.page(f"{service_url}/#/jobs") as page:
        page.evaluate("text => sessionStorage.setItem('jointplay-scene', text)", json.dumps(own))
        page.goto(f"{service_url}/#/new?kind=bifurcation&record=7&speed=21")  # as before
        expect(page.get_by_label("speed", exact=True)).to_have_value("21")
        values = page.get_by_label("Values", exact=True)
        expect(values).to_have_value("48")
        for name, value in {"duration": "2.5", "count": "0.004", "label": "0.02"}.items():
            page.get_by_label(name, exact=True).fill(value)
        page.get_by_label("Label", exact=True).fill("mine")
        expect(page).to_have_url(re.compile("label=mine"))
        page.reload()
        for name, value in {"duration": "2.5", "count": "0.004", "label": "0.02"}.items():
            expect(page.get_by_label(name, exact=True)).to_have_value(value)
        expect(values).to_have_value("48")
        expect(page.get_by_label("Label", exact=True)).to_have_value("mine")
        expect(page.get_by_label("Sections", exact=True)).to_have_value("7")
        page.get_by_label("What to compute").select_option("simulate")
        expect(page.get_by_label("Duration", exact=True)).not_to_have_value("2.5")
