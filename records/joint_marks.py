"""Marks by which joints are drawn, by the type of a joint in a scene document.

A type of joint gives its own, in terms of its fields; figures and the page paint them.
`python -m jointplay.solver.joints.marks` prints those of all types; what it printed is
`joint_marks.json`. A type that joins later adds its marks to `MARKS`.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, Literal, TypedDict, cast


class Marks(TypedDict):
    """Marks of a type of joint; fields that it has not are empty strings."""

    ends: tuple[str, str]
    """Fields that name its first and second point."""
    turns: bool
    """Whether a driver of it turns."""
    sign: Literal["pin", "weld", ""]
    """Sign at its second point; nothing of one whose first point is only on an axis."""
    supported: bool
    """Whether it stands on the ground where one end is there."""
    axis: str
    """Field of the direction, in the first body's axes, in which it has a rail."""
    play: str
    """Field of its clearance that says how far its parts may move apart, m."""
    size: str
    """Field of its clearance that says how large its parts are, m."""
    block: tuple[str, str] | None
    """Fields of its clearance for length and height of a block between walls along the axis."""
    has_curves: bool
    """Whether it is drawn by curves, too, which the solver makes of a scene's joints."""
    is_journal: bool
    """Whether its contact pair has an eccentricity."""
    parts: dict[str, tuple[float, float]]
    """Positions of its contact pairs by their names: along the axis and across it, in halves of
    what touches; a single pair has the name ''."""
    picture: Literal["journal", "walls", "surface", ""]
    """Picture of its play, magnified, if there is one."""
    caption: str
    """Words of that picture; {} stands for the joint's name."""


MARKS: Final[dict[str, Marks]] = json.loads(
    (Path(__file__).parent / "joint_marks.json").read_text(encoding="utf-8")
)


def marks_of(joint: Mapping[str, Any]) -> Marks:
    """Return the marks of a joint of a checked scene document."""
    return MARKS[cast(str, joint["type"])]


def play_of(joint: Mapping[str, Any]) -> float:
    """Return the play of a joint, m; 0 of an ideal one."""
    clearance = joint.get("clearance") or {}
    return float(clearance.get(marks_of(joint)["play"], 0.0))
