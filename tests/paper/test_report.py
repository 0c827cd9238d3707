"""``jointplay reproduce --quick``: the report, its numbers and its figures."""

import base64
import json
import re
import signal
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from jointplay.command_line.exits import Exit
from jointplay.paper import cases, peaks, reported
from jointplay.paper.reproduction import PAGE, RUNS
from jointplay.paper.variants import QUICK
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.studies.reader import StudyReader
from tests.paper.printed_numbers import pointers as printed_numbers
from tests.waiting import until

REPRODUCE = [sys.executable, "-m", "jointplay", "reproduce"]
ALL_RUNS = pytest.mark.long
"""Marks tests of a whole reproduction, which takes a minute of processor time."""
NUMBER = re.compile(r"[-−]?\d+(?:\.\d+)?")


class Page(HTMLParser):
    """Facts of the report that tests ask for."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.images: list[dict[str, str]] = []
        self.links: list[str] = []
        self.names: set[str] = set()
        self.captions: list[str] = []
        self.rows: list[tuple[list[str], dict[str, list[str]]]] = []
        """Pointers of a row, and the texts of its cells by their class."""
        self.open: list[str] = []
        self._class = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.names |= {given["id"]} if "id" in given else set()
        if tag == "img":
            self.images.append(given)
        elif tag == "a":
            self.links.append(given["href"])
        elif tag == "tr":
            self.rows.append((given.get("data-reported", "").split(), {"printed": [], "why": []}))
        elif tag == "figcaption":
            self.captions.append("")
        elif tag in {"td", "th"} and self.rows:
            self._class = given.get("class", "")
            self.rows[-1][1].setdefault(self._class, []).append("")
        if tag not in {"meta", "img", "link", "br"}:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag  # well-formed

    def handle_data(self, data: str) -> None:
        if "figcaption" in self.open:
            self.captions[-1] += data
        elif {"td", "th"} & set(self.open) and self.rows:
            self.rows[-1][1][self._class][-1] += f" {data}"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Folder of a quick reproduction, and the page that it names."""
    folder = tmp_path_factory.mktemp("reproduce") / "out"
    ended = subprocess.run(
        [*REPRODUCE, "--quick", "-o", str(folder), "--json"], capture_output=True, text=True
    )
    assert ended.returncode == 0, ended.stderr
    return folder, json.loads(ended.stdout)["report"]


@pytest.mark.long
def test_a_reproduction_goes_on_after_a_signal(tmp_path):
    folder = tmp_path / "out"
    begin = [*REPRODUCE, "--quick", "-o", str(folder), "--json", "--processes", "1"]
    with subprocess.Popen(begin, stderr=subprocess.PIPE, text=True) as process:
        until(lambda: process.poll() is not None or len(stores_in(folder)) > 2)
        process.send_signal(signal.SIGTERM)
        _, told = process.communicate()
    assert process.returncode == Exit.INTERRUPTED, told
    assert f"To go on: jointplay reproduce --resume {folder}" in told
    there = stores_in(folder)
    go_on = [*REPRODUCE, "--resume", str(folder), "--json"]
    ended = subprocess.run(go_on, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    assert there.items() <= stores_in(folder).items()  # what was there is not computed again
    assert (folder / PAGE).is_file()


def stores_in(folder: Path) -> dict[Path, int]:
    """Return the results in a reproduction, and when they were written."""
    return {path: path.stat().st_mtime_ns for path in folder.glob(f"{RUNS}/*.zarr.zip")}


@pytest.fixture(scope="module")
def text(made: tuple[Path, str]) -> str:
    return (made[0] / PAGE).read_text("utf-8")


@pytest.fixture(scope="module")
def page(text: str) -> Page:
    return Page(text)


def value_at(pointer: str) -> float:
    found: Any = reported.document()
    for part in pointer.split("/")[1:]:
        found = found[int(part)] if isinstance(found, list) else found[part]
    return float(found)


@ALL_RUNS
def test_it_ends_with_the_path_of_the_report(made):
    folder, page = made
    assert page == str(folder / PAGE)


@ALL_RUNS
def test_every_printed_number_stands_beside_ours(page):
    shown: dict[str, list[float]] = {}
    for pointers, cells in page.rows:
        for pointer in pointers:
            printed = " ".join(cells["printed"])
            numbers = [float(one.replace("−", "-")) for one in NUMBER.findall(printed)]
            shown.setdefault(pointer, []).extend(numbers)
            assert sum(map(len, cells.values())) >= 4
    assert set(shown) == printed_numbers()
    for pointer, numbers in shown.items():
        printed = value_at(pointer)
        # in its own unit, or in thousandths: mm, ms
        assert any(
            number == pytest.approx(wanted, rel=1e-9)
            for number in numbers
            for wanted in (printed, 1e3 * printed)
        ), pointer


@ALL_RUNS
def test_the_page_needs_nothing_beside_itself(text, page):
    assert all(image["src"].startswith("data:image/png;base64,") for image in page.images)
    outside = [link for link in page.links if not link.startswith("#")]
    assert outside == [f"https://doi.org/{reported.document()['doi']}"]
    assert not re.search(r"<(script|link|iframe|object)\b|@import|url\(", text)
    filled_in = re.sub(r'src="[^"]*"|<style>.*?</style>', "", text, flags=re.DOTALL)
    assert not re.search(r"[{}]", filled_in)


@ALL_RUNS
def test_every_link_inside_leads_somewhere(page):
    assert page.open == []
    inside = {link.removeprefix("#") for link in page.links if link.startswith("#")}
    assert inside
    assert inside <= page.names


@ALL_RUNS
def test_every_figure_is_a_picture_with_words_for_it(page):
    assert len(page.images) == len(page.captions) > 0
    for image in page.images:
        png = base64.b64decode(image["src"].partition(",")[2], validate=True)
        assert png.startswith(b"\x89PNG")
        assert len(image["alt"]) > 40
    # those of the comparison of programs are a table
    wanted = {f"Fig. {number}" for number in (*range(5, 14), *range(17, 29))}
    assert wanted <= set(re.findall(r"Fig\. \d+", " ".join(page.captions)))


@ALL_RUNS
def test_exponents_and_verdicts_stand_beside_the_words(text):
    words = {
        word
        for entry in reported.document()["bifurcation"]
        for word in (one["words"] for one in entry["reported"])
    }
    assert all(word in text for word in words)
    assert "λ = " in text
    assert re.search(r"\b(undecided|chaotic|period)", text)


@ALL_RUNS
def test_every_disagreement_has_a_reason(page):
    reasons = {"gravity", "sampling", "slip", "window", "contact", "order", "system", "bed"}
    assert {f"cause-{reason}" for reason in reasons} <= page.names
    for pointers, cells in page.rows:
        if pointers and "ideal" not in pointers[0]:
            assert cells["why"][0].split(), pointers


@ALL_RUNS
def test_sampled_peaks_lie_on_the_grid_and_below_the_true_ones(made):
    grid = reported.document()["grid"]
    for case in range(len(reported.document()["response_peaks"])):
        for variant in QUICK.variants:
            reader = ResultReader(made[0] / RUNS / cases.name("response", case, variant))
            for channel in ("A.normal_force", "B.normal_force", "acceleration"):
                found = peaks.extreme(reader, channel)
                # half of the last digit of a time: samples are steps of a tenth of a millisecond
                assert found.sampled_time / grid == pytest.approx(
                    round(found.sampled_time / grid), abs=1e-6
                )
                # extremes are found by dense output, samples are too: equal to its rounding
                assert abs(found.sampled) <= abs(found.value) * (1.0 + 1e-9)


@ALL_RUNS
def test_the_first_impacts_are_the_printed_ones(made):
    """The times depend on geometry and gravity alone, the forces on the inferred stiffness."""
    for case, entry in enumerate(reported.document()["response_peaks"]):
        force, time = entry["force_A"]
        if time is None or time > 0.01:
            continue  # a later impact
        for variant in QUICK.variants:
            reader = ResultReader(made[0] / RUNS / cases.name("response", case, variant))
            found = peaks.extreme(reader, "A.normal_force")
            assert found.sampled_time == pytest.approx(time, abs=2.1e-4)  # a step of their grid
            assert found.sampled == pytest.approx(force, rel=0.15)  # K = 5e9 was inferred from them


@ALL_RUNS
def test_results_of_every_job_are_kept(made):
    for run in cases.runs(QUICK):
        store = made[0] / RUNS / run.name
        assert store.is_file()
        if run.job["kind"] == "simulate":
            assert ResultReader(store).complete
        else:
            study = StudyReader(store)
            assert study.complete
            assert np.all(study.counts == study.record)


def test_a_folder_that_exists_is_left_alone(tmp_path):
    command = [*REPRODUCE, "--quick", "-o", str(tmp_path)]
    ended = subprocess.run(command, capture_output=True, text=True)
    assert ended.returncode == 2
    assert "exists already" in ended.stderr
    assert ended.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
