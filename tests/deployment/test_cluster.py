"""Checks of the compose file for a cluster where no Docker engine runs."""

import importlib.util
import json
import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from jointplay.storage.places import place_at
from jointplay.storage.settings import Settings

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "compose.cluster.yml").read_text()
COMPOSE: dict[str, Any] = yaml.safe_load(TEXT)
SERVICES = COMPOSE["services"]
OURS = ("api", "relay", "worker")
SECRET = "a-secret"


def environment() -> dict[str, str]:
    """Return what compose gives our processes where all passwords are one."""
    given = SERVICES["api"]["environment"]
    return {name: re.sub(r"\$\{\w+:\?\}", SECRET, value) for name, value in given.items()}


def test_the_environment_is_one_that_our_processes_take(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in environment().items():
        monkeypatch.setenv(name, value)
    settings = Settings()
    assert settings.catalogue_url == f"postgresql://jointplay:{SECRET}@postgres/jointplay"
    assert settings.place is place_at(settings.results_url)
    assert settings.keys == "required"
    ours = {name for name in environment() if name.startswith("JOINTPLAY_")}
    assert ours <= {f"JOINTPLAY_{field.upper()}" for field in Settings.model_fields}
    assert all(SERVICES[name]["environment"] == SERVICES["api"]["environment"] for name in OURS)


def test_no_password_is_in_the_file_and_none_may_be_left_out() -> None:
    for name in ("POSTGRES_PASSWORD", "REDIS_PASSWORD", "S3_SECRET"):
        assert f"${{{name}:?}}" in TEXT
    assert set(re.findall(r"\$\{[^}]*\}", TEXT)) == {
        "${POSTGRES_PASSWORD:?}",
        "${REDIS_PASSWORD:?}",
        "${S3_SECRET:?}",
    }


def test_the_store_takes_the_key_that_our_processes_have() -> None:
    (identity,) = json.loads(COMPOSE["configs"]["s3"]["content"])["identities"]
    given = SERVICES["api"]["environment"]
    assert identity["credentials"] == [
        {
            "accessKey": given["AWS_ACCESS_KEY_ID"],
            "secretKey": given["AWS_SECRET_ACCESS_KEY"],
        }
    ]


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
