"""Channels: the named signals that a scene offers, with their units."""

from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase

from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.joints import Joint
from jointplay.solver.joints.joint import MOMENT, Table
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Output, Scene
from jointplay.solver.scene.pairs import pairs_of
from jointplay.solver.scene.references import inner_states
from jointplay.solver.scene.structure import per_structure

BODY = (
    ("x", "m", "position x of the centre of mass"),
    ("y", "m", "position y of the centre of mass"),
    ("theta", "rad", "angle"),
    ("vx", "m/s", "velocity x of the centre of mass"),
    ("vy", "m/s", "velocity y of the centre of mass"),
    ("omega", "rad/s", "angular velocity"),
    ("ax", "m/s^2", "acceleration x of the centre of mass"),
    ("ay", "m/s^2", "acceleration y of the centre of mass"),
    ("alpha", "rad/s^2", "angular acceleration"),
)
JOINT = (
    ("force_x", "N", "force x on the joint's second body (journal, slider, part)"),
    ("force_y", "N", "force y on the joint's second body (journal, slider, part)"),
)
POINT = (
    ("x", "m", "position x"),
    ("y", "m", "position y"),
    ("vx", "m/s", "velocity x"),
    ("vy", "m/s", "velocity y"),
)
"""Channels of points that are recorded."""
LONGEST_RECORDED = 61
"""Characters of a recorded point's reference: names of channels have 64 at most."""
PLAY = (
    ("eccentricity_x", "m", "journal centre less bearing centre, x"),
    ("eccentricity_y", "m", "journal centre less bearing centre, y"),
    ("eccentricity_rate_x", "m/s", "rate of the eccentricity, x"),
    ("eccentricity_rate_y", "m/s", "rate of the eccentricity, y"),
    ("penetration", "m", "eccentricity less radial clearance; negative apart"),
    ("normal_force", "N", "normal contact force"),
    ("friction_force", "N", "friction force on the journal along the tangent"),
    ("slip_velocity", "m/s", "slip velocity of the journal against the bearing"),
)
WALL = (
    ("penetration", "m", "depth in the wall; negative apart"),
    ("penetration_rate", "m/s", "rate of the penetration"),
    ("normal_force", "N", "normal contact force"),
    ("friction_force", "N", "friction force on the slider along the tangent"),
    ("slip_velocity", "m/s", "slip velocity of the slider against the wall"),
)
ENERGY = (("kinetic", "J", "kinetic energy"), ("potential", "J", "potential energy of gravity"))

MOST_GLOBS, MOST_UNKNOWN = 256, 32
"""Patterns that are matched, and wrong ones that are named: each is compared with all channels."""


@per_structure
def channels(scene: Scene) -> tuple[Channel, ...]:
    """Return every channel of a scene: bodies, joints, drivers, forces, points, energy, outputs.

    Raises
    ------
    InvalidInput
        A declared output of an unknown channel, a point whose channels can have no name of their
        own; pointers begin at the job.
    """
    rows: list[Channel] = []

    def add(part: str, kind: str, table: Table) -> None:
        for quantity, unit, text in table:
            rows.append(Channel(f"{part}.{quantity}", unit, f"{text} ({kind} {part})"))

    inner = inner_states(scene)
    for body in scene.bodies:
        add(body, "body", BODY)
    for name, joint in scene.joints.items():
        for table in _tables(joint):
            add(name, "joint", table)
        for pair in pairs_of(name, joint) if joint.has_play else ():
            states = inner.get(pair.name, ())
            add(pair.name, "joint", PLAY if pair.is_journal else WALL)
            add(pair.name, "joint", tuple((s.name, s.unit, s.long_name) for s in states))
    for name, gear in scene.gears.items():
        add(name, "gear", gear.channels)
    for name, driver in scene.drivers.items():
        turning = turns(scene, driver)
        kind, unit = ("torque", "N m") if turning else ("force", "N")
        rows.append(Channel(f"{name}.torque", unit, f"{kind} of driver {name}"))
        rows.append(Channel(f"{name}.power", "W", f"power of driver {name}"))
    for name, element in scene.forces.items():
        add(name, "force element", element.channels)
    rows += _recorded(scene)
    rows += [Channel(f"energy.{quantity}", unit, text) for quantity, unit, text in ENERGY]
    return (*rows, *_outputs(scene, {row.name: row.unit for row in rows}))


def _tables(joint: Joint) -> Iterator[Table]:
    """Yield the tables of a joint's own channels."""
    yield JOINT
    if joint.holds_angle or (joint.has_play and joint.has_moment):
        yield MOMENT
    if joint.ideal_channels and not joint.has_play:
        yield joint.ideal_channels


def _recorded(scene: Scene) -> list[Channel]:
    """Return the channels of recorded points."""
    taken = {quantity for quantity, _, _ in BODY}
    problems = []
    for index, reference in enumerate(scene.recorded):
        pointer = f"/scene/recorded/{index}"
        if reference.split(".")[1] in taken:
            sentence = f"'{reference}' is a channel of the body, too; give the point another name."
            problems.append(Problem(pointer, sentence))
        elif len(reference) > LONGEST_RECORDED:
            sentence = (
                f"'{reference}' has {len(reference)} characters, but body and point may have"
                f" {LONGEST_RECORDED} together; give shorter names."
            )
            problems.append(Problem(pointer, sentence))
    if problems:
        raise InvalidInput(problems)
    return [
        Channel(f"{point}.{quantity}", unit, f"{text} (point {point})")
        for point in scene.recorded
        for quantity, unit, text in POINT
    ]


def _outputs(scene: Scene, units: dict[str, str]) -> list[Channel]:
    """Return the channels of declared outputs; `units` are those of all other channels."""
    rows, problems = [], []
    for index, output in enumerate(scene.outputs):
        if output.channel not in units:
            sentence = unknown("channel", output.channel, units)
            for point in recording(scene, [output.channel])[len(scene.recorded) :]:
                sentence = f"'{output.channel}' is a channel where 'recorded' lists '{point}'."
            problems.append(Problem(f"/scene/outputs/{index}/channel", sentence))
            continue
        text = output.help or _formula(output)
        rows.append(Channel(output.name, units[output.channel], text))
    if problems:
        raise InvalidInput(problems)
    return rows


def _formula(output: Output) -> str:
    """Return an output as a formula, such as ``-2 slider.x + 0.1``."""
    times = {1.0: "", -1.0: "-"}.get(output.factor, f"{output.factor:g} ")
    offset = f" {'-' if output.offset < 0 else '+'} {abs(output.offset):g}" if output.offset else ""
    return f"{times}{output.channel}{offset}"


def recording(scene: Scene, names: Iterable[str]) -> list[str]:
    """Return the points that a scene records once those of these channels are, too."""
    found = dict.fromkeys(scene.recorded)
    quantities = {quantity for quantity, _, _ in POINT}
    for name in names:
        point, _, quantity = name.rpartition(".")
        body, _, own = point.partition(".")
        if quantity in quantities and body in scene.bodies and own in scene.bodies[body].points:
            found[point] = None
    return list(found)


def select(offered: tuple[Channel, ...], patterns: list[str], pointer: str) -> tuple[Channel, ...]:
    """Return the channels that names or globs choose, in the order of the scene.

    Raises
    ------
    InvalidInput
        A pattern that chooses nothing, or more than `MOST_GLOBS` patterns that are no names.
    """
    names = [channel.name for channel in offered]
    known, chosen = set(names), set[str]()
    problems = []
    globs = 0
    for index, pattern in enumerate(patterns):
        if pattern in known:
            chosen.add(pattern)
            continue
        globs += 1
        matched = names if pattern == "*" else [n for n in names if fnmatchcase(n, pattern)]
        chosen.update(matched)
        if globs > MOST_GLOBS:
            sentence = f"At most {MOST_GLOBS} of the channels may be patterns; give names instead."
            raise InvalidInput.at(pointer, sentence)
        if not matched:
            sentence = unknown("channel", pattern, names)
            problems.append(Problem(f"{pointer}/{index}", sentence))
            if len(problems) == MOST_UNKNOWN:
                break
    if problems:
        raise InvalidInput(problems)
    return tuple(channel for channel in offered if channel.name in chosen)
