"""Checks of the compose file for a cluster where no Docker engine runs."""

import importlib.util
import os
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml
from redis.connection import parse_url
from sqlalchemy import make_url

from jointplay.storage.object_stores import object_store_at
from jointplay.storage.settings import Settings

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "compose.cluster.yml").read_text()
COMPOSE: dict[str, Any] = yaml.safe_load(TEXT)
SERVICES = COMPOSE["services"]
OURS = ("api", "relay", "worker")
SECRETS = {name: f"p@ss/{name}" for name in COMPOSE["secrets"]}


def test_the_environment_and_its_files_are_ones_that_our_processes_take(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    api = SERVICES["api"]
    given: dict[str, str] = api["environment"]
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "")  # is taken away again
    del os.environ["AWS_SECRET_ACCESS_KEY"]
    for name, value in given.items():
        monkeypatch.setenv(name, value)
    assert given["JOINTPLAY_SECRETS"] == "/run/secrets"
    monkeypatch.setenv("JOINTPLAY_SECRETS", str(tmp_path))
    for secret in api["secrets"]:
        (tmp_path / secret["target"]).write_text(f"{SECRETS[secret['source']]}\n")
    settings = Settings()
    catalogue = make_url(settings.catalogue_url)
    assert (catalogue.host, catalogue.password) == ("postgres", SECRETS["postgres"])
    assert parse_url(settings.redis_url or "")["password"] == SECRETS["redis"]
    assert os.environ["AWS_SECRET_ACCESS_KEY"] == SECRETS["s3"]
    assert settings.object_store is object_store_at(settings.results_url)
    assert settings.keys == "required"
    ours = {name for name in given if name.startswith("JOINTPLAY_")} - {"JOINTPLAY_SECRETS"}
    assert ours <= {f"JOINTPLAY_{field.upper()}" for field in Settings.model_fields}
    for name in OURS:
        assert SERVICES[name]["environment"] == given
        assert SERVICES[name]["secrets"] == api["secrets"]


def test_no_password_is_in_the_file_or_the_environment() -> None:
    assert "${" not in TEXT
    assert {one["file"] for one in COMPOSE["secrets"].values()} == {
        f"secrets/{name}" for name in SECRETS
    }
    for name in SECRETS:
        assert SERVICES[name]["secrets"] == [name]
    assert SERVICES["postgres"]["environment"]["POSTGRES_PASSWORD_FILE"] == "/run/secrets/postgres"


@pytest.mark.parametrize("name", ["redis", "s3"])
def test_a_shell_hands_the_secret_to_the_server(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("p@ss 'w\"rd\n")
    script = tmp_path / "server"
    script.write_text('#!/bin/sh\nprintf "%s\\n" "$AWS_SECRET_ACCESS_KEY" "$@"\n')
    script.chmod(0o700)
    _, _, line, *rest = SERVICES[name]["entrypoint"]
    line = line.replace("$$", "$").replace("/run/secrets", str(tmp_path))
    line = re.sub(r"\S*entrypoint\.sh", str(script), line)
    started = ["sh", "-c", line, *rest, *SERVICES[name]["command"]]
    environment = {"PATH": os.environ["PATH"]}
    ran = subprocess.run(started, capture_output=True, text=True, check=True, env=environment)
    secret, *arguments = ran.stdout.splitlines()
    if name == "redis":
        assert arguments == [*SERVICES[name]["command"], "--requirepass", "p@ss 'w\"rd"]
    else:
        assert (secret, arguments) == ("p@ss 'w\"rd", SERVICES[name]["command"])
        given = SERVICES["api"]["environment"]["AWS_ACCESS_KEY_ID"]
        assert SERVICES[name]["environment"]["AWS_ACCESS_KEY_ID"] == given


def test_only_the_proxy_is_reachable_and_only_from_this_machine() -> None:
    assert SERVICES["proxy"]["ports"] == ["127.0.0.1:8000:8000"]
    assert [name for name in SERVICES if "ports" in SERVICES[name]] == ["proxy"]
    assert COMPOSE["networks"]["inside"]["internal"] is True
    assert [name for name in SERVICES if "outside" in SERVICES[name]["networks"]] == ["proxy"]


@pytest.mark.parametrize("name", OURS)
def test_commands_are_those_of_the_file_for_one_host(name: str) -> None:
    one_host = yaml.safe_load((ROOT / "docker-compose.yml").read_text())["services"][name]
    assert SERVICES[name]["command"] == one_host["command"]
    assert importlib.util.find_spec(SERVICES[name]["command"][2]) is not None


def test_the_image_has_what_a_cluster_needs() -> None:
    assert "'.[cluster]'" in (ROOT / "Dockerfile").read_text()
