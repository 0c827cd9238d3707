"""Settings all processes of the service share, ``JOINTPLAY_*`` in the environment or in files."""

import os
import re
import shutil
from pathlib import Path
from typing import Annotated, Final, Literal, Self

from pydantic import Field, field_validator, model_validator
from pydantic_settings import BaseSettings, PydanticBaseSettingsSource, SettingsConfigDict

from jointplay.records.log_lines import LogFormat
from jointplay.storage.object_stores import ObjectStore, StoredObject, object_store_at
from jointplay.storage.packed.running import Running
from jointplay.storage.running_files import RunningFiles
from jointplay.storage.running_files.folder import InFolder
from jointplay.storage.running_files.objects import InObjectStore
from jointplay.storage.settings_files import named_files, with_password
from jointplay.storage.sqlite_address import sqlite_address

RUNNING: Final = "running"
"""Folder of jobs that run, or beginning of their keys."""
OF_A_JOB: Final = 3
"""Slashes at least in the key of what a running job needs, such as running/XX/ID/a1/documents."""

LONGEST_PERIOD: Final = 600.0  # s
Minutes = Annotated[float, Field(gt=0, le=LONGEST_PERIOD)]
Hour = Annotated[float, Field(gt=0, le=3600)]
Centuries = Annotated[float, Field(gt=0, le=1e10)]


class Settings(BaseSettings):
    """Where things are, and how patient the platform is; all durations are in seconds.

    A lease must outlive several heartbeats, otherwise one slow disk write looks like a death.
    """

    model_config = SettingsConfigDict(
        env_prefix="JOINTPLAY_", frozen=True, extra="forbid", allow_inf_nan=False
    )

    data: Path = Field(
        Path(".jointplay"), description="Folder of the catalogue, the results, the logs."
    )
    catalogue_url: str = Field(
        "",
        description="SQLAlchemy URL of the catalogue, sqlite:///FILE or postgresql://USER@HOST/NAME;"
        " empty: SQLite inside the data folder.",
    )
    catalogue_password: str = Field(
        "", description="Password of PostgreSQL, kept out of its address."
    )
    results_url: str = Field(
        "",
        description="Object store of finished results, such as file:/srv/results; empty: the folder"
        " `results` inside the data folder.",
    )
    running: Literal["", "data", "results"] = Field(
        "",
        description="Where jobs are that run: in the data folder, which all machines then share, or"
        " in the object store, to which each worker sends what it computes in a folder of its own;"
        " empty: there if it is S3.",
    )
    results_redirect: str = Field(
        "",
        max_length=2048,
        description="Address at which clients reach the store of a bucket, such as"
        " https://s3.example.org: whole stores are then sent from there, and large files of workers"
        " that joined to there; empty: by the API.",
    )
    redis_url: str | None = Field(
        None,
        description="redis://host:port/0 or unix:///path; none: `jointplay serve` starts one.",
    )
    redis_password: str = Field("", description="Password of Redis, kept out of its address.")
    aws_access_key_id: str = Field(
        "", validation_alias="AWS_ACCESS_KEY_ID", description="Key of a bucket."
    )
    aws_secret_access_key: str = Field(
        "", validation_alias="AWS_SECRET_ACCESS_KEY", description="Its secret."
    )
    keys: Literal["", "none", "required"] = Field(
        "",
        description="Whether the API asks for keys; empty: unless it listens on this machine only.",
    )
    hosts: str = Field(
        "",
        max_length=4096,
        description="Names, separated by commas, under which an API that asks for no keys may be"
        " reached beside localhost and its addresses.",
    )
    report: Path | None = Field(
        None,
        description="File report.html that `jointplay reproduce` wrote: the API shows it at"
        " /report; none: that page tells how to make one.",
    )
    rate: float = Field(
        0.0, ge=0, le=1e6, description="Requests a second of one owner of keys; 0: any number."
    )
    most_live: int = Field(
        0, ge=0, le=10**9, description="Jobs of one owner that have not ended; 0: any number."
    )
    most_running: int = Field(
        0,
        ge=0,
        le=10**9,
        description="Blocks of one owner that are computed at one time; 0: any number.",
    )
    device: str = Field(
        "cpu",
        pattern=r"^(cpu|auto|host|cuda:\d{1,4})$",
        description="What workers compute points of studies on: cpu, or cuda:0, the first graphics"
        " processor; auto: the first that is made for double precision, else cpu; host: a trial"
        " without a card.",
    )
    most_stored: int = Field(
        0, ge=0, le=2**60, description="Bytes of results of one owner; 0: any number."
    )
    most_computed: float = Field(
        0.0,
        ge=0,
        le=1e12,
        description="Core seconds of one owner in the last 24 hours, the time that workers, each of"
        " one core, held blocks; 0: any number.",
    )
    log_format: LogFormat = Field(
        "text", description="Lines of the logs: text, or json, an object each."
    )
    lease: Hour = Field(30.0, description="A block whose worker is silent this long is lost.")
    heartbeat: Minutes = Field(5.0, description="A worker extends its lease this often.")
    progress_period: Minutes = Field(
        1.0, description="Progress and checkpoints are recorded this often."
    )
    reaper_period: Minutes = Field(1.0, description="Expired leases are looked for this often.")
    relay_period: Minutes = Field(
        0.5, description="The relay looks for work this often if not woken."
    )
    republish_after: Hour = Field(
        20.0, description="A wake-up without effect is sent again after this long."
    )
    relay_outstanding: int = Field(
        256, ge=1, le=100_000, description="Wake-ups that may wait in Redis at one time."
    )
    max_attempts: int = Field(
        3, ge=1, le=100, description="A block that lost its worker this often has failed."
    )
    keep: Centuries | None = Field(
        None, description="Jobs expire this long after their submission; none: they are kept."
    )
    longest: Centuries = Field(
        86_400.0,
        description="A run, or a block of a study, that computes longer fails with what it has.",
    )
    longest_compilation: Hour = Field(
        600.0, description="A job whose equations take longer to compile has failed."
    )
    reserve: int = Field(
        default=2**26,
        ge=0,
        le=2**40,
        description="Bytes of the data folder's disk that results leave to the catalogue; with"
        " less than twice as much no job is accepted.",
    )
    stall: float = Field(
        600.0,
        gt=0,
        le=86_400,
        description="A worker process that advances nothing for this long kills itself.",
    )

    @classmethod
    def settings_customise_sources(
        cls,
        settings_cls: type[BaseSettings],
        init_settings: PydanticBaseSettingsSource,
        env_settings: PydanticBaseSettingsSource,
        dotenv_settings: PydanticBaseSettingsSource,
        file_secret_settings: PydanticBaseSettingsSource,
    ) -> tuple[PydanticBaseSettingsSource, ...]:
        """Take what is given, then the environment, then the files that it names."""
        return init_settings, env_settings, *named_files(settings_cls)

    @model_validator(mode="before")
    @classmethod
    def _catalogue_beside_the_data(cls, values: dict[str, object]) -> dict[str, object]:
        data = Path(str(values.get("data") or cls.model_fields["data"].default)).absolute()
        url = values.get("catalogue_url") or sqlite_address(data / "catalogue.sqlite")
        results = values.get("results_url") or f"file:{data / 'results'}"
        if password := values.get("catalogue_password"):
            url = with_password(str(url), str(password))
        made = {"data": data, "catalogue_url": url, "results_url": results}
        if (redis := values.get("redis_url")) and (password := values.get("redis_password")):
            made["redis_url"] = with_password(str(redis), str(password))
        return values | made

    @field_validator("catalogue_url")
    @classmethod
    def _names_a_database(cls, url: str) -> str:
        if not url.startswith(("sqlite:///", "postgresql://", "postgresql+psycopg://")):
            raise ValueError(
                "give an address such as sqlite:////srv/catalogue.sqlite or"
                " postgresql://user@host/jointplay"
            )
        return url

    @field_validator("results_url")
    @classmethod
    def _names_an_object_store(cls, url: str) -> str:
        object_store_at(url)
        return url

    @field_validator("results_redirect")
    @classmethod
    def _names_a_server(cls, url: str) -> str:
        if url and not re.fullmatch(r"https?://[^/?#\s]+/?", url):
            raise ValueError(f"{url!r} is not an address such as https://s3.example.org")
        return url.rstrip("/")

    @field_validator("redis_url")
    @classmethod
    def _names_a_redis(cls, url: str | None) -> str | None:
        if url is not None and not url.startswith(("redis://", "rediss://", "unix://")):
            raise ValueError(f"{url!r} is not an address such as redis://host:6379/0")
        return url

    @model_validator(mode="after")
    def _lease_outlives_heartbeats(self) -> Self:
        if self.lease < 2 * self.heartbeat:
            raise ValueError(
                f"JOINTPLAY_LEASE is {self.lease:g} s; it must be at least twice"
                f" JOINTPLAY_HEARTBEAT ({self.heartbeat:g} s)"
            )
        return self

    @model_validator(mode="after")
    def _bucket_opens(self) -> Self:
        for name in ("aws_access_key_id", "aws_secret_access_key"):
            if value := getattr(self, name):  # the client of buckets looks there
                os.environ.setdefault(name.upper(), value)
        return self

    @property
    def host_names(self) -> frozenset[str]:
        """Further names of the API."""
        return frozenset(name.strip().lower() for name in self.hosts.split(",")) - {""}

    def room(self) -> int:
        """Bytes that results may still take on the data folder's disk; 0 or less: none."""
        return shutil.disk_usage(self.data).free - self.reserve

    @property
    def object_store(self) -> ObjectStore:
        """Where sealed results are kept."""
        return object_store_at(self.results_url)

    def results_prefix(self, job: str) -> str:
        """Return the beginning of the keys of all sealed results of a job.

        Grouped by the last two characters of the job's id: the first ones are its date, and
        would put every job of a year into one folder.
        """
        return f"{job[-2:]}/{job}-"

    def sealed_run(self, job: str, attempt: int) -> StoredObject:
        """Sealed results of one attempt at a simulation; need not be there."""
        return StoredObject(self.object_store, f"{self.results_prefix(job)}a{attempt}.zarr.zip")

    def sealed_study(self, job: str) -> StoredObject:
        """Sealed results of a study; need not be there."""
        return StoredObject(self.object_store, f"{self.results_prefix(job)}study.zarr.zip")

    @property
    def sends(self) -> bool:
        """Whether workers send what they compute, and what jobs need is nowhere else."""
        return self.running == "results" or (
            self.running == "" and self.results_url.startswith("s3:")
        )

    def running_files(self, job: str) -> RunningFiles:
        """Everything that a job needs while it runs."""
        if self.sends:
            return InObjectStore(self.object_store, f"{RUNNING}/{job[-2:]}/{job}")
        return InFolder(self.running_folder(job))

    def running_jobs(self) -> list[str]:
        """Jobs of which something is kept that they need while they run."""
        if self.sends:
            found = (key.split("/") for key in self.object_store.list(f"{RUNNING}/"))
            return sorted({parts[2] for parts in found if len(parts) > OF_A_JOB})
        return [folder.name for folder in sorted((self.data / RUNNING).glob("*/*"))]

    def running_folder(self, job: str) -> Path:
        """Folder of everything that a job needs where it is computed."""
        return self.data / RUNNING / job[-2:] / job

    def running_run(self, job: str, attempt: int) -> Running:
        """Growing results of one attempt at a simulation."""
        files = self.running_files(job).below(f"a{attempt}")
        return Running(files, self.sealed_run(job, attempt))

    def running_study(self, job: str) -> Running:
        """Growing results of a study, which all blocks and attempts of the job fill together."""
        return Running(self.running_files(job).below("study"), self.sealed_study(job))
