"""``jointplay scene check``: whether a mechanism can be put together and move."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from jointplay.command_line.options import AS_JSON, SCENE, SET
from jointplay.command_line.output import tell
from jointplay.command_line.scene.assembled import assemble_scene

if TYPE_CHECKING:
    from jointplay.solver.kinds.assembled import AssembledScene
    from jointplay.solver.mechanics.branches import Branches


def check(source: SCENE, settings: SET = None, as_json: AS_JSON = False) -> None:
    """Check a mechanism before it is run: freedom, redundant constraints, assemblies.

    Of a mechanism that cannot be run the same is printed, and why; then the exit code is 2.

    Example: `jointplay scene check mine.json --set clearance=1e-4`
    """
    from jointplay.service.scenes.findings import branches_of, findings_of

    scene = assemble_scene(source, settings or ())
    found = branches_of(scene)
    document = findings_of(scene, found)
    tell(document, _lines(scene, document["joints_with_clearance"], found), as_json=as_json)
    if scene.refusal is not None:
        raise scene.refusal


def _lines(scene: "AssembledScene", joints: list[str], found: "Branches") -> Iterator[str]:
    assembly, admission = scene.assembly, scene.admission
    lines = {
        "scene": scene.document["name"],
        "bodies": ", ".join(scene.document["bodies"]),
        "joints with clearance": ", ".join(joints) or "none",
        "degrees of freedom": f"{assembly.freedom_with_play} ({assembly.freedom} if ideal)",
        "redundant constraints": f"{assembly.redundant_with_play} ({assembly.redundant} if ideal)",
        "assembly residual": f"{assembly.residual:.2g} m or rad",
    }
    if admission is not None:
        period = admission.period
        lines["period"] = f"{period:g} s" if period else f"none: {admission.section_note}"
        lines["channels"] = str(len(admission.channels))
    held = f", {' and '.join(found.held)} held" if found.held else ""
    lines["assemblies"] = f"{len(found.angles)} found from {found.tried + 1} starts{held}"
    for name, value in lines.items():
        yield f"{name:22} {value}"
    largest = max((math.hypot(*at) for one in found.places for at in one.values()), default=0.0)
    for angles, places in zip(found.angles[1:], found.places[1:], strict=True):
        turned = [
            f"{body} {angle:.4g}"
            for body, angle in angles.items()
            if abs(math.sin((angle - found.angles[0][body]) / 2)) > ALIKE
        ]
        # a body that slides to another place; what turns tells enough where there is such
        moved = [
            f"{body} at {round(x, 12):z.4g}, {round(y, 12):z.4g}"
            for body, (x, y) in places.items()
            if math.dist((x, y), found.places[0][body]) > ALIKE * largest
        ]
        told = f"{', '.join(turned)} rad" if turned else f"{', '.join(moved)} m"
        yield f"{'':22} another: {told}"


ALIKE = 1e-6
"""Sine of half the difference of two angles, and share of the largest distance from the origin of
that of two places, below which they are shown as one."""
