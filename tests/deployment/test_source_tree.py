"""The tree of the sources as editors and package builders read it."""

import os
import re
import subprocess
import sys
import tarfile
from pathlib import Path
from zipfile import ZipFile

import jedi
import pytest

from tests.deployment.test_containers import ROOT

IMPORTED = re.compile(r"from jointplay\.(solver\.kernels\.[\w.]+) import (\w+)")


def test_editors_find_what_is_imported() -> None:
    """From runs into kernels: the first import of each file."""
    project = jedi.Project(ROOT, smart_sys_path=False)
    found = 0
    for path in sorted((ROOT / "solver" / "runs").glob("*.py")):
        text = path.read_text()
        first = IMPORTED.search(text)
        if first is None:
            continue
        line = text.count("\n", 0, first.start()) + 1
        column = first.end() - 1 - text.rindex("\n", 0, first.end()) - 1
        there = jedi.Script(path=path, project=project).goto(line, column, follow_imports=True)
        places = {Path(str(one.module_path)).resolve() for one in there}
        assert places == {ROOT / Path(*first[1].split(".")).with_suffix(".py")}
        found += 1
    assert found > 3


def test_a_copy_without_symbolic_links_says_what_is_missing(tmp_path: Path) -> None:
    """As git leaves them on Windows outside Developer Mode."""
    package = tmp_path / "jointplay"
    package.mkdir()
    for file in (ROOT / "src" / "jointplay").iterdir():
        if file.is_symlink():
            (package / file.name).write_text(str(file.readlink()))
        elif file.is_file():
            (package / file.name).write_bytes(file.read_bytes())
    command = [sys.executable, "-c", "import jointplay.solver"]
    ended = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert ended.returncode == 1
    assert "core.symlinks=true" in ended.stderr


@pytest.mark.long
def test_a_wheel_of_the_source_distribution_is_that_of_the_tree(tmp_path: Path) -> None:
    build = "from setuptools import build_meta as b; print(b.build_{}({!r}))"
    script = [sys.executable, "-c"]
    made, options = tmp_path / "made", tmp_path / "options.cfg"
    options.write_text(f"[build]\nbuild_base = {tmp_path / 'build'}\n")  # the tree's has old files
    environment = os.environ | {"DIST_EXTRA_CONFIG": str(options)}
    for what in ("sdist", "wheel"):
        command = [*script, build.format(what, str(made))]
        subprocess.run(command, cwd=ROOT, env=environment, check=True)
    (archive,), (wheel,) = made.glob("*.tar.gz"), made.glob("*.whl")
    with tarfile.open(archive) as packed:
        packed.extractall(tmp_path, filter="data")
    (unpacked,) = tmp_path.glob("jointplay-*")
    again = tmp_path / "again"
    subprocess.run([*script, build.format("wheel", str(again))], cwd=unpacked, check=True)
    (other,) = again.glob("*.whl")
    assert set(ZipFile(other).namelist()) == set(ZipFile(wheel).namelist())
