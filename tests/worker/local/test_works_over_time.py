"""Losses of a run over time, read from its steps: the figure of its energy shows them."""

import numpy as np
import pytest

import jointplay
from jointplay import figures
from jointplay.local.folder_job import results_in
from jointplay.records.works import WORKS

JOB = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 0.3}


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    jobs = {
        name: jointplay.run(JOB | {"certificate": False} | more, output=folder / name)
        for name, more in {"kept": {}, "not kept": {"steps_limit": 0}}.items()
    }
    return {name: results_in(job._folder) for name, job in jobs.items()}


def test_works_grow_from_nothing_to_the_ledger_of_the_run(sources):
    ledger = sources["kept"].attributes["summary"]["energy"]
    table = sources["kept"].trajectory.works(0.0, 0.3).values
    assert table[0].tolist() == [0.0] * 5
    assert table[-1, 0] == 0.3
    assert np.all(np.diff(table[:, 0]) > 0.0)
    for name, curve in zip(WORKS, table[:, 1:].T, strict=True):
        # the same numbers as the ledger's, added up in another order
        assert curve[-1] == pytest.approx(ledger[name], abs=1e-10 * ledger["gross_work"])
    assert np.all(np.diff(table[:, 2]) >= -1e-9 * ledger["gross_work"])  # friction takes only


def test_works_of_windows_add_up(sources):
    trajectory = sources["kept"].trajectory
    whole, *parts = (
        trajectory.works(*ends).values[-1, 1:]
        for ends in ((0.01, 0.3), (0.01, 0.123), (0.123, 0.3))
    )
    assert np.allclose(whole, sum(parts), rtol=0.0, atol=1e-12)


def test_the_figure_shows_where_energy_is_lost_and_ends_at_the_ledger(sources):
    upper, lower = figures.draw(sources["kept"], "energy").axes
    curves = {line.get_label(): line for line in lower.lines}
    assert {"contacts", "friction", "stored"} <= curves.keys()
    assert "elements" not in curves  # the press has none
    assert lower.get_ylabel() == "energy [mJ]"
    ledger = sources["kept"].attributes["summary"]["energy"]
    for name, term in (("contacts", "contact_loss"), ("friction", "friction_loss")):
        shown = curves[name].get_ydata()[-1] * 1e-3
        assert shown == pytest.approx(ledger[term], abs=1e-9 * ledger["gross_work"])
    assert len(upper.lines) > 4


def test_without_steps_the_rest_is_one_curve(sources):
    assert "keeps no steps" in sources["not kept"].trajectory.works(0.0, 0.3).refused
    (axes,) = figures.draw(sources["not kept"], "energy").axes
    assert "contacts, friction, elements" in [line.get_label() for line in axes.lines]


def test_a_mechanism_that_neither_loses_nor_stores_energy_has_no_panel_for_that(tmp_path):
    job = jointplay.run("pendulum", duration=0.1, certificate=False, output=tmp_path / "RUN")
    assert results_in(job._folder).trajectory.works(0.0, 0.1).values is not None
    (axes,) = figures.draw(results_in(job._folder), "energy").axes
    assert "stored" not in [line.get_label() for line in axes.lines]
