"""Claims about extremes at kinks that lie next to where a step begins or ends."""

from benchmarks.lies.named.lie import Lie, by_extremes
from benchmarks.lies.scenes.bearing import play
from benchmarks.lies.scenes.mechanisms import loose_slider_crank
from benchmarks.lies.scenes.pendulums import double_pendulum, rod

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
    "scene": double_pendulum(
        (
            rod(0.0843559232622, 0.46550849032, 0.0013810838014061367),
            rod(0.336654108489, 1.11572466409, 0.02500196799803979),
        ),
        play(
            0.000304192062619,
            0.009523037359214835,
            (11103788.6786, 0.226391129419),
            (0.118859472076, 8.61255762227e-05, 7.751301860043001e-05),
        ),
        (1.26157608538, 0.0211176622966, 0.842247712201),
        (-0.265919929053, 1.68046328038),
        (1.65718647424, -0.295870674626),
    ),
    "duration": 0.0536235869769,
    "method": "bogacki-shampine",
    "tolerance": 6.789e-05,
}
"""A contact ends a fiftieth of a step before its end."""
FORETOLD = {
    "kind": "simulate",
    "scene": double_pendulum(
        (
            rod(0.354941058146, 0.258261362143, 0.012656073105155609),
            rod(0.460637883069, 7.09873826111, 0.6279223507320681),
        ),
        play(
            0.00443106232033,
            0.014042106751075088,
            (19368492.0698, 0.673598450799),
            (0.353867692659, 0.0797530368444, 0.007975303684439999),
        ),
        (5.49911348165, 1.21995549584, 0.617658794832),
        (-1.4739465516, 1.31986703086),
        (-0.0594691647228, 0.0938380887125),
    ),
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
