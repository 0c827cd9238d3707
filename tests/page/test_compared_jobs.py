"""Jobs that are compared say in what they differ, with units."""

import copy

from jointplay.solver.scene import presets
from tests.page.browsing import barriers, expect


def own(clearance):
    """Return the slider-crank as a mechanism of one's own, with another clearance."""
    document = copy.deepcopy(presets.document("slider-crank"))
    document["name"] = "mine"
    document["parameters"]["clearance"]["default"] = clearance
    return document


def test_runs_of_ones_own_mechanism_are_told_apart(browsing, service_url, worker):
    tolerances = {1e-4: 1e-6, 2e-4: 1e-7}
    jobs = [
        worker.finished(scene=own(clearance), duration=1.0, tolerance=tolerance)
        for clearance, tolerance in tolerances.items()
    ]
    with browsing.page(f"{service_url}/#/compare?jobs={','.join(jobs)}") as page:
        entries = page.locator(".legend li")
        expect(entries.nth(0)).to_contain_text("clearance 100 µm, tolerance 1e−6")
        expect(entries.nth(1)).to_contain_text("clearance 200 µm, tolerance 1e−7")
        page.locator(".uplot").first.wait_for()
        assert barriers(page) == []


def test_presets_differ_in_their_parameters_and_others_in_none(browsing, service_url, worker):
    scenes = [
        {"preset": "slider-crank", "parameters": {"clearance": 1e-4, "speed": 100}},
        {"preset": "slider-crank", "parameters": {"clearance": 2e-4, "speed": 100}},
    ]
    jobs = [worker.finished(scene=scene, duration=1.0) for scene in scenes]
    with browsing.page(f"{service_url}/#/compare?jobs={','.join(jobs)}") as page:
        entries = page.locator(".legend li")
        expect(entries.nth(1)).to_contain_text("clearance 200 µm")
        expect(entries.nth(1)).not_to_contain_text("speed")
