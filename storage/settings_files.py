"""Settings in files: one of lines ``NAME=VALUE``, and a folder with a file for each secret.

What the environment says goes before both. ``JOINTPLAY_SETTINGS`` and ``JOINTPLAY_SECRETS`` name
them, so that processes that others start find them, too.
"""

import os
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlsplit, urlunsplit

from pydantic_settings import (
    BaseSettings,
    DotEnvSettingsSource,
    PydanticBaseSettingsSource,
    SecretsSettingsSource,
    SettingsError,
)


class _Secrets(SecretsSettingsSource):
    """Files by the names of variables; others' secrets may be in the folder, too."""

    def __call__(self) -> dict[str, Any]:
        known = {
            str(field.validation_alias or f"{self.env_prefix}{name}").lower()
            for name, field in self.settings_cls.model_fields.items()
        }
        names = [path.name for path in Path(str(self.secrets_dir)).iterdir()]
        ours = [name for name in names if name.lower().startswith(self.env_prefix.lower())]
        return super().__call__() | {name: "" for name in ours if name.lower() not in known}


def named_files(settings: type[BaseSettings]) -> list[PydanticBaseSettingsSource]:
    """Return what the environment names; names of no setting are refused as extra ones.

    Raises
    ------
    SettingsError
        It is not there.
    """
    file, folder = os.environ.get("JOINTPLAY_SETTINGS"), os.environ.get("JOINTPLAY_SECRETS")
    sources: list[PydanticBaseSettingsSource] = []
    if file:
        if not Path(file).is_file():
            raise SettingsError(f"JOINTPLAY_SETTINGS is {file}, which is no file")
        sources.append(DotEnvSettingsSource(settings, env_file=file))
    if folder:
        if not Path(folder).is_dir():
            raise SettingsError(f"JOINTPLAY_SECRETS is {folder}, which is no folder")
        sources.append(_Secrets(settings, secrets_dir=folder))
    return sources


def with_password(url: str, password: str) -> str:
    """Return an address with this password in place of the one that it has."""
    parts = urlsplit(url)
    user, _, host = parts.netloc.rpartition("@")
    netloc = f"{user.partition(':')[0]}:{quote(password, safe='')}@{host}"
    return urlunsplit(parts._replace(netloc=netloc))
