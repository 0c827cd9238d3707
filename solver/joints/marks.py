"""Marks by which a type of joint is drawn: `python -m jointplay.solver.joints.marks` prints all.

What it printed is `joint_marks.json` of the package `records`, by which figures and the page paint.
"""

import json
import sys
from typing import get_args

from jointplay.records.joint_marks import Marks
from jointplay.solver.joints import JOINTS, Joint


def marks(joint: type[Joint]) -> Marks:
    """Return the marks of a type of joint, a class."""
    drawing = joint.drawing
    field = joint.model_fields.get("clearance")
    clearance, *_ = get_args(field.annotation) if field else (None,)
    return {
        "ends": joint.end_fields,
        "turns": joint.freedom == "turn",
        "sign": drawing.sign,
        "supported": drawing.supported,
        "axis": drawing.axis,
        "play": clearance.play_field if clearance else "",
        "size": drawing.size,
        "block": drawing.block,
        "has_curves": joint.curves is not Joint.curves,
        "is_journal": joint.is_journal,
        "parts": dict(zip(joint.parts, drawing.positions, strict=True)),
        "picture": drawing.picture,
        "caption": drawing.caption,
    }


if __name__ == "__main__":
    found = {name: marks(joint) for name, joint in JOINTS.items()}
    sys.stdout.write(json.dumps(found, indent=1) + "\n")
