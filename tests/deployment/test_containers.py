"""Checks of image and compose file where no Docker engine runs."""

import importlib.util
import os
import re
import shlex
import subprocess
import sys
import venv
from pathlib import Path
from typing import Any

import pytest
import yaml

from jointplay.command_line.application import EXTRAS
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from jointplay.storage.settings import Settings
from jointplay.worker.warm import without_parameters

ROOT = Path(__file__).resolve().parents[2]
COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
DOCKERFILE = (ROOT / "Dockerfile").read_text().replace("\\\n", " ")
OURS = ("api", "relay", "worker")


def instructions(name: str) -> list[str]:
    return re.findall(rf"^{name} (.+)$", DOCKERFILE, re.MULTILINE)


def test_one_image_one_volume_one_redis() -> None:
    services = COMPOSE["services"]
    assert set(services) == {"redis", *OURS}
    assert {services[name]["image"] for name in OURS} == {"jointplay"}
    assert {tuple(services[name]["volumes"]) for name in OURS} == {("data:/data",)}
    for name in OURS:
        assert services[name]["environment"] == services["api"]["environment"]


def test_workers_can_be_scaled() -> None:
    worker = COMPOSE["services"]["worker"]
    assert "container_name" not in worker
    assert "ports" not in worker


def test_only_the_api_is_reachable_and_only_from_this_machine() -> None:
    services = COMPOSE["services"]
    assert services["api"]["ports"] == ["127.0.0.1:8000:8000"]
    assert [name for name in services if "ports" in services[name]] == ["api"]
    assert COMPOSE["networks"]["inside"]["internal"] is True


@pytest.mark.parametrize("name", OURS)
def test_every_command_is_a_module_of_ours(name: str) -> None:
    command = COMPOSE["services"][name]["command"]
    assert command[:2] == ["python", "-m"]
    assert importlib.util.find_spec(command[2]) is not None
    options = {part for part in command[3:] if part.startswith("--")}
    if options:
        asked = [sys.executable, "-m", command[2], "--help"]
        ran = subprocess.run(asked, capture_output=True, text=True, check=True)
        assert all(option in ran.stdout for option in options)


def test_every_variable_is_a_setting() -> None:
    named = set(COMPOSE["services"]["api"]["environment"])
    settings = {f"JOINTPLAY_{field.upper()}" for field in Settings.model_fields}
    assert named <= settings


def test_redis_never_drops_a_message_and_stores_none() -> None:
    command = COMPOSE["services"]["redis"]["command"]
    options = dict(zip(command[1::2], command[2::2], strict=True))
    assert options == {"--appendonly": "no", "--save": "", "--maxmemory-policy": "noeviction"}


def test_the_image_holds_every_package_but_extras() -> None:
    copied = {word for line in instructions("COPY") for word in line.split()[:-1]}
    packages = {
        path.parent.name for path in ROOT.glob("*/__init__.py") if path.parent.name != "tests"
    }
    assert packages - copied == {*EXTRAS.values()}
    assert all((ROOT / name).exists() for name in copied)


@pytest.mark.parametrize(
    "names", [["pendulum", "seven-bar-press"], pytest.param([], marks=pytest.mark.long)]
)
def test_what_was_compiled_is_used(names: list[str]) -> None:
    warm = [sys.executable, "-m", "jointplay.worker.warm", *names]
    subprocess.run(warm, check=True, capture_output=True, cwd=ROOT)
    checked = subprocess.run([*warm, "--check"], capture_output=True, text=True, cwd=ROOT)
    assert checked.returncode == 0, checked.stdout


def test_presets_that_need_no_parameters_are_compiled() -> None:
    for name in presets.names():
        job = {"kind": "simulate", "scene": {"preset": name}, "duration": 1e-3}
        if name in without_parameters():
            admit(job)
        else:
            with pytest.raises(InvalidInput, match="must be given"):
                admit(job)


@pytest.mark.long
def test_the_builds_steps_run(tmp_path: Path) -> None:
    """Run the RUN steps but for the making of the user, in a folder of the copied files."""
    copied = [line.split() for line in instructions("COPY")]
    subprocess.run(
        ["cp", "-r", *(str(ROOT / word) for words in copied for word in words[:-1]), tmp_path],
        check=True,
    )
    venv.create(tmp_path / "venv", with_pip=True)
    environment = {
        "PATH": f"{tmp_path / 'venv' / 'bin'}:{os.environ['PATH']}",
        "HOME": str(tmp_path),
        "JOINTPLAY_CACHE": str(tmp_path / "kernels"),
        "NUMBA_CPU_FEATURES": "",
        "NUMBA_CPU_NAME": "x86-64-v3" if os.uname().machine == "x86_64" else "generic",
    }
    for step in instructions("RUN"):
        if "useradd" in step:
            continue
        home = tmp_path if step.startswith("pip") else tmp_path / "venv"
        subprocess.run(shlex.join(["sh", "-ec", step]), shell=True, check=True, cwd=home,
                       env=environment)  # fmt: skip


@pytest.mark.parametrize("change", ["", "commands: {}\n"])
def test_compose_files_are_of_the_schema_of_compose(change: str, tmp_path: Path) -> None:
    pytest.importorskip("check_jsonschema")
    check = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.compose-spec"]
    for name in ("docker-compose.yml", "compose.cluster.yml"):
        (tmp_path / name).write_text((ROOT / name).read_text() + change)
        ran = subprocess.run([*check, tmp_path / name], capture_output=True, text=True)
        assert ran.returncode == bool(change), ran.stdout + ran.stderr
