"""Claims about extremes in steps that an explicit method takes at its limit of stability."""

from typing import Any

from benchmarks.lies.named.lie import Lie, by_extremes
from benchmarks.lies.scenes.bearing import play
from benchmarks.lies.scenes.mechanisms import loose_slider_crank
from benchmarks.lies.scenes.pits import ring_on_pin


def _press(duration: float, tolerance: float, parameters: dict[str, Any]) -> dict[str, Any]:
    return {
        "kind": "simulate",
        "scene": {"preset": "seven-bar-press", "parameters": parameters},
        "duration": duration,
        "method": "bogacki-shampine",
        "tolerance": tolerance,
    }


IN_TURN = _press(
    0.0008715456654689208,
    9.59479e-07,
    {
        "clearance_A": 0.000113489851789,
        "clearance_B": 0.000147200650089,
        "bearing_radius": 0.00033021274840164955,
        "speed": 17.6033122042,
        "speed_crank4": 528.0993661260001,
        "gravity_x": 9.81,
        "slip_velocity": "material",
        "stiffness": 20047939647.1,
        "restitution": 0.467237508076,
        "friction": 0.218761299636,
        "dynamic_velocity": 0.0205663140769,
        "static_velocity": 0.01028315703845,
    },
)
"""Every other step dips, and those between top."""
ZIGZAG = _press(
    0.0011156488175746288,
    6.34674e-10,
    {
        "clearance_A": 0.000422299057635,
        "clearance_B": 0.0012555490713,
        "bearing_radius": 0.006697675356258422,
        "speed": 7.16003102622,
        "speed_crank4": 214.80093078660002,
        "gravity_x": 0.0,
        "slip_velocity": "as-published",
        "stiffness": 2234991081.03,
        "restitution": 0.179194832564,
        "friction": 0.0883620422277,
        "dynamic_velocity": 2.68403448946e-05,
        "static_velocity": 2.6840344894600004e-06,
    },
)
"""Values at the ends of steps go up and down, by less than a step's tolerance."""

UNSEEN = {
    "kind": "simulate",
    "scene": loose_slider_crank(
        (0.0753861417079, 0.33065378615943863),
        0.535116612675,
        [
            play(
                0.0008075013059807292,
                0.0012931766716825813,
                (460857331.383, 0.814753199506),
                (0.497650786382, 0.000562720140969, 5.6272014096900004e-05),
            ),
            play(
                0.00012658328375616385,
                0.0006029538832743327,
                (2233782336.01, 0.707905631324),
                (0.117584055339, 0.00783245909606, 0.000783245909606),
            ),
        ],
        {"position": 1.30469095855, "speed": 235.967959873},
    ),
    "duration": 0.01851153217725391,
    "method": "tsitouras",
    "tolerance": 3.19326e-06,
}
"""Steps swing but rise by more, until they rise by less and go beyond their ends."""

PRESSED = {
    "kind": "simulate",
    "scene": ring_on_pin(
        0.0,
        4.487211850700405e-05,
        (7.49492936699, 0.00643697003054),
        play(
            0.00021707620357,
            0.0008914706873086226,
            (52055833952.8, 0.682857879072),
            (0.266012775526, 0.000167928114561, 0.0),
        ),
        (2.43974785372, 425.541297052),
        {
            "velocity": [-0.0883907196678, 0.1],
            "angular_velocity": 37.6958944876,
            "eccentricity": [-1.0343543700338162e-05, 2.0687087400676323e-05],
        },
    ),
    "duration": 0.05267431651424641,
    "method": "tsitouras",
    "tolerance": 2.42899e-05,
}
"""A ring is pressed on a pin: where its energy is greatest, it swings by 4e-6 of its range."""

REVERSED = {
    "kind": "simulate",
    "scene": {
        "preset": "slider-crank",
        "parameters": {
            "clearance": 0.000506364768885,
            "bearing_radius": 0.0018548815112601532,
            "speed": 270.194620164,
            "stiffness": 346173857688.0,
            "restitution": 0.181834263954,
            "friction": 0.0651503298189,
            "dynamic_velocity": 0.000176076587404,
            "static_velocity": 0.0,
        },
    },
    "duration": 0.0005837020676780051,
    "method": "tsitouras",
    "tolerance": 1.35474e-05,
}
"""Friction reverses at a stage that counts for half of a step, and for nothing in its error."""

LIES = (
    Lie("press, steps that swing in turn", "7.2e-6 too low", lambda: by_extremes(IN_TURN)),
    Lie("press, a zigzag of step ends", "6.2e-6 too low", lambda: by_extremes(ZIGZAG)),
    Lie("slider-crank, swings that rises hide", "2.6e-5 too high", lambda: by_extremes(UNSEEN)),
    Lie("ring on a pin, a swing at the top", "1.8e-6 too low", lambda: by_extremes(PRESSED)),
    Lie(
        "slider-crank, friction that reverses at one stage",
        "5.4e-4 too high",
        lambda: by_extremes(REVERSED),
    ),
)
