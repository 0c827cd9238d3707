"""Random scenes, one kind a file, with a time (s) in which something happens in them."""

from collections.abc import Callable
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes import (
    bristles,
    cams,
    guides,
    mechanisms,
    motors,
    other_laws,
    other_presets,
    pendulums,
    pits,
    presets,
    rotors,
    slots,
)

Random = Callable[[Draw], tuple[dict[str, Any], float]]
"""Returns the scene of a job, and a time scale, s."""

SCENES: dict[str, Random] = {
    "pendulum": presets.pendulum,
    "bouncing-journal": presets.journal,
    "slider-crank": presets.slider_crank,
    "seven-bar-press": presets.press,
    "seven-bar-press-fitted": presets.fitted_press,
    "shaken pit": pits.shaken,
    "two motors": pits.two_motors,
    "rotor": rotors.rotor,
    "loose pendulum": pendulums.loose,
    "double pendulum": pendulums.double,
    "loose slider-crank": mechanisms.slider_crank,
}
"""Scenes that the independent program knows (`benchmarks/lies/truth`)."""
OTHERS: dict[str, Random] = {
    "four-bar": other_presets.four_bar,
    "driven-pendulum": other_presets.driven_pendulum,
    "impact-oscillator": other_presets.impact_oscillator,
    "jansen-leg": other_presets.jansen_leg,
    "quick-return": other_presets.quick_return,
    "andrews-squeezer": other_presets.squeezer,
    "seven-bar-press-punching": other_presets.punching_press,
    "other laws": other_laws.loose_slider_crank,
}
"""Scenes whose truth far finer runs tell."""
LOOSE: dict[str, Random] = {
    "swung guide": guides.swung,
    "swung guide, bristles": guides.bristled,
    "slot of a rocker, bristles": slots.rocker,
    "slot of a yoke, motor": slots.yoke,
    "flat cam": cams.flat,
    "roller cam, bristles, motor": cams.roller,
    "journal, lugre": bristles.of_lugre,
    "journal, dahl": bristles.of_dahl,
    "slider-crank, guide, motor": motors.slider_crank,
}
"""Scenes with play in guides, slots, cams and bearings, with bristles and motors, at the accuracies
that a user asks for. Far finer runs tell the truth of bristles and rollers."""
EVERY = SCENES | OTHERS | LOOSE
