"""The files of the page: served from the package, allowed to load nothing from elsewhere."""

import hashlib
import os
import re
import shutil
from pathlib import Path

import pytest

from jointplay.service.app import create_app
from jointplay.service.page.files import page_file, version
from jointplay.storage.settings import Settings
from tests.service_in_thread import client_of, serving

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "page"
OURS = sorted(
    path
    for path in PAGE.rglob("*")
    if path.suffix in {".js", ".css", ".html"} and "vendor" not in path.parts
)
MARKS = "/page/mechanism/joint_marks.js"
POLICY = "default-src 'none'; script-src 'self'; style-src 'self'"


def relative(path: Path) -> str:
    return str(path.relative_to(ROOT))


@pytest.mark.parametrize(
    "address", ["/", "/docs", "/report", "/favicon.ico", "/page/start.js", MARKS]
)
def test_the_page_is_served_under_a_strict_policy(http, address):
    answer = http.get(address)
    assert answer.status_code == 200
    assert answer.headers["Content-Security-Policy"].startswith(POLICY)
    assert "unsafe" not in answer.headers["Content-Security-Policy"]
    for known in (answer.headers["ETag"], f'"other", {answer.headers["ETag"]}', "*"):
        again = http.get(address, headers={"If-None-Match": known})
        assert (again.status_code, again.content) == (304, b"")
    assert http.head(address).status_code == 200


def test_browsers_keep_what_html_names_and_ask_for_html(http):
    html = http.get("/")
    assert html.headers["Cache-Control"] == "no-cache"
    named = re.findall(r'"(/page/[^"]*)"', html.text)
    assert len(named) > 4
    for address in named:
        assert http.get(address).headers["Cache-Control"].endswith("immutable")
    own = named[0].split("/")[2]
    assert http.get(f"/page/{own}/views/job.js").status_code == 200
    for other in ("/page/start.js", f"/page/{'0' * len(own)}/start.js"):
        assert http.get(other).headers["Cache-Control"] == "no-cache"
    assert http.get(f"/page/{own}/none.js").status_code == 404


def test_a_changed_file_changes_the_version(tmp_path):
    folder = tmp_path / "page"
    shutil.copytree(PAGE, folder, ignore=shutil.ignore_patterns("vendor", "__pycache__"))
    before = version(folder)
    start = folder / "start.js"
    start.write_text(start.read_text().replace("Mechanisms", "Mechanismz"))
    after = version(folder)
    os.utime(start, ns=(0, 0))  # as on another machine
    assert before != after == version(folder)
    assert after.encode() in page_file("index.html", folder).content


def test_the_report_that_the_operator_names_is_shown_and_carries_nothing_out(tmp_path):
    report = tmp_path / "report.html"
    with (
        serving(create_app(Settings(data=tmp_path / "data", report=report))) as url,
        client_of(url) as http,
    ):
        assert "No report" in http.get("/report").text
        report.write_text("<title>Published and computed</title>")
        answer = http.get("/report")
    assert answer.text == report.read_text()
    policy = answer.headers["Content-Security-Policy"]
    assert policy.startswith("default-src 'none'; style-src 'unsafe-inline'; img-src data:")
    assert policy.endswith("; sandbox")


@pytest.mark.parametrize(
    "name",
    [
        "none.js",
        "__init__.py",
        "../pyproject.toml",
        "%2e%2e/pyproject.toml",
        "views/",
        "/etc/passwd",
        "",
    ],
)
def test_what_is_no_file_of_the_page_is_not_found(http, name):
    answer = http.get(f"/page/{name}")
    assert answer.status_code == 404
    assert answer.json()["type"] == "/problems/not-found"


def test_the_first_page_is_small(http):
    """HTML, styles and every module that the start needs, as they go over the wire."""
    loaded, waiting = dict[str, int](), ["index.html", "start.js", "views/start.js"]
    waiting += re.findall(r'"/page/(.*?)"', (PAGE / "index.html").read_text())
    while waiting:
        name = waiting.pop()
        if name in loaded:
            continue
        answer = http.get(f"/page/{name}").raise_for_status()
        loaded[name] = len(answer.content)
        if name.endswith(".js"):
            imported = re.findall(r'^import .*?"(.*?)"|^} from "(.*?)"', answer.text, re.MULTILINE)
            here = (PAGE / name).parent
            waiting += [
                (here / (one or other)).resolve().relative_to(PAGE).as_posix()
                for one, other in imported
            ]
    assert len(loaded) > 15
    assert sum(loaded.values()) < 300_000


@pytest.mark.parametrize("path", OURS, ids=relative)
def test_modules_are_short_and_load_nothing_from_elsewhere(path):
    text = path.read_text()
    assert len(text.splitlines()) <= 300
    assert not re.search(r"https?://(?!www\.w3\.org)", text)
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(", text)
    if path.suffix == ".js":
        assert text.startswith("/**")
        imported = re.findall(r'(?: from |^import |import\()"(\..*?)"', text, re.MULTILINE)
        names = [os.path.relpath(path.parent / one, PAGE) for one in imported]
        by_hand = re.search(r'element\("button", {(?! type: "submit")|element\("thead"', text)
        assert not by_hand or path.name in {"button.js", "table.js"}
        assert [name for name in names if page_file(name) is None] == []
    if path.suffix == ".html":
        assert not re.search(r"<script>|<style|style=|\son\w+=", text)


@pytest.mark.parametrize(
    "folder", [PAGE / "vendor", Path(__file__).parent / "vendor"], ids=relative
)
def test_what_others_wrote_is_what_they_published(folder):
    listed = dict(
        reversed(line.split("  ", 1))
        for line in (folder / "checksums.txt").read_text().splitlines()
    )
    files = [path for path in folder.rglob("*") if path.is_file() and path.name != "checksums.txt"]
    assert {str(path.relative_to(folder)) for path in files} == listed.keys()
    for path in files:
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        assert listed[str(path.relative_to(folder))] == digest, path
