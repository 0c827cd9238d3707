"""The commands, programs and notebooks that explain, run against a real service.

As they stand, but for numbers that say only how much is computed: those are small here, and as
printed in the long tests.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from jointplay.service.processes import running_service
from tests.forked_commands import forked_commands

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text()
PAGES = [
    README,
    *(
        (ROOT / "docs" / f"{name}.md").read_text()
        for name in (
            "http",
            "python",
            "certificate",
            "accuracy",
            "laws",
            "figures",
            "windows",
            "basins",
            "sensitivities",
            "periodic_orbits",
            "calibration",
        )
    ),
]
BLOCK = re.compile(r"^```(bash|python)\n(.*?)^```", re.DOTALL | re.MULTILINE)
NOTEBOOKS = [(path.stem, path.read_text()) for path in sorted((ROOT / "notebooks").glob("*.ipynb"))]
BLOCKS = [block for page in PAGES for block in BLOCK.findall(page)]
SHORTER = {
    "speed=3:9:48 --settle 40 --record 20": "speed=3:9:4 --settle 2 --record 4",
    "section --start 47 --stop 48": "section --start 3 --stop 4",
    "seven-bar-press --accuracy-study --duration 0.015": (
        "bouncing-journal --accuracy-study --duration 0.003"  # its five kernels compile faster
    ),
    "np.linspace(1e-4, 5e-4, 24)": "np.linspace(1e-4, 5e-4, 4)",
    "settle=20, record=20": "settle=2, record=10",
    '"count": 16}, "settle": 10': '"count": 8}, "settle": 2',
    "animation -o figures": "animation --frames-per-second 2 -o figures",
    "--rate 0.001": "--rate 0.001 --frames-per-second 2",
    '"generations": 20': '"generations": 3',
    "eccentricity/0=0.17:0.2:24 --by /start/joints/stop/rate/0=-0.5:0.5:24": (
        "eccentricity/0=0.17:0.2:8 --by /start/joints/stop/rate/0=-0.5:0.5:8"
    ),
    "--samples 400 --along speed=24:32:17": "--samples 40 --along speed=24:32:3",
}
"""Pieces of the texts, and how they stand in the tests that are not long."""


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running_service(tmp_path_factory.mktemp("readme") / "data") as url:
        yield url


@pytest.fixture(scope="module")
def environment(service: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """Variables that commands of the documentation find, and that `jointplay` is found by."""
    with forked_commands(tmp_path_factory.mktemp("commands") / "bin") as commands:
        path = (str(commands), str(Path(sys.executable).parent), os.environ["PATH"])
        yield os.environ | {"PATH": os.pathsep.join(path), "JOINTPLAY_URL": service}


def shortened(text: str) -> str:
    for printed, shorter in SHORTER.items():
        text = text.replace(printed, shorter)
    return text


def also_as_printed(texts: list[tuple[str, str]]) -> list[Any]:
    """Give each name and text shortened, and as printed to the long tests if that is another."""
    usual = [
        pytest.param(name, shortened(text), id=f"{name}{i}") for i, (name, text) in enumerate(texts)
    ]
    printed = [
        pytest.param(name, text, id=f"{name}{i} as printed", marks=pytest.mark.long)
        for i, (name, text) in enumerate(texts)
        if shortened(text) != text
    ]
    return usual + printed


def test_every_shortened_piece_is_printed_somewhere():
    printed = [text for _, text in (*BLOCKS, *NOTEBOOKS)]
    assert all(any(piece in text for text in printed) for piece in SHORTER)


def test_no_figure_of_a_block_is_written_over_an_earlier_one():
    for _, text in BLOCKS:
        drawn = []
        for command in re.findall(r"^jointplay plot (.*)$", text, re.MULTILINE):
            _, *names = re.split(r" -", command)[0].split()  # those of figures follow the results
            drawn += [(name, re.findall(r"-o (\S+)", command)) for name in names]
        assert all(drawn.count(one) == 1 for one in drawn), text


@pytest.mark.parametrize(("language", "text"), also_as_printed(BLOCKS))
def test_what_the_documentation_says_works(language, text, service, environment, tmp_path):
    if "curl" in text and shutil.which("curl") is None:
        pytest.skip("this machine has no curl")
    text = text.replace("http://127.0.0.1:8000", service)
    shell = ["bash", "-euo", "pipefail", "-c"]
    command = [*shell, text] if language == "bash" else [sys.executable, "-c", text]
    ended = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    for made in re.findall(r"(?:-o|>) ([\w-]+(?:\.\w+)?)(?=[;\s]|$)", text):
        assert (tmp_path / made).exists(), made


@pytest.mark.parametrize(("name", "text"), also_as_printed(NOTEBOOKS))
def test_a_notebook_runs_from_its_first_to_its_last_cell(name, text, service, tmp_path):
    notebook = tmp_path / f"{name}.ipynb"
    notebook.write_text(text)
    written = json.loads(text)
    cells = [cell for cell in written["cells"] if cell["cell_type"] == "code"]
    assert all((cell["outputs"], cell["execution_count"]) == ([], None) for cell in cells)
    program = (
        "import sys, nbclient, nbformat\n"
        "notebook = nbformat.read(sys.argv[1], as_version=4)\n"
        "nbformat.validate(notebook)\n"
        "nbclient.execute(notebook, cwd='.', kernel_name='python3')\n"
        "nbformat.write(notebook, 'executed.ipynb')\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, str(notebook)],
        cwd=tmp_path,
        env=os.environ | {"JOINTPLAY_URL": service},
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 0, ended.stderr
    executed = (tmp_path / "executed.ipynb").read_text()
    assert executed.count('"image/png"') >= 2  # figures are shown


def test_every_file_that_the_readme_names_is_there():
    links = re.findall(r"\]\(([^)#]+)\)", README)
    assert {"docs/tutorial.md", "notebooks/first_job.ipynb"} <= set(links)
    for link in links:
        assert (ROOT / link).is_file(), link


def test_every_target_that_the_readme_names_is_in_the_makefile():
    makefile = (ROOT / "Makefile").read_text()
    targets = re.findall(r"make ([a-z-]+)[ `]", README)
    assert {"demo", "test", "docs", "install"} <= set(targets)
    for target in targets:
        assert f"\n{target}:" in makefile, target
