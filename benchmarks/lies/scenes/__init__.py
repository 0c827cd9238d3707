"""Random scenes, one kind a file, with a time (s) in which something happens in them."""

from collections.abc import Callable
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes import (
    mechanisms,
    other_laws,
    other_presets,
    pendulums,
    pits,
    presets,
    rotors,
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
