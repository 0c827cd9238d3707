"""Checks of the mechanism that every kind of job shares: its parameters, references, assembly."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import Any

from pydantic import ValidationError

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kernels.trace.length import check_length
from jointplay.solver.kinds.job import MechanismJob, PresetScene
from jointplay.solver.kinds.redundant import (
    check_drivers,
    check_redundant,
    closes,
    redundant_while_held,
)
from jointplay.solver.mechanics.assembly import Assembly, assemble, directionless, undecided
from jointplay.solver.mechanics.open_joint import open_joint
from jointplay.solver.mechanics.tree import Tree, spanning_tree
from jointplay.solver.scene import presets
from jointplay.solver.scene.channels import channels, recording
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.domains import domain_problems
from jointplay.solver.scene.parameters import parameter_of, set_parameters
from jointplay.solver.scene.references import idle_fields, part_problems, reference_problems
from jointplay.solver.scene.reported import reported_problems
from jointplay.solver.scene.sentences import schema_problems
from jointplay.solver.scene.start_numbers import with_start_numbers

MOST_BODIES = 8
"""Bodies up to which it is sought where a mechanism opens; of more the time would be felt."""

Echo = dict[str, float | str | None]
"""The value of every declared parameter; none where the document's own values stand."""

Written = tuple[dict[str, Any], Scene, Mapping[str, float | str | None]]
"""A scene as a job writes it: document, parsed, and the parameters that are given."""


def written(job: MechanismJob) -> Written:
    """Return a job's scene as it is written, whose points that the job names are recorded.

    Whether its parts fit together is not checked.
    """
    given: Mapping[str, float | str | None] = {}
    if isinstance(job.scene, PresetScene):
        (document, scene), given = _preset(job.scene.preset), job.scene.parameters
    else:
        document, scene = job.scene.model_dump(mode="json"), job.scene
    recorded = recording(scene, job.named_channels)
    if recorded != scene.recorded:
        document = document | {"recorded": recorded}
        scene = scene.model_copy(update={"recorded": recorded})
    if job.varied_starts:
        document, scene = with_start_numbers(document, scene, job.varied_starts)
    return document, scene, given


def declared(job: MechanismJob) -> Written:
    """Return a job's scene as it is written, once its parts fit together.

    Raises
    ------
    InvalidInput
        Unknown preset; parts of the scene that do not fit together.
    """
    if not isinstance(job.scene, PresetScene):
        problems = list(reference_problems(job.scene)) or list(reported_problems(job.scene))
        if problems:
            raise InvalidInput(Problem(f"/scene{p.pointer}", p.detail) for p in problems)
    return written(job)


@cache
def _preset(name: str) -> tuple[dict[str, Any], Scene]:
    document = presets.document(name)
    return document, Scene.model_validate(document)


def resolve(job: MechanismJob) -> tuple[Scene, dict[str, Any], Echo]:
    """Return what `with_parameters` does of a job's scene; raises what `declared` does, too."""
    return with_parameters(*declared(job))


def with_parameters(
    document: Mapping[str, Any], scene: Scene, values: Mapping[str, float | str | None]
) -> tuple[Scene, dict[str, Any], Echo]:
    """Return a scene with parameters set, its document, and every parameter's value.

    Raises
    ------
    InvalidInput
        Unknown parameter, values that do not fit the scene; at the parameter where there is one.
    """
    filled, echo = set_parameters(document, scene, values)
    try:
        found = Scene.model_validate(filled)
    except ValidationError as error:
        raise InvalidInput(_located(schema_problems(error, Scene, filled), scene, echo)) from None
    problems = list(part_problems(found))  # its parameters are those of the scene as written
    for path, _, sentence in idle_fields(found):
        name = parameter_of(scene, echo, path)
        if name is not None and values.get(name) not in (None, scene.parameters[name].default):
            problems.append(Problem(path, sentence))
    if problems:
        raise InvalidInput(_located(problems, scene, echo))
    return found, filled, echo


def check(scene: Scene, formulation: str | None = None) -> tuple[Tree, Assembly]:
    """Return a scene's spanning tree and assembly once it can be simulated.

    Raises
    ------
    LimitExceeded
        Its equations in this formulation, if one is given, are too long to compile.
    InvalidInput
        Functions that refuse t = 0, redundant constraints, an assembly that cannot close, a start
        where assemblies meet, play where nothing is free to move.
    """
    channels(scene)  # outputs of channels that there are not, before equations compute them
    nowhere = list(domain_problems(scene, 0.0))
    if nowhere:  # drivers that do not say where they begin
        raise InvalidInput(nowhere)
    tree = spanning_tree(scene)
    if formulation is not None and tree.coordinates and not tree.closing:
        check_length(scene, tree, formulation)  # first: the assembly of many bodies takes longer
    anywhere = undecided(scene)
    if anywhere:
        raise InvalidInput(_of_undecided(name, scene) for name in anywhere)
    assembly = assemble(scene)
    coordinates = 3 * len(scene.bodies)
    only_held = redundant_while_held(scene, assembly)
    is_closed = closes(scene)
    if assembly.constraints > coordinates and not assembly.freedom and not is_closed:
        check_drivers(scene)
        raise InvalidInput.at(
            "/scene/joints",
            f"The mechanism is over-constrained: {assembly.constraints} constraint"
            f" equations hold {coordinates} coordinates; remove a joint or a driver.",
        )
    if not is_closed:
        raise InvalidInput(_open(scene))
    problems = [*_without_direction(scene, assembly), *_unheld_bodies(scene, tree)]
    if problems:
        raise InvalidInput(problems)
    if (assembly.redundant_with_play or assembly.redundant) and not only_held:
        check_redundant(scene, assembly)
    problems = [] if assembly.freedom_with_play else list(_without_freedom(scene))
    if problems:
        raise InvalidInput(problems)
    if formulation is not None and tree.closing and assembly.freedom_with_play:
        check_length(scene, tree, formulation)
    return tree, assembly


def _open(scene: Scene) -> list[Problem]:
    """Return why a mechanism does not close: because of where its joints start, or anyway."""
    start = scene.start
    offsets = {
        f"joints/{name}/eccentricity": any(one.eccentricity) for name, one in start.joints.items()
    }
    for name, guided in start.guides.items():
        offsets |= {
            f"guides/{name}/{field}": getattr(guided, field) for field in ("offset", "tilt")
        }
    centred = start.model_copy(update={"joints": {}, "guides": {}})
    if any(offsets.values()) and closes(scene.model_copy(update={"start": centred})):
        return [
            Problem(
                f"/scene/start/{pointer}",
                "The mechanism closes with its play centred, but does not reach this"
                f" {pointer.rpartition('/')[2]}; give a smaller one, or another direction.",
            )
            for pointer, offset in offsets.items()
            if offset
        ]
    sentence = (
        f"The mechanism does not close: {_left_open(scene)}. Check lengths and driver positions,"
        " or give start angles nearer to the assembly you mean."
    )
    return [Problem("/scene/start/angles", sentence)]


def _of_undecided(name: str, scene: Scene) -> Problem:
    first, second = scene.joints[name].points
    return Problem(
        "/scene/start/points",
        f"'{second}' of joint '{name}' begins where '{first}' is, and may go to any side of it."
        f" Say to which: give a position of '{second}'.",
    )


def _unheld_bodies(scene: Scene, tree: Tree) -> Iterator[Problem]:
    """Yield the bodies that nothing holds."""
    pairs = [(force.first, force.second) for force in scene.forces.values()]
    between = [name for name in (*tree.closing, *tree.play) if name in scene.joints]
    pairs += [scene.joints[name].points for name in between]
    held = {branch.parent for branch in tree.branches} | {_body(p) for pair in pairs for p in pair}
    for branch in tree.branches:
        if branch.freedom == "all" and branch.body not in held:
            yield Problem(
                f"/scene/bodies/{branch.body}",
                f"No joint holds body '{branch.body}' and no force does; join it or drop it.",
            )


def _without_direction(scene: Scene, assembly: Assembly) -> Iterator[Problem]:
    """Yield the forces whose points coincide at the start."""
    for name in directionless(scene, assembly.pose):
        yield Problem(
            f"/scene/forces/{name}",
            f"The points of '{name}' coincide at the start, where its force has no direction; start"
            " them apart, or let it be zero there: a spring without free length, a tension over the"
            " distance whose course begins at 0.",
        )


def _without_freedom(scene: Scene) -> Iterator[Problem]:
    """Yield the joints with play, of a scene in which nothing is free to move."""
    for name, joint in scene.joints.items():
        if joint.has_play:
            yield Problem(
                f"/scene/joints/{name}/clearance",
                "Drivers and ideal joints leave nothing free to move, so that the contacts of"
                f" joint '{name}' cannot be integrated. Let something move: drive through a spring,"
                " or add a body on a pin of its own.",
            )


def _left_open(scene: Scene) -> str:
    if len(scene.bodies) > MOST_BODIES:
        return f"{assemble(scene).residual:.3g} (m or rad) remain after Newton's iteration"
    left = open_joint(scene)
    return (
        f"{left.size:.3g} {left.unit} remain open at joint '{left.joint}', where the others are"
        " closed"
    )


def _located(
    problems: Iterable[Problem], scene: Scene, echo: Mapping[str, float | str | None]
) -> list[Problem]:
    """Point at the parameter that put a value there, where there is one."""
    located = []
    for problem in problems:
        name = parameter_of(scene, echo, problem.pointer)
        pointer = f"/scene/parameters/{name}" if name else f"/scene{problem.pointer}"
        if Problem(pointer, problem.detail) not in located:
            located.append(Problem(pointer, problem.detail))
    return located


def _body(reference: str) -> str:
    return reference.split(".")[0]
