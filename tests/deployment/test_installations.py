"""The product, installed in each of two ways, in a folder full of misleading names.

Every package and every module of the standard library, of the dependencies and of our own has a
namesake there, which notes that it was imported and fails.
"""

import json
import os
import subprocess
import sys
import venv
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import packages_distributions
from pathlib import Path
from zipfile import ZipFile

import pytest
import typer

from jointplay.command_line.application import EXTRAS, application
from tests.command_line.test_every_command import commands_of
from tests.deployment.test_containers import ROOT, instructions

BUILD = ROOT / "build"
ROOMS = {path.parent.name for path in ROOT.glob("*/__init__.py")}
STANDARD = sys.stdlib_module_names
TRAP = """\
from pathlib import Path
Path(__file__).with_name("imported").open("a").write(__name__ + "\\n")
raise ImportError(f"the current folder's {__name__} was imported")
"""


@dataclass(frozen=True)
class Installation:
    """The program as users start it, and the Python that it runs with."""

    program: Path
    python: Path

    def environment(self) -> dict[str, str]:
        """Return this process's environment, with nothing that leads elsewhere."""
        return {name: value for name, value in os.environ.items() if "PYTHON" not in name}

    def call(self, *command: object, folder: Path) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [str(part) for part in command],
            cwd=folder,
            env=self.environment(),
            capture_output=True,
            text=True,
        )

    def jointplay(self, *arguments: object, folder: Path) -> str:
        """Run a command and return what it prints."""
        ended = self.call(self.program, *arguments, folder=folder)
        assert ended.returncode == 0, ended.stderr
        return ended.stdout


def wheel(folder: Path, *extras: str) -> Path:
    """Build a wheel from the files that the image is made of, and packages of extras."""
    sources = folder / "sources"
    sources.mkdir()
    copied = [word for line in instructions("COPY") for word in line.split()[:-1]]
    words = (str(ROOT / word) for word in (*copied, *extras))
    subprocess.run(["cp", "-r", *words, sources], check=True)
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-index"]
    command += ["--no-build-isolation", "--wheel-dir", str(folder), str(sources)]
    subprocess.run(command, check=True)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return wheel(tmp_path_factory.mktemp("wheel"))


def installed(wheel: Path) -> Installation:
    """Install a wheel into an environment that borrows its dependencies from this one."""
    place = BUILD / "installed"
    venv.create(place, clear=True)
    command = [sys.executable, "-m", "pip", "--python", str(place), "install", "--quiet"]
    command += ["--no-deps", "--no-index", str(wheel)]
    subprocess.run(command, check=True)
    own = next(place.glob("lib/python*/site-packages"))
    borrowed = Path(typer.__file__).parents[1]
    (own / "dependencies.pth").write_text(f"{borrowed}\n")
    return Installation(place / "bin" / "jointplay", place / "bin" / "python")


@pytest.fixture(scope="module", params=[pytest.param("editable", marks=pytest.mark.long), "wheel"])
def installation(request: pytest.FixtureRequest) -> Installation:
    if request.param == "editable":
        program = Path(sys.executable).with_name("jointplay")
        return Installation(program, Path(sys.executable))
    return installed(request.getfixturevalue("built"))


@pytest.fixture(scope="module")
def folder(installation: Installation, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    made = tmp_path_factory.mktemp("misleading")
    for name in ROOMS | {"jointplay", "migrations"}:
        (made / name).mkdir()
        (made / name / "__init__.py").write_text(TRAP)
    folders = ROOMS | {"src/jointplay"}
    ours = {path.stem for room in folders for path in (ROOT / room).rglob("[a-z]*.py")}
    names = STANDARD | set(packages_distributions()) | ours | {"celeryconfig", "sitecustomize"}
    for name in names - ROOMS - {"jointplay"}:
        (made / f"{name}.py").write_text(TRAP)
    yield made
    imported = made / "imported"
    assert not imported.exists(), imported.read_text()


@pytest.fixture(scope="module")
def url(installation: Installation, folder: Path) -> Iterator[str]:
    command = [installation.program, "serve", "--json", "--port", "0", "--workers", "1"]
    with subprocess.Popen(
        [*command, "--data", "data"],
        cwd=folder,
        env=installation.environment(),
        stdout=subprocess.PIPE,
        text=True,
    ) as service:
        assert service.stdout is not None
        try:
            yield json.loads(service.stdout.readline())["url"]
        finally:
            service.terminate()
    assert service.returncode == 0


def test_the_program_and_its_data_come_from_the_installation(
    installation: Installation, folder: Path
) -> None:
    program = "import jointplay.solver.scene, sys; print(jointplay.__path__, sys.path)"
    found = installation.call(installation.python, "-P", "-c", program, folder=folder)
    place = str(BUILD / "installed") if "build" in str(installation.python) else str(ROOT)
    assert place in found.stdout.split("]")[0], found.stderr


@pytest.mark.parametrize("installation", ["wheel"], indirect=True)
@pytest.mark.parametrize(("command", "extra"), EXTRAS.items())
def test_without_an_extra_its_command_says_so(
    installation: Installation, folder: Path, command: str, extra: str
) -> None:
    ended = installation.call(installation.program, command, "--seed", 7, folder=folder)
    said = f"`jointplay {command}` needs jointplay.{extra}: pip install 'jointplay[{extra}]'"
    assert (ended.returncode, ended.stderr) == (2, f"jointplay: {said}\n")


FIT = "--fit stiffness=1e8:1e11:log --target bearing.normal_force@0:0.018=834"
ALONE = [
    "run pendulum --duration 0.2 -o alone",
    "run pendulum --sweep mass=1:2:65 --duration 0.02 --processes 2 -o spread",
    "doctor alone",
    "verify alone",
    "accuracy pendulum --duration 0.01",
    f"calibrate bouncing-journal {FIT} --population 10 --generations 1 --processes 2",
    "openapi",
    "cite",
    "key new --owner ada --data keys",
    "key ls --data keys",
    "laws",
    "scene list",
    "scene schema",
    "scene show pendulum",
    "scene check pendulum",
    "scene draw pendulum -o pendulum.png",
]
ASKING = [
    "submit pendulum --duration 0.3 --estimate",
    "batch jobs.json --wait",
    "ls",
    "show JOB",
    "export JOB --channels angle",
    "plot JOB -o .",
    "compare JOB JOB -o both.png",
    "certificate JOB",
    "cite JOB",
    "cancel JOB",
    "delete JOB",
]
SPREAD = ALONE[1]
SAMPLED = {
    "run pendulum --duration 0.2 -o alone",
    "verify alone",
    "openapi",
    "laws",
    "scene draw pendulum -o pendulum.png",
    "batch jobs.json --wait",
    "export JOB --channels angle",
    "plot JOB -o .",
}
"""In the short suite: those that draw, export, fetch and read what the package holds; the study
runs in a folder of rooms."""
ELSEWHERE = {"demo", "reproduce", "chaos", "key revoke", "retry", "sensitivity", "worker"}
"""Start what the others start too, services and processes, but for minutes, or need to know what
another command said: see their own tests."""


def test_every_command_is_tried_here() -> None:
    lines = [line.split() for line in ALONE + ASKING]
    words = {" ".join(line[: 2 if line[0] in ("key", "scene") else 1]) for line in lines}
    commands = dict(commands_of(typer.main.get_command(application)))
    assert words | ELSEWHERE | {"serve"} == set(commands)


@pytest.mark.parametrize(
    "line",
    [line if line in SAMPLED else pytest.param(line, marks=pytest.mark.long) for line in ALONE],
)
def test_a_command_runs_here(installation: Installation, folder: Path, line: str) -> None:
    if line in ("doctor alone", "verify alone") and not (folder / "alone").exists():
        installation.jointplay(*ALONE[0].split(), folder=folder)
    installation.jointplay(*line.split(), folder=folder)


@pytest.mark.parametrize(
    "lines",
    [
        pytest.param([line for line in ASKING if line in SAMPLED], id="a sample"),
        pytest.param(ASKING, id="all", marks=pytest.mark.long),
    ],
)
def test_commands_that_need_a_service_run_against_one_started_here(
    installation: Installation, folder: Path, url: str, lines: list[str]
) -> None:
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.2}
    (folder / "jobs.json").write_text(json.dumps([job]))
    submitted = ["submit", "pendulum", "--duration", "0.1", "--wait", "--url", url]
    job_id = installation.jointplay(*submitted, folder=folder).strip()
    for line in lines:
        arguments = [job_id if word == "JOB" else word for word in line.split()]
        installation.jointplay(*arguments, "--url", url, folder=folder)


def test_a_folder_called_like_a_room_does_no_harm_to_python_m(
    installation: Installation, tmp_path: Path
) -> None:
    """Python itself puts the current folder first: only names below `jointplay` are safe."""
    for name in ROOMS:
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(TRAP)
    ended = installation.call(
        installation.python, "-m", "jointplay", *SPREAD.split(), folder=tmp_path
    )
    assert ended.returncode == 0, ended.stderr


def test_a_wheel_holds_one_package_with_everything_that_is_read(tmp_path: Path) -> None:
    names = set(ZipFile(wheel(tmp_path, *EXTRAS.values())).namelist())
    held = {name for name in names if ".dist-info/" not in name}
    assert {name.partition("/")[0] for name in held} == {"jointplay"}
    tracked = subprocess.run(
        ["git", "ls-files", "-z", *ROOMS, "src"], cwd=ROOT, capture_output=True, text=True
    ).stdout.split("\0")
    read = {
        name.removeprefix("src/") if name.startswith("src/") else f"jointplay/{name}"
        for name in tracked
        if name and not (ROOT / name).is_symlink()
    }
    assert held == {name for name in read if not name.endswith((".mako", ".md"))}
