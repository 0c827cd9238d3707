"""The site of the documentation: it builds, its links lead somewhere, it needs no other server."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.solver.joints import JOINTS, Gear
from jointplay.solver.scene import channels

ROOT = Path(__file__).resolve().parents[2]
LOADED = re.compile(r'<(?:script|img|link|iframe)\b[^>]*\b(?:src|href)="((?:https?:)?//[^"]*)"')
PAGES = [page.relative_to(ROOT / "docs") for page in sorted((ROOT / "docs").rglob("*.md"))]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    built = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr  # a link or an anchor that leads nowhere is named
    return folder


def test_every_page_is_in_the_site_and_in_its_menu(site: Path) -> None:
    menu = (ROOT / "mkdocs.yml").read_text()
    for page in PAGES:
        assert (site / page.with_suffix(".html")).is_file()
        assert f": {page.as_posix()}\n" in menu, page


def test_nothing_is_loaded_from_another_server(site: Path) -> None:
    for page in site.rglob("*.html"):
        assert not LOADED.findall(page.read_text()), page.name
    styles = [path.read_text() for path in site.rglob("*.css")]
    assert not any(re.search(r"url\(['\"]?(https?:)?//", text) for text in styles)


def test_the_reference_has_what_the_client_can_do(site: Path) -> None:
    reference = (site / "reference.html").read_text()
    for name in ("client.client.Client.submit", "client.job.Job.figure", "local.running.run"):
        assert f'id="jointplay.{name}"' in reference
    for kind in ("simulate", "accuracy_study"):  # whatever makes these functions
        for name in (f"jobs.{kind}", f"client.client.Client.{kind}"):
            assert f'id="jointplay.{name}"' in reference
    assert "Draw a figure" in reference


def test_the_page_on_channels_names_every_quantity() -> None:
    page = (ROOT / "docs" / "channels.md").read_text()
    names = ("BODY", "JOINT", "MOMENT", "PLAY", "WALL", "ENERGY")
    tables = [Gear.channels, *(getattr(channels, name) for name in names)]
    tables += [joint.ideal_channels for joint in JOINTS.values()]
    quantities = {name for table in tables for name, _, _ in table}
    assert [name for name in sorted(quantities) if f"{name}`" not in page] == []
