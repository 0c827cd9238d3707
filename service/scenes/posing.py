"""`python -m jointplay.service.scenes.posing FD`: poses scenes that it receives, until idle.

It also tells the channels of a scene, and where its sections may be taken.
"""

import json
from functools import lru_cache
from typing import Annotated, Any, TypeVar

import numpy as np
from pydantic import Field, ValidationError

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput
from jointplay.records.strict_json import parse
from jointplay.service.questions import answer_or_refuse
from jointplay.solver.joints.curves import joint_curves
from jointplay.solver.kinds.assembled import resolved_scene
from jointplay.solver.kinds.proposed_sections import proposed_sections
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.dragging import drag
from jointplay.solver.quantities.units import Angle, Coordinate, PointReference, Strict, quantity
from jointplay.solver.runs.ideal.following import follow
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers_time import drivers_time
from jointplay.solver.scene.pairs import pairs_of
from jointplay.solver.scene.periods import common_period
from jointplay.solver.scene.sentences import schema_problems
from jointplay.solver.scene.time_scales import characteristic_time

_IDLE = 300.0  # s; it is small, and a page that is open soon asks again
MOST_TURNS = 20.0
"""Times of the quickest driver after which a slower one is not waited for, to be looked at."""
_KEPT = 16  # scenes; somebody who drags a point asks about one again and again
_GIVEN = Field(description="A preset with parameters, or a scene document, as a job has it.")

Pose = tuple[Coordinate, Coordinate, Angle]


class PosesQuestion(Strict):
    """A scene, and instants at which its pose is wanted."""

    scene: Annotated[dict[str, Any], _GIVEN]
    times: Annotated[
        list[Annotated[float, quantity("s", ge=0.0, le=1e9)]],
        Field(min_length=1, max_length=512, description="Instants, the earliest first."),
    ] = [0.0]


class DragQuestion(Strict):
    """A scene, and a point of a body that is pulled to a position while the drivers let go."""

    scene: Annotated[dict[str, Any], _GIVEN]
    point: Annotated[PointReference, Field(description="What is pulled, body.point.")]
    position: Annotated[
        tuple[Coordinate, Coordinate], Field(strict=False, description="To where, x and y in m.")
    ]
    pose: Annotated[
        dict[str, Annotated[Pose, Field(strict=False)]] | None,
        Field(
            description="Pose from which it is pulled: x, y (m) and theta (rad) of every body; that"
            " at t = 0 if it is not given."
        ),
    ] = None


class ChannelsQuestion(Strict):
    """A scene whose channels are wanted."""

    scene: Annotated[dict[str, Any], _GIVEN]


Question = TypeVar("Question", PosesQuestion, DragQuestion, ChannelsQuestion)


def poses(document: Any) -> dict[str, Any]:
    """Return the poses that a `PosesQuestion` asks for, as JSON has them."""
    question = _parsed(PosesQuestion, document)
    for i, (before, after) in enumerate(zip(question.times, question.times[1:], strict=False)):
        if after < before:
            sentence = f"'times' must not fall; {after:g} s comes behind {before:g} s."
            raise InvalidInput.at(f"/times/{i + 1}", sentence)
    scene = _scene(question.scene)
    found = follow(scene, question.times)
    own, lost = drivers_time(scene, shortest_link(scene)), found.lost
    latest = 0.0 if own is None else MOST_TURNS * own.quickest
    return {
        "scene": scene.name,
        "times": question.times[: len(found.poses)],
        "poses": [_by_body(scene, pose) for pose in found.poses],
        "curves": joint_curves(scene.joints),
        "residual": assemble(scene).residual,
        "drivers_time": None if own is None else min(own.seconds, latest),
        "repeats": own is not None and own.repeats and own.seconds <= latest,
        "stopped": None if lost is None else {"time": lost.time, "detail": lost.detail},
    }


def dragged(document: Any) -> dict[str, Any]:
    """Return the pose that a `DragQuestion` asks for, as JSON has it."""
    question = _parsed(DragQuestion, document)
    scene = _scene(question.scene)
    body, point = question.point.split(".")
    if body not in scene.bodies or point not in scene.bodies[body].points:
        raise InvalidInput.at("/point", f"There is no point '{question.point}' of a body.")
    start = assemble(scene).pose
    if question.pose is not None:
        if set(question.pose) != set(scene.bodies):
            bodies = ", ".join(scene.bodies)
            raise InvalidInput.at("/pose", f"A pose gives x, y and theta of each of {bodies}.")
        start = np.array([question.pose[name] for name in scene.bodies], np.float64).ravel()
    found = drag(scene, start, question.point, question.position)
    return {"scene": scene.name, "pose": _by_body(scene, found)}


def offered(document: Any) -> dict[str, Any]:
    """Return the channels, contacts and sections that a `ChannelsQuestion` asks for."""
    scene = _scene(_parsed(ChannelsQuestion, document).scene)
    own = common_period(scene).seconds
    return {
        "scene": scene.name,
        "channels": [
            {"name": one.name, "unit": one.unit, "help": one.long_name} for one in channels(scene)
        ],
        "contacts": [
            pair.name for name, joint in scene.joints.items() for pair in pairs_of(name, joint)
        ],
        "period": characteristic_time(scene, shortest_link(scene)) if own is None else own,
        "sections": [section.model_dump() for section in proposed_sections(scene)],
    }


def _parsed(model: type[Question], document: Any) -> Question:
    try:
        return model.model_validate(document)
    except ValidationError as error:
        raise InvalidInput(schema_problems(error, model, document)) from None


def _scene(document: dict[str, Any]) -> Scene:
    return _resolved(json.dumps(document))


@lru_cache(maxsize=_KEPT)
def _resolved(text: str) -> Scene:
    return resolved_scene(json.loads(text))


def _by_body(scene: Scene, pose: Floats) -> dict[str, list[float]]:
    return dict(zip(scene.bodies, pose.reshape(-1, 3).tolist(), strict=True))


_ANSWERS = {"poses": poses, "drag": dragged, "channels": offered}


def posed(what: str, body: bytes) -> object:
    """Return what a question is answered."""
    return _ANSWERS[what](parse(body))


if __name__ == "__main__":
    answer_or_refuse(posed, _IDLE)
