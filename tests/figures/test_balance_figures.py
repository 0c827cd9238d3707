"""Figures that sum up a run: loads by direction, loops, the ledger, histograms, x against y."""

from dataclasses import replace

import numpy as np
import pytest
from closed_form_motion import SCENE, closed_form_motion

from jointplay import figures
from jointplay.figures import NotDrawable, Selection
from jointplay.figures.bearing_angles import loads
from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.run import Dataset

MOTION = closed_form_motion()
LEFT = Selection(joints=("left",))


def pressed(angle, force, turning=0.0, contacts=()):
    """A journal at an angle(t) [rad] of the world, in a bearing on a crank that turns."""
    time = np.linspace(0.0, 1.0, 1001)
    values = {
        "left.eccentricity_x": 5e-4 * np.cos(angle(time)),
        "left.eccentricity_y": 5e-4 * np.sin(angle(time)),
        "left.normal_force": force(time),
        "crank.theta": turning * time,
    }
    rows = np.zeros(len(contacts), IMPACT)
    for row, (onset, peak, impulse) in zip(rows, contacts, strict=True):
        row["onset"], row["release"] = onset, onset + 1e-4
        row["peak_force"], row["impulse"] = peak, impulse
    channels = [Channel(name, "1") for name in values]
    return Dataset({"scene": SCENE}, channels, time, values, contacts=rows, joints=("left",))


def test_a_force_that_goes_round_loads_every_direction_alike():
    round_once = pressed(lambda t: 2.0 * np.pi * t, lambda t: 36.0 + 0.0 * t)
    found = loads(round_once, "left", Selection(), 36)
    np.testing.assert_allclose(found.mean, 1.0, rtol=0.1)  # some 28 samples in a sector
    assert found.mean.sum() == pytest.approx(36.0)
    np.testing.assert_array_equal(found.largest, 36.0)


def test_directions_are_those_of_the_bearing_that_turns():
    fixed_in_it = pressed(lambda t: 2.0 * np.pi * t + 0.1, lambda t: 5.0 + 0.0 * t, 2.0 * np.pi)
    found = loads(fixed_in_it, "left", Selection(), 36)
    assert found.mean[0] == pytest.approx(5.0)
    assert not found.mean[1:].any()


def test_contacts_between_samples_count_with_impulse_and_peak():
    quiet = pressed(lambda t: np.pi * t, lambda t: 0.0 * t, contacts=[(0.2503, 900.0, 0.05)])
    found = loads(quiet, "left", Selection(), 36)
    struck = int(0.2503 * 18.0)  # sectors of ten degrees, half a turn a second
    assert found.largest[struck] == 900.0
    assert found.mean[struck] == pytest.approx(0.05)
    assert found.mean.sum() == pytest.approx(0.05)


def test_a_rose_has_a_sector_as_long_as_the_force_in_it():
    left, right = figures.draw(MOTION, "force-rose", LEFT).axes
    found = loads(MOTION, "left", Selection(), 36)
    for axes, forces in ((left, found.mean), (right, found.largest)):
        np.testing.assert_allclose([bar.get_height() for bar in axes.patches], forces)
    assert [axes.get_title("left") for axes in (left, right)] == [
        "left: mean force [N]",
        "left: largest force [N]",
    ]


def test_a_rose_has_a_number_of_newtons_whatever_its_size():
    for force in np.geomspace(1.0, 10.0, 30):
        rose = pressed(lambda t: np.pi * t, lambda t, force=force: force + 0.0 * t)
        _, right = figures.draw(rose, "force-rose", LEFT).axes
        assert len(right.get_yticks())


def test_a_loop_shows_one_contact_and_the_energy_that_it_took():
    first, _ = figures.draw(MOTION, "impact-loop").axes
    loading, unloading = first.lines
    x = np.concatenate([loading.get_xdata()[:-1], unloading.get_xdata()])
    y = np.concatenate([loading.get_ydata()[:-1], unloading.get_ydata()])
    inside = (MOTION.time >= 0.0) & (MOTION.time <= np.pi / 9.0)
    np.testing.assert_allclose(x[1:-1], MOTION.values["left.penetration"][inside] * 1e6)
    np.testing.assert_allclose(y[1:-1], MOTION.values["left.normal_force"][inside])
    # the loop of F sin(wt) over d sin(wt - a), closed by short lines: about half of pi F d sin(a)
    taken = float(first.get_title("left").split()[-3])
    assert taken == pytest.approx(0.5 * np.pi * 60.0 * 2e-6 * np.sin(0.2) * 1e6, rel=0.2)  # µJ


def test_a_contact_that_samples_step_over_is_refused_with_what_would_show_it():
    with pytest.raises(NotDrawable, match="output_step of 4e-07 s") as caught:
        figures.draw(MOTION, "impact-loop", Selection(start=0.001))
    assert caught.value.cause == "start"
    short = replace(MOTION, contacts=MOTION.contacts[:60])
    assert "impact-loop" not in [listed.name for listed in figures.available(short)]


def test_the_terms_of_the_energy_ledger_balance_at_every_time():
    (axes,) = figures.draw(MOTION, "energy").axes
    curves = {line.get_label(): line.get_ydata() for line in axes.lines}
    time = MOTION.time
    np.testing.assert_allclose(curves["drivers"], 3.0 * time, atol=1e-12)
    np.testing.assert_allclose(curves["gravity"], -5.0 * time, atol=1e-12)
    np.testing.assert_allclose(curves["kinetic energy"], np.sin(np.pi * time), atol=1e-12)
    lost = curves["drivers"] + curves["gravity"] - curves["kinetic energy"]
    np.testing.assert_allclose(curves["contacts, friction, elements"], lost, atol=1e-12)


def test_rounding_of_energies_that_stay_is_no_curve():
    noise = 1e-15 * np.sin(1e3 * MOTION.time)
    still = {"energy.kinetic": 5.0 + noise, "energy.potential": -2.0 + noise}
    at_rest = replace(MOTION, values=dict(MOTION.values) | still | {"motor.power": noise})
    (axes,) = figures.draw(at_rest, "energy").axes
    assert not any(np.any(line.get_ydata()) for line in axes.lines)
    assert axes.get_ylabel() == "energy [J]"


def test_the_ledger_at_the_end_is_marked_on_a_whole_run_only():
    energy = {"driver_work": 6.1, "gravity_work": -10.0, "kinetic_change": 0.2, "residual": -1e-7}
    scene = MOTION.attributes["scene"]
    known = replace(MOTION, attributes={"scene": scene, "summary": {"energy": energy}})
    (axes,) = figures.draw(known, "energy").axes
    rings = [float(line.get_ydata()[0]) for line in axes.lines if line.get_marker() == "o"]
    assert rings == pytest.approx([6.1, -10.0, 0.2, -4.1])
    (axes,) = figures.draw(known, "energy", Selection(stop=1.0)).axes
    assert not [line for line in axes.lines if line.get_marker() == "o"]


def test_a_histogram_is_the_density_of_the_samples():
    (axes,) = figures.draw(MOTION, "histogram", Selection(channels=("stroke",))).axes
    (stairs,) = axes.patches
    heights, edges, _ = stairs.get_data()
    assert float(np.sum(heights * np.diff(edges))) == pytest.approx(1.0)
    expected, _ = np.histogram(MOTION.values["stroke"], edges, density=True)
    np.testing.assert_allclose(heights, expected)


def test_any_channel_is_drawn_against_any_other():
    names = ("left.normal_force", "block.x", "energy.kinetic")
    chosen = figures.select(MOTION, names)
    assert chosen == Selection(channels=names)
    panels = figures.draw(MOTION, "xy", chosen).axes
    for axes, name in zip(panels, chosen.channels[1:], strict=True):
        x, y = axes.lines[0].get_data()
        np.testing.assert_array_equal(x, MOTION.values["left.normal_force"])
        np.testing.assert_array_equal(y, MOTION.values[name])
    with pytest.raises(NotDrawable, match="two channels at least"):
        figures.draw(MOTION, "xy", Selection(channels=("block.x",)))


def test_a_figure_with_a_fault_is_left_out_of_lists_and_logged(monkeypatch, caplog):
    def fault(source, selection):
        return np.concatenate([])

    listed = [one.name for one in figures.available(MOTION)]
    faulty = replace(figures.RUN_FIGURES["orbit"], channels=fault)
    monkeypatch.setitem(figures.RUN_FIGURES, "orbit", faulty)
    assert [one.name for one in figures.available(MOTION)] == [n for n in listed if n != "orbit"]
    assert "orbit" in caplog.text
    assert "concatenate" in caplog.text
