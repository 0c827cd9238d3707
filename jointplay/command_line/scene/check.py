"""``jointplay scene check``: whether a mechanism can be put together and move."""

from collections.abc import Iterator

from jointplay.command_line.options import AS_JSON, SCENE, SET
from jointplay.command_line.output import tell
from jointplay.command_line.scene.assembled import AssembledScene, assemble_scene


def check(source: SCENE, settings: SET = None, as_json: AS_JSON = False) -> None:
    """Check a mechanism before it is run: freedom, redundant constraints, assembly.

    Of a mechanism that cannot be run the same is printed, and why; then the exit code is 2.

    Example: `jointplay scene check mine.json --set clearance=1e-4`
    """
    from jointplay.figures.scene_facts import clearances

    scene = assemble_scene(source, settings or ())
    assembly, admission = scene.assembly, scene.admission
    joints = list(clearances(scene.document))
    document = {
        "scene": scene.document["name"],
        "bodies": list(scene.document["bodies"]),
        "joints_with_clearance": joints,
        "freedom": assembly.freedom_with_play,
        "ideal_freedom": assembly.freedom,
        "redundant": assembly.redundant_with_play,
        "ideal_redundant": assembly.redundant,
        "residual": assembly.residual,
        "period": None if admission is None else admission.period,
        "channels": None if admission is None else len(admission.channels),
        "problems": scene.problems,
    }
    tell(document, _lines(scene, joints), as_json=as_json)
    if scene.refusal is not None:
        raise scene.refusal


def _lines(scene: AssembledScene, joints: list[str]) -> Iterator[str]:
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
    for name, value in lines.items():
        yield f"{name:22} {value}"
