"""``jointplay scene check``: whether a mechanism can be put together and move."""

import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from jointplay.command_line.options import AS_JSON, SCENE, SET
from jointplay.command_line.output import print_result
from jointplay.command_line.scene.assembled import assemble_scene

if TYPE_CHECKING:
    from jointplay.solver.kinds.assembled import AssembledScene
    from jointplay.solver.mechanics.assemblies import Assemblies


def check(source: SCENE, settings: SET = None, as_json: AS_JSON = False) -> None:
    """Check a mechanism before it is run: freedom, redundant constraints, assemblies.

    Of a mechanism that cannot be run the same is printed, and why; then the exit code is 2.

    Example: `jointplay scene check mine.json --set clearance=1e-4`
    """
    from jointplay.service.scenes.findings import assemblies_of, findings_of

    scene = assemble_scene(source, settings or ())
    found = assemblies_of(scene)
    document = findings_of(scene, found)
    lines = [*_lines(scene, document, found), *_overshoots(document)]
    lines += [f"{'parameter':22} {one}" for one in scene.replaced]
    lines += [f"{'hint':22} {one.pointer}: {one.detail}" for one in scene.hints]
    turn = document["turn"]
    told = [*lines, f"{'turn':22} {turn['detail']}"] if turn else lines
    print_result(document, told, as_json=as_json)
    if scene.refusal is not None:
        raise scene.refusal


def _lines(scene: "AssembledScene", document: dict[str, Any], found: "Assemblies") -> Iterator[str]:
    assembly, admission = scene.assembly, scene.admission
    lines = {
        "scene": scene.document["name"],
        "bodies": ", ".join(scene.document["bodies"]),
        "joints with clearance": ", ".join(document["joints_with_clearance"]) or "none",
        "degrees of freedom": f"{assembly.freedom_with_play} ({assembly.freedom} if ideal)",
        "redundant constraints": f"{assembly.redundant_with_play} ({assembly.redundant} if ideal)",
        "assembly residual": f"{assembly.residual:.2g} m or rad",
    }
    if admission is not None:
        period = admission.period
        lines["period"] = f"{period:g} s" if period else f"none: {admission.section_note}"
        lines["channels"] = str(len(admission.channels))
    for name, value in lines.items():
        yield f"{name:22} {value}"
    for body, (x, y, theta) in document["pose"].items():
        yield f"{'starts at':22} {body} {_near(x)}, {_near(y)} m, {_near(theta)} rad"
    for one in document["given"]:
        yield f"{'given':22} {_kept(one)}"
    held = f", {' and '.join(found.held)} held" if found.held else ""
    yield f"{'assemblies':22} {len(found.angles)} found from {found.tried + 1} starts{held}"
    for start in document["starts"][1:]:
        yield f'{"another":22} "start": {json.dumps(start)}'


def _overshoots(document: dict[str, Any]) -> Iterator[str]:
    for one in document["overshoots"]:
        yield f"{'overshoot':22} {one['pointer']}: {one['detail']}"


def _kept(one: dict[str, Any]) -> str:
    """Return one thing that is given, and how far what is taken is from it."""
    given, taken = (", ".join(map(_near, one[name])) for name in ("given", "taken"))
    if one["kept"]:
        return f"{one['pointer']} {given} {one['unit']}, kept"
    apart = math.dist(one["given"], one["taken"])
    return f"{one['pointer']} {given} {one['unit']}: taken {taken}, off by {apart:.3g}"


def _near(value: float) -> str:
    """Return a number to six digits; what is rounding of metres is 0."""
    return f"{round(value, 12):z.6g}"
