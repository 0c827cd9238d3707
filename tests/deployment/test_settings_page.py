"""The page on settings names every one, with the default it has."""

import re
from pathlib import Path

import pytest

from jointplay.storage.settings import Settings

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "settings.md").read_text()
ROWS = dict(re.findall(r"^\| `(JOINTPLAY_\w+)` \| ([^|]+) \|", PAGE, re.MULTILINE))


def test_the_page_lists_the_settings_and_no_others() -> None:
    ours = {name for name, field in Settings.model_fields.items() if not field.validation_alias}
    assert set(ROWS) == {f"JOINTPLAY_{name.upper()}" for name in ours}


@pytest.mark.parametrize(
    ("name", "default"),
    [
        (name, field.default)
        for name, field in Settings.model_fields.items()
        if isinstance(field.default, int | float)
    ],
)
def test_the_page_gives_the_defaults(name: str, default: float) -> None:
    assert float(ROWS[f"JOINTPLAY_{name.upper()}"]) == default
