"""Random scenes, one kind a file, with a time (s) in which something happens in them."""

from collections.abc import Callable
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes import mechanisms, pendulums, pits, presets, rotors

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
