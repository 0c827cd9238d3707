"""``jointplay cite``: how to cite the program, and the source of what a job simulates."""

from pathlib import Path
from typing import Annotated, Any

import typer

from jointplay.command_line import connection, output_folder

TITLE = "jointplay: simulation of planar mechanisms whose joints have play"
AUTHORS = "The jointplay developers"


def cite(
    results: Annotated[
        str | None,
        typer.Argument(metavar="[OUT|ID]", help="A run's folder, or id of a job."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print it as JSON.")] = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Print what to cite: the program as BibTeX, and of a job its scene's source and its identity.

    Example: `jointplay cite 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    import json

    facts = _facts(results, url) if results is not None else {"version": _version()}
    entry = _bibtex(facts["version"])
    if as_json:
        typer.echo(json.dumps(facts | {"bibtex": entry}, indent=2))
        return
    typer.echo(entry)
    for name, value in facts.items():
        if name != "version" and value:
            typer.echo(f"{name}: {value}")


def _facts(results: str, url: str) -> dict[str, Any]:
    """Return what tells a result from every other one, and where its scene is from."""
    if output_folder.is_of_service(results):
        with connection.connect(url) as client:
            found = client.get(results)
            name = found.job["scene"].get("preset")
            scene = client.scene(name) if name else found.job["scene"]
        job, version = found.job, found.solver_version
    else:
        attributes = output_folder.results_in(Path(results)).attributes
        job, scene, version = attributes["job"], attributes["scene"], attributes["solver_version"]
    return {
        "version": version or _version(),
        "job": results,
        "scene": scene.get("name") or job["scene"].get("preset"),
        "source of the scene": scene.get("source"),
        "SHA-256 of the job": _digest(job),
    }


def _digest(job: dict[str, Any]) -> str:
    """Return what identifies the filled-in job: its canonical JSON without the label."""
    import hashlib
    import json

    unlabelled = {name: value for name, value in job.items() if name != "label"}
    text = json.dumps(unlabelled, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def _version() -> str:
    from importlib.metadata import version

    return version("jointplay")


def _bibtex(version: str) -> str:
    return "\n".join(
        (
            "@software{jointplay,",
            f"  title = {{{TITLE}}},",
            f"  author = {{{{{AUTHORS}}}}},",
            f"  version = {{{version}}},",
            "}",
        )
    )
