"""``jointplay cite``: how to cite the program, and the source of what a job simulates."""

from typing import Annotated, Any

import typer

from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, job_of
from jointplay.command_line.output import print_result

TITLE = "jointplay: simulation of planar mechanisms whose joints have play"
AUTHORS = "The jointplay developers"
_ENTRY = f"""@software{{jointplay,
  title = {{{TITLE}}},
  author = {{{{{AUTHORS}}}}},
  version = {{%s}},
}}"""


def cite(
    results: Annotated[
        str | None,
        typer.Argument(metavar="[OUT|ID]", help="A run's folder, or id of a job."),
    ] = None,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Print what to cite: the program as BibTeX, and of a job its scene's source and its identity.

    Example: `jointplay cite 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    from importlib.metadata import version

    facts: dict[str, Any] = {"version": version("jointplay")}
    if results is not None:
        facts |= _facts(results, url)
    entry = _ENTRY % facts["version"]
    lines = [f"{name}: {value}" for name, value in facts.items() if name != "version" and value]
    print_result(facts | {"bibtex": entry}, [entry, *lines], as_json=as_json)


def _facts(results: str, url: str) -> dict[str, Any]:
    """Return what tells a result from every other one, and where its scene is from.

    A job is identified by its canonical JSON, every default filled in, without the label.
    """
    import hashlib
    import json

    from jointplay.solver.scene import presets

    with job_of(results, url) as job:
        scene = job.job["scene"]
        source = presets.document(scene["preset"]) if scene.get("preset") else scene
    unlabelled = {name: value for name, value in job.job.items() if name != "label"}
    text = json.dumps(unlabelled, sort_keys=True, separators=(",", ":"))
    return {
        **({"version": job.solver_version} if job.solver_version else {}),
        "job": results,
        "scene": job.scene_name,
        "source of the scene": source.get("source"),
        "SHA-256 of the job": hashlib.sha256(text.encode()).hexdigest(),
    }
