"""The report: one HTML page that needs nothing beside itself."""

import base64
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from jointplay.paper import cases, findings, motions, peaks, ranges, reported
from jointplay.paper.cases import Stores
from jointplay.paper.comparison import Table, milliseconds, signed
from jointplay.paper.pictures import Picture
from jointplay.paper.variants import CONSTANT, FULL, SLIPS, Size, Variant
from jointplay.solver.scene import presets


@dataclass(frozen=True)
class Section:
    """A section with results: figures under headings, which may be empty, and tables below.

    The figures are named by their `Picture.section`.
    """

    name: str
    title: str
    figures: Sequence[tuple[str, str]]
    tables: Sequence[Table]
    has_few_sections: bool = False


def page(folder: Path, size: Size, pictures: Sequence[tuple[Picture, bytes]]) -> str:
    """Return the page.

    Parameters
    ----------
    folder
        Of the stores that `reproduction.reproduce` made.
    size
        What was computed.
    pictures
        With the bytes of their PNG files.
    """
    printed, stores = reported.document(), Stores(folder)
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    environment.filters |= {
        "shown": format,
        "signed": signed,
        "milliseconds": milliseconds,
        "case_name": reported.case_name,
    }
    text = resources.files("jointplay.paper").joinpath("template.html").read_text("utf-8")
    runs = cases.runs(size)
    rendered: str = environment.from_string(text).render(
        findings.findings(stores, size),
        title=f"{printed['scene'].replace('-', ' ').capitalize()}: published and computed",
        printed=printed,
        size=size,
        is_full=size == FULL,
        law=CONSTANT,
        slips=SLIPS,
        joints=cases.JOINTS,
        overview_titles=findings.OVERVIEW,
        overview=list(findings.overview(stores, size.variants)),
        declared=presets.document(printed["scene"])["parameters"],
        sections=list(_sections(stores, size)),
        pictures=[(one, base64.b64encode(png).decode("ascii")) for one, png in pictures],
        experiment=Table("Printed of the experiment", ("ours",), list(findings.experiment())),
        jobs=Counter((run.name.split("-")[0], run.job["kind"]) for run in runs),
    )
    return rendered


def _sections(stores: Stores, size: Size) -> Iterator[Section]:
    printed = reported.document()
    labels = [variant.label for variant in size.variants]
    judged = [variant.label for variant in size.motions]
    for index, sweep in enumerate(printed["sweeps"]):
        rows = [peaks.ideal(stores, size.variants)] if index == 0 else []
        rows += peaks.rows(stores, sweep["cases"], size.variants)
        caption = f"Peaks in the first {cases.DURATION:g} s ({sweep['where']})"
        title = f"{sweep['title']}: {sweep['figures'][0]} to {sweep['figures'][-1]}"
        name = f"sweep-{index}"
        yield Section(name, title, [("", name)], [Table(caption, labels, rows)])
    where = printed["adams_comparison"]["where"]
    gravities = [f"gravity {name}" for name in cases.GRAVITIES]
    tables = [
        Table(f"{one.label} ({where})", gravities, list(peaks.load_cases(stores, one)))
        for one in (Variant(CONSTANT, slip) for slip in SLIPS)
    ]
    yield Section("load-cases", "Comparison of two programs: Figs 14 to 16", [], tables)
    early, late = (f"{first} to {last}" for first, last in (size.early, size.late))
    yield Section(
        "phases",
        "Phase portraits and sections: Figs 17 to 20, 23 to 26",
        [
            (f"{reported.case_name(entry)} ({entry['where']})", f"phase-{case}")
            for case, entry in enumerate(printed["phase_ranges"])
        ],
        [
            Table(
                f"Ranges in revolutions {early}, below them in {late}; × is the ratio of the"
                " widths",
                labels,
                list(ranges.rows(stores, size.variants)),
            ),
            Table(
                f"Kind of motion, from {size.members} starts, {size.settle} revolutions left out,"
                f" {size.record} recorded, tolerance {size.tolerance:g}",
                judged,
                list(motions.rows(stores, size.motions)),
                ("case", "figures", "their words"),
            ),
        ],
    )
    settle, record = size.diagram
    for which, entry in enumerate(printed["bifurcation"]):
        caption = (
            "Verdicts, exponents (median, a tenth below and above) and extent of the sections in"
            f" clearances ({entry['where']}); {settle} revolutions left out, {record} recorded"
        )
        rows = list(motions.diagram_rows(stores, which, size.motions))
        table = Table(caption, judged, rows, ("interval", "joint", "their words"))
        title = f"Bifurcation diagrams: {entry['figures'][0]} and {entry['figures'][-1]}"
        name = f"diagram-{which}"
        yield Section(name, title, [("", name)], [table], has_few_sections=True)
