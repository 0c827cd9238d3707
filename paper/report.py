"""The report: one HTML page that needs nothing beside itself."""

from collections import Counter
from collections.abc import Iterator, Sequence
from html import escape
from importlib import resources
from pathlib import Path
from string import Template

from jointplay.paper import (
    cases,
    diagrams,
    experiment,
    findings,
    load_cases,
    markup,
    motions,
    overview,
    peaks,
    ranges,
    reported,
)
from jointplay.paper.comparison import Row
from jointplay.paper.pictures import Picture
from jointplay.paper.size import FULL, Size
from jointplay.paper.variants import CONSTANT, SLIPS, Variant
from jointplay.solver.scene import presets

_FEW = (
    "<p>Sections as few as those of a diagram tell the 0–1 test nothing: a motion whose exponent is"
    " near zero stays undecided there, unless it recurs.</p>"
)
_FIRST = ("case", "quantity", "printed")


def page(folder: Path, size: Size, pictures: Sequence[tuple[Picture, bytes]]) -> str:
    """Return the page.

    Parameters
    ----------
    folder
        Of the stores that `runs.compute` made.
    size
        What was computed.
    pictures
        With the bytes of their PNG files.
    """
    printed = reported.document()
    sections = list(_sections(folder, size, pictures))
    template = resources.files("jointplay.paper").joinpath("template.html").read_text("utf-8")
    return Template(template).substitute(
        title=escape(_title()),
        source=escape(printed["source"]),
        doi=escape(printed["doi"]),
        extent=escape(_extent(size)),
        summary=markup.bullets(findings.in_short(folder, size)),
        overview=markup.listing(
            "Ours over printed: median (smallest … largest)",
            overview.TITLES,
            overview.rows(folder, size.variants),
        ),
        contents="".join(
            f'<li><a href="#{name}">{escape(title)}</a></li>' for name, title, _ in sections
        ),
        inferred=_inferred(),
        sections="\n".join(
            f'<section id="{name}"><h2>{escape(title)}</h2>{body}</section>'
            for name, title, body in sections
        ),
        test_bed=markup.table("Printed of the experiment", _FIRST, ("ours",), experiment.rows()),
        gravity=escape(findings.gravity(folder)),
        sampling=escape(findings.sampling(folder, size)),
        slip=escape(findings.slip(folder)),
        window=escape(findings.window(folder, size)),
        weakening=escape(findings.weakening(folder, size)),
        bed=escape(findings.bed()),
        jobs=_jobs(size),
    )


def _sections(
    folder: Path, size: Size, pictures: Sequence[tuple[Picture, bytes]]
) -> Iterator[tuple[str, str, str]]:
    """Yield name, title and body of the sections with results."""
    printed = reported.document()
    labels = [variant.label for variant in size.variants]
    for index, sweep in enumerate(printed["sweeps"]):
        rows = [peaks.ideal(folder, size.variants)] if index == 0 else []
        rows += peaks.rows(folder, sweep["cases"], size.variants)
        table = _table(f"Peaks in the first {cases.DURATION:g} s ({sweep['where']})", labels, rows)
        title = f"{sweep['title']}: {sweep['figures'][0]} to {sweep['figures'][-1]}"
        yield f"sweep-{index}", title, _drawn(f"sweep-{index}", pictures) + table
    where = printed["adams_comparison"]["where"]
    body = "".join(
        _table(
            f"{variant.label} ({where})",
            [f"gravity {name}" for name in cases.GRAVITIES],
            list(load_cases.rows(folder, variant)),
        )
        for variant in (Variant(CONSTANT, slip) for slip in SLIPS)
    )
    yield "load-cases", "Comparison of two programs: Figs 14 to 16", body
    yield (
        "phases",
        "Phase portraits and sections: Figs 17 to 20, 23 to 26",
        _phases(folder, size, pictures),
    )
    for which, entry in enumerate(printed["bifurcation"]):
        title = f"Bifurcation diagrams: {entry['figures'][0]} and {entry['figures'][-1]}"
        settle, record = size.diagram
        table = _table(
            f"Verdicts, exponents (median, a tenth below and above) and extent of the sections in"
            f" clearances ({entry['where']}); {settle} revolutions left out, {record} recorded",
            [variant.label for variant in size.motions],
            list(diagrams.rows(folder, which, size.motions)),
            ("interval", "joint", "their words"),
        )
        yield f"diagram-{which}", title, _drawn(f"diagram-{which}", pictures) + _FEW + table


def _phases(folder: Path, size: Size, pictures: Sequence[tuple[Picture, bytes]]) -> str:
    labels = [variant.label for variant in size.variants]
    parts = []
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        parts.append(f"<h3>{escape(reported.case_name(entry))} ({escape(entry['where'])})</h3>")
        parts.append(_drawn(f"phase-{case}", pictures))
    early, late = (f"{first} to {last}" for first, last in (size.early, size.late))
    caption = f"Ranges in revolutions {early}, below them in {late}; × is the ratio of the widths"
    parts.append(_table(caption, labels, list(ranges.rows(folder, size.variants))))
    caption = (
        f"Kind of motion, from {size.members} starts, {size.settle} revolutions left out,"
        f" {size.record} recorded, tolerance {size.tolerance:g}"
    )
    first = ("case", "figures", "their words")
    labels = [variant.label for variant in size.motions]
    parts.append(_table(caption, labels, list(motions.rows(folder, size.motions)), first))
    return "".join(parts)


def _table(
    caption: str, columns: Sequence[str], rows: Sequence[Row], first: Sequence[str] = _FIRST
) -> str:
    return f'<div class="wide">{markup.table(caption, first, columns, rows)}</div>'


def _drawn(section: str, pictures: Sequence[tuple[Picture, bytes]]) -> str:
    shown = (
        markup.image(png, picture.alternative, picture.caption)
        for picture, png in pictures
        if picture.section == section
    )
    return f'<div class="pictures">{"".join(shown)}</div>'


def _title() -> str:
    return f"{reported.document()['scene'].replace('-', ' ').capitalize()}: published and computed"


def _extent(size: Size) -> str:
    if size == FULL:
        return ""
    return (
        "This is a quick run: few values, few revolutions, one stiffness. It shows that everything"
        " works; its numbers of settled motion mean little."
    )


def _inferred() -> str:
    declared = presets.document(reported.document()["scene"])["parameters"]
    rows = [
        (
            name,
            f"{one['default']:g}" if isinstance(one["default"], float) else one["default"],
            one["unit"],
            one["help"],
        )
        for name, one in declared.items()
        if one["inferred"]
    ]
    return markup.listing("Inferred defaults", ("parameter", "value", "unit", "meaning"), rows)


def _jobs(size: Size) -> str:
    runs = cases.runs(size)
    groups = Counter((run.name.split("-")[0], run.job["kind"]) for run in runs)
    rows = [(f"{name}-…", kind, str(count)) for (name, kind), count in groups.items()]
    return markup.listing(f"All {len(runs)} jobs", ("name", "kind", "how many"), rows)
