"""Claims about extremes at kinks that lie next to where a step begins or ends."""

from benchmarks.lies.named.lie import Lie, by_extremes
from benchmarks.lies.scenes.bearing import play
from benchmarks.lies.scenes.mechanisms import loose_slider_crank

BEND = {
    "kind": "simulate",
    "scene": loose_slider_crank(
        (0.198938045412, 0.710302073295149),
        1.13888441003,
        [
            play(
                0.0015172402830648175,
                0.005320329586446393,
                (185111675.241, 0.152286504311),
                (0.0128855955974, 3.17133373541e-05, 0.0),
            ),
            play(
                0.001170821335801322,
                0.006447208189871751,
                (2911402427.03, 0.465705599551),
                (0.0245819062055, 0.0292822998783, 0.0),
            ),
        ],
        {"position": 5.39006396388, "speed": 14.8106935725},
    ),
    "duration": 0.013324093803534803,
    "method": "rk4",
    "step": 7.390263732754539e-05,
}
"""Friction bends half a hundredth of a step of fixed length behind its start."""
RELEASE = {
    "kind": "simulate",
    "scene": {
        "name": "double-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "wall": [0.3, 0.6]}},
        "bodies": {
            "upper": {
                "mass": 0.46550849032,
                "inertia": 0.0013810838014061367,
                "points": {"a": [-0.0843559232622, 0.0], "b": [0.0843559232622, 0.0]},
            },
            "lower": {
                "mass": 1.11572466409,
                "inertia": 0.02500196799803979,
                "points": {"a": [-0.336654108489, 0.0], "b": [0.336654108489, 0.0]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "upper.a"},
            "P": {
                "type": "revolute",
                "bearing": "upper.b",
                "journal": "lower.a",
                "clearance": {
                    "radial_clearance": 0.000304192062619,
                    "bearing_radius": 0.009523037359214835,
                    "contact": {
                        "law": "lankarani-nikravesh",
                        "stiffness": 11103788.6786,
                        "restitution": 0.226391129419,
                    },
                    "friction": {
                        "law": "modified-coulomb",
                        "coefficient": 0.118859472076,
                        "dynamic_velocity": 8.61255762227e-05,
                        "static_velocity": 7.751301860043001e-05,
                    },
                },
            },
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.wall",
                "second": "lower.b",
                "stiffness": 1.26157608538,
                "damping": 0.0211176622966,
                "free_length": 0.842247712201,
            }
        },
        "start": {
            "angles": {"upper": -0.265919929053, "lower": 1.68046328038},
            "angular_velocities": {"upper": 1.65718647424, "lower": -0.295870674626},
        },
    },
    "duration": 0.0536235869769,
    "method": "bogacki-shampine",
    "tolerance": 6.789e-05,
}
"""A contact ends a fiftieth of a step before its end."""
FORETOLD = {
    "kind": "simulate",
    "scene": {
        "name": "double-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "wall": [0.3, 0.6]}},
        "bodies": {
            "upper": {
                "mass": 0.258261362143,
                "inertia": 0.012656073105155609,
                "points": {"a": [-0.354941058146, 0.0], "b": [0.354941058146, 0.0]},
            },
            "lower": {
                "mass": 7.09873826111,
                "inertia": 0.6279223507320681,
                "points": {"a": [-0.460637883069, 0.0], "b": [0.460637883069, 0.0]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "upper.a"},
            "P": {
                "type": "revolute",
                "bearing": "upper.b",
                "journal": "lower.a",
                "clearance": play(
                    0.00443106232033,
                    0.014042106751075088,
                    (19368492.0698, 0.673598450799),
                    (0.353867692659, 0.0797530368444, 0.007975303684439999),
                ),
            },
        },
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.wall",
                "second": "lower.b",
                "stiffness": 5.49911348165,
                "damping": 1.21995549584,
                "free_length": 0.617658794832,
            }
        },
        "start": {
            "angles": {"upper": -1.4739465516, "lower": 1.31986703086},
            "angular_velocities": {"upper": -0.0594691647228, "lower": 0.0938380887125},
        },
    },
    "duration": 0.04,
    "method": "dormand-prince-853",
    "tolerance": 0.000177772,
}
"""A long step in contact, whose force bends more at its end than five nodes tell."""
FORETOLD_TOO_HIGH = Lie(
    "pendulum, an extreme that was not evaluated",
    "a force was 1.5e-6 higher than it is anywhere",
    lambda: by_extremes(FORETOLD),
)

LIES = (
    Lie("slider-crank, a bend behind a step's start", "1.3e-3 off", lambda: by_extremes(BEND)),
    Lie("pendulum, a release before a step's end", "2.4e-6 off", lambda: by_extremes(RELEASE)),
    FORETOLD_TOO_HIGH,
)
