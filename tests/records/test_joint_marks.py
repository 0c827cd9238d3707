"""Marks by which joints are drawn: those that are stored are those that types of joints give."""

import json

from jointplay.records.joint_marks import MARKS
from jointplay.solver.joints import JOINTS
from jointplay.solver.joints.marks import marks


def test_marks_are_those_of_the_types_of_joints() -> None:
    """Else run `python -m jointplay.solver.joints.marks > records/joint_marks.json`."""
    given = {name: marks(joint) for name, joint in JOINTS.items()}
    assert json.loads(json.dumps(given)) == MARKS
