"""Settings in files: one of lines ``NAME=VALUE``, and a folder with a file for each secret.

What the environment says goes before both. ``JOINTPLAY_SETTINGS`` and ``JOINTPLAY_SECRETS`` name
them, so that processes that others start find them, too.
"""

import os
import re
from collections.abc import Iterator
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

from jointplay.records.suggestions import did_you_mean

ELSEWHERE = ("SETTINGS", "SECRETS", "URL", "KEY", "CACHE", "LANES")
"""Variables that are no settings, and are read elsewhere."""
OF_KUBERNETES = re.compile("(SERVICE|PORT)(_|$)")
"""Variables that a service named ``jointplay`` has there."""


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


def mistyped_variables(settings: type[BaseSettings]) -> Iterator[str]:
    """Yield a sentence for each variable of the environment that is nearly the name of a setting.

    Others may be of other programs, and are passed over.
    """
    prefix = str(settings.model_config["env_prefix"])
    names = [name.upper() for name in (*settings.model_fields, *ELSEWHERE)]
    for variable in sorted(os.environ):
        own = variable.upper().removeprefix(prefix)
        if own == variable.upper() or own in names or OF_KUBERNETES.match(own):
            continue
        if meant := did_you_mean(own, names):
            meant = meant.replace("'", f"'{prefix}", 1)
            yield f"{variable} is not a setting, and changes nothing; {meant}"


def with_password(url: str, password: str) -> str:
    """Return an address with this password in place of the one that it has."""
    parts = urlsplit(url)
    user, _, host = parts.netloc.rpartition("@")
    netloc = f"{user.partition(':')[0]}:{quote(password, safe='')}@{host}"
    return urlunsplit(parts._replace(netloc=netloc))
