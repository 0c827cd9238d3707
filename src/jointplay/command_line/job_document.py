"""A job's document from what was typed: a preset or a file, and the options that change it."""

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from jointplay.command_line.exits import Stopped
from jointplay.command_line.job_options import fields_of, once
from jointplay.command_line.typed_file import is_read, text_of

JOB_FILE = "job.json"  # of a run's folder; worker.local.folder names it, too


def job_document(
    source: str, *, settings: Sequence[str] | None, options: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the job that ``source`` and the options describe; nothing is checked yet.

    ``source`` is the path of a job or scene document, or the name of a preset; settings are
    ``name=value``; options as `with_job_options` gives them, those that are None left as they are.
    """
    from jointplay.scene_choice import NotAScene, with_parameters

    job, is_whole = _job_of(source)
    changed = fields_of(options)
    if is_whole and "kind" in changed:
        line = f"{source} is a job already; --{changed['kind']} makes one of a scene or a preset."
        raise Stopped(line)
    if "tolerance" in changed:
        job.pop("accuracy", None)
    if "accuracy" in changed:
        job.pop("tolerance", None)
        job.pop("method", None)
    job.update(changed)
    scene = job.get("scene")
    values = once("--set", map(_setting, settings or ()))
    varied = _varied(job)
    for name in values:
        if name in varied:
            raise Stopped(f"--set {name}: the study varies {name}; leave this value out.")
    if values and isinstance(scene, dict):  # else admission says what is wrong with it
        try:
            job["scene"] = with_parameters(scene, values)
        except NotAScene as error:
            raise Stopped(f"--set {error}") from None
    return job


def replaced_numbers(job: Mapping[str, Any], settings: Sequence[str] | None) -> Iterator[str]:
    """Yield a line for every number of an admitted job's scene that a parameter's default replaces.

    Parameters that are set, and those that a study varies, are told by what was typed.
    """
    from jointplay.solver.scene.replaced import replaced

    scene = job["scene"]
    if scene.get("parameters"):
        told = {name for name, _ in map(_setting, settings or ())} | _varied(job)
        for one in replaced(scene):
            if one.parameter not in told:
                yield f"the default of parameter {one}"


def _varied(job: Mapping[str, Any]) -> set[str]:
    """Return the parameters that a job varies; it may not be admitted yet."""
    axes = (one for one in (job, job.get("along"), job.get("by")) if isinstance(one, Mapping))
    named = {one["parameter"] for one in axes if isinstance(one.get("parameter"), str)}
    listed = job.get("points")
    tables = [job.get("grid"), job.get("parameters"), *(listed if isinstance(listed, list) else ())]
    return named.union(*(one for one in tables if isinstance(one, Mapping)))


def _read(path: Path) -> dict[str, Any]:
    """Read a JSON object from a file, strictly."""
    from jointplay.records.strict_json import MalformedJson, parse

    try:
        document = parse(text_of(str(path)))
    except MalformedJson:
        if path.suffix in (".yaml", ".yml"):
            raise Stopped(f"{path}: jobs and scenes are read as JSON, not as YAML.") from None
        raise
    if not isinstance(document, dict):
        raise Stopped(f"{path}: a job or a scene is a JSON object.")
    return document


def is_scene_file(source: str) -> bool:
    """Tell whether ``source`` is the file of a scene, and not of a job or a preset."""
    path = Path(source)
    return is_read(source) and "bodies" in _read(path)


def _job_of(source: str) -> tuple[dict[str, Any], bool]:
    """Return the job, and whether it was given whole and not made of a scene."""
    path = Path(source)
    if is_read(source):
        document = _read(path)
        if "bodies" in document:
            return {"kind": "simulate", "scene": document}, False
        return document, True
    if path.is_dir():
        job = path / JOB_FILE
        what = f"give {job}, or --resume {source}" if job.exists() else "give a job or a scene"
        raise Stopped(f"{source} is a folder; {what}.")
    if source.endswith(".json") or "/" in source:
        raise Stopped(f"There is no file {source}.")
    return {"kind": "simulate", "scene": {"preset": source}}, False


def _setting(text: str) -> tuple[str, object]:
    from jointplay.records.strict_json import MalformedJson, parse

    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise Stopped(f"--set {text}: write NAME=VALUE, such as clearance=5e-4.")
    try:
        return name, parse(value.encode())
    except MalformedJson:
        return name, _number_or_word(value)


def _number_or_word(text: str) -> object:
    """Return a number as people write it (.3, 5.), or else the word, such as as-published."""
    plain = re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", text)
    return float(text) if plain else text
