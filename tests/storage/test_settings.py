import os
from pathlib import Path

import pytest
from kombu import Connection
from pydantic import ValidationError
from pydantic_settings import SettingsError
from redis.connection import parse_url
from sqlalchemy import make_url

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from jointplay.storage.settings_files import mistyped_variables
from jointplay.storage.sqlite_address import sqlite_file
from jointplay.worker.app import broker_url


def test_everything_is_beside_the_data(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("JOINTPLAY_DATA", str(tmp_path))
    monkeypatch.setenv("JOINTPLAY_LEASE", "12.5")
    settings = Settings()
    assert settings.catalogue_url == f"sqlite:///{tmp_path}/catalogue.sqlite"
    assert settings.lease == 12.5
    job = "01M7YBSH1WSYHM7G141H5BWD2R"
    assert settings.results_url == f"file:{tmp_path}/results"
    assert settings.sealed_run(job, 2).key == f"2R/{job}-a2.zarr.zip"
    assert settings.running_run(job, 2).folder == tmp_path / "running" / "2R" / job / "a2"


@pytest.mark.parametrize("name", ["a%20b", "a?b", "a#b", "a%zz", "dä ta", "a+b&c=d;e@f:g"])
def test_a_data_folder_of_any_name_has_its_catalogue_in_it(tmp_path: Path, name: str) -> None:
    """A part of the name that means something in addresses put the catalogue beside the folder."""
    folder = tmp_path / name
    folder.mkdir()
    catalogue = Catalogue(Settings(data=folder).catalogue_url)
    catalogue.migrate()
    catalogue.close()
    assert (folder / "catalogue.sqlite").is_file()
    assert sqlite_file(Settings(data=folder).catalogue_url) == folder / "catalogue.sqlite"
    assert [one.name for one in tmp_path.iterdir()] == [name]


def test_running_jobs_are_those_of_whose_files_there_are_some(tmp_path: Path) -> None:
    job = "01KZJ9W6P1M3QX8Y5T7R4B9C2R"
    here = Settings(data=tmp_path, running="results", results_url=f"file:{tmp_path}/results")
    for key in ("running/read-me", "running/2R/read-me", f"running/2R/{job}/a1/documents.zip"):
        here.object_store.replace(key, [b"anything"])
    assert here.running_jobs() == [job]


def test_a_relative_folder_means_the_same_in_every_process(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    assert Settings(data=Path("here")).data == tmp_path / "here"


@pytest.mark.parametrize(
    ("name", "value", "complaint"),
    [
        ("JOINTPLAY_LEASE", "6", "at least twice JOINTPLAY_HEARTBEAT"),
        ("JOINTPLAY_LEASE", "nan", "finite number"),
        ("JOINTPLAY_REAPER_PERIOD", "0", "greater than 0"),
        ("JOINTPLAY_REDIS_URL", "localhost:6379", "redis://host:6379/0"),
        ("JOINTPLAY_REDIS_URL", "", "redis://host:6379/0"),
        ("JOINTPLAY_MAX_ATTEMPTS", "many", "integer"),
        ("JOINTPLAY_CATALOGUE_URL", "mysql://localhost/jobs", "postgresql://user@host/jointplay"),
    ],
)
def test_impossible_settings_are_refused(
    monkeypatch: pytest.MonkeyPatch, name: str, value: str, complaint: str
) -> None:
    monkeypatch.setenv(name, value)
    with pytest.raises(ValidationError, match=complaint):
        Settings()


@pytest.fixture
def file(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    monkeypatch.setenv("JOINTPLAY_SETTINGS", str(tmp_path / "settings"))
    return tmp_path / "settings"


@pytest.fixture
def folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    (tmp_path / "secrets").mkdir()
    monkeypatch.setenv("JOINTPLAY_SECRETS", str(tmp_path / "secrets"))
    return tmp_path / "secrets"


def test_the_environment_goes_before_files(
    monkeypatch: pytest.MonkeyPatch, file: Path, folder: Path
) -> None:
    monkeypatch.setenv("JOINTPLAY_LEASE", "40")
    file.write_text(f"# a lab\nJOINTPLAY_LEASE=50\nJOINTPLAY_HEARTBEAT=7\nJOINTPLAY_DATA={folder}")
    (folder / "jointplay_stall").write_text("9\n")
    (folder / "jointplay_heartbeat").write_text("8\n")
    settings = Settings()
    assert (settings.lease, settings.heartbeat, settings.stall) == (40.0, 7.0, 9.0)
    assert settings.catalogue_url == f"sqlite:///{folder}/catalogue.sqlite"


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("JOINTPLAY_LEESE=30", "jointplay_leese\n  Extra inputs"),
        ("PASSWORD=30", "password\n  Extra inputs"),
        ("JOINTPLAY_LEASE=6", "at least twice JOINTPLAY_HEARTBEAT"),
        ("JOINTPLAY_LEASE=nan", "finite number"),
    ],
)
def test_files_are_read_as_strictly_as_the_environment(
    file: Path, folder: Path, line: str, complaint: str
) -> None:
    file.write_text(line)
    with pytest.raises(ValidationError, match=complaint):
        Settings()
    file.write_text("")
    name, _, value = line.partition("=")
    (folder / name).write_text(value)
    if name == "PASSWORD":  # of another program
        Settings()
    else:
        with pytest.raises(ValidationError, match="(?i)" + complaint):
            Settings()


@pytest.mark.parametrize("name", ["JOINTPLAY_SETTINGS", "JOINTPLAY_SECRETS"])
def test_files_that_are_not_there_are_missed(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setenv(name, "/no/such/place")
    with pytest.raises(SettingsError, match=f"{name} is /no/such/place"):
        Settings()


def test_any_password_fits_into_an_address(
    monkeypatch: pytest.MonkeyPatch, file: Path, folder: Path
) -> None:
    file.write_text(
        "JOINTPLAY_CATALOGUE_URL=postgresql://lab@host/jointplay?sslmode=verify-full\n"
        "JOINTPLAY_REDIS_URL=rediss://host:6380/1\n"
    )
    odd = "p@ss/w:rd ?#%&"
    monkeypatch.setenv("AWS_ACCESS_KEY_ID", "of the environment")
    monkeypatch.setitem(os.environ, "AWS_SECRET_ACCESS_KEY", "")  # is taken away again
    del os.environ["AWS_SECRET_ACCESS_KEY"]
    for name in ("JOINTPLAY_CATALOGUE_PASSWORD", "JOINTPLAY_REDIS_PASSWORD"):
        (folder / name).write_text(f"{odd}\n")
    for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
        (folder / name).write_text("of a file")
    settings = Settings()
    catalogue = make_url(settings.catalogue_url)
    assert (catalogue.username, catalogue.password, catalogue.host) == ("lab", odd, "host")
    assert catalogue.query == {"sslmode": "verify-full"}
    redis = parse_url(settings.redis_url or "")
    assert (redis["password"], redis["host"], redis["port"], redis["db"]) == (odd, "host", 6380, 1)
    assert Connection(broker_url(settings.redis_url)).password == odd
    # where the client of buckets looks
    assert os.environ["AWS_ACCESS_KEY_ID"] == "of the environment"
    assert os.environ["AWS_SECRET_ACCESS_KEY"] == "of a file"


def test_variables_of_others_are_not_taken_for_settings(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("REPORTT", "PORT", "PORT_80_TCP", "SERVICE_HOST", "URL", "KEY", "CACHE", "SITE"):
        monkeypatch.setenv(f"JOINTPLAY_{name}", "of another")
    monkeypatch.setenv("jointplay_lease", "10")  # as settings may be written, too
    (told,) = mistyped_variables(Settings)
    assert told.startswith("JOINTPLAY_REPORTT is not a setting")
