"""The commands, programs and notebooks that explain, run as they stand, against a real service."""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from jointplay.service.processes import running_service

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
            "calibration",
        )
    ),
]
BLOCK = re.compile(r"^```(bash|python)\n(.*?)^```", re.DOTALL | re.MULTILINE)
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
BLOCKS = [block for page in PAGES for block in BLOCK.findall(page)]


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running_service(tmp_path_factory.mktemp("readme") / "data") as url:
        yield url


@pytest.mark.parametrize(("language", "text"), BLOCKS, ids=[text.split()[0] for _, text in BLOCKS])
def test_what_the_documentation_says_works(language, text, service, tmp_path):
    if "curl" in text and shutil.which("curl") is None:
        pytest.skip("this machine has no curl")
    text = text.replace("http://127.0.0.1:8000", service)
    shell = ["bash", "-euo", "pipefail", "-c"]
    command = [*shell, text] if language == "bash" else [sys.executable, "-c", text]
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    ended = subprocess.run(
        command,
        cwd=tmp_path,
        env=os.environ | {"PATH": path, "JOINTPLAY_URL": service},
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 0, ended.stderr
    for made in re.findall(r"(?:-o|>) ([\w-]+(?:\.\w+)?)(?=[;\s]|$)", text):
        assert (tmp_path / made).exists(), made


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_from_its_first_to_its_last_cell(notebook, service, tmp_path):
    written = json.loads(notebook.read_text())
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
    for link in re.findall(r"\]\(([^)#]+)\)", README):
        assert (ROOT / link).is_file(), link


def test_every_target_that_the_readme_names_is_in_the_makefile():
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"make ([a-z-]+) ", README):
        assert f"\n{target}:" in makefile, target
