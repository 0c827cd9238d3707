"""``jointplay scene check``: whether a mechanism can be put together and move."""

from typing import Annotated

import typer

from jointplay.command_line import job_document
from jointplay.command_line.scene.assembled import SCENE, assemble_scene


def check(source: Annotated[str, SCENE], settings: job_document.SET = None) -> None:
    """Check a mechanism before it is run: freedom, redundant constraints, assembly.

    Example: `jointplay scene check mine.json --set clearance=1e-4`
    """
    scene = assemble_scene(source, settings or ())
    assembly, admission = scene.assembly, scene.admission
    period = f"{admission.period:g} s" if admission.period else f"none: {admission.section_note}"
    lines = {
        "scene": scene.document["name"],
        "bodies": ", ".join(scene.document["bodies"]),
        "joints with clearance": ", ".join(admission.joints) or "none",
        "degrees of freedom": f"{assembly.freedom_with_play} ({assembly.freedom} if ideal)",
        "redundant constraints": f"{assembly.redundant_with_play} ({assembly.redundant} if ideal)",
        "assembly residual": f"{assembly.residual:.2g} m or rad",
        "period": period,
        "channels": str(len(admission.channels)),
    }
    for name, value in lines.items():
        typer.echo(f"{name:22} {value}")
