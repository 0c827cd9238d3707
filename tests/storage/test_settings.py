from pathlib import Path

import pytest
from pydantic import ValidationError

from jointplay.storage.settings import Settings


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


def test_running_jobs_are_those_of_whose_files_there_are_some(tmp_path: Path) -> None:
    job = "01KZJ9W6P1M3QX8Y5T7R4B9C2R"
    here = Settings(data=tmp_path, running="results", results_url=f"file:{tmp_path}/results")
    for key in ("running/read-me", "running/2R/read-me", f"running/2R/{job}/a1/documents.zip"):
        here.place.replace(key, [b"anything"])
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
