"""A service that asks for keys, on every view: the field for one, and what was typed before."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from jointplay.service.app import create_app
from jointplay.storage.settings import Settings
from tests.page.browsing import barriers, expect
from tests.service_in_thread import serving

REFUSED = ("401", "403")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("keys") / "data"


@pytest.fixture(scope="module")
def asking(folder: Path) -> Iterator[str]:
    """The address of a service that asks for keys."""
    with serving(create_app(Settings(data=folder, keys="required"))) as url:
        yield url


def key_of(folder: Path, *scopes: str) -> str:
    """Make a key; without scopes it is for jobs and their results."""
    new = [sys.executable, "-m", "jointplay", "key", "new", "--owner", "me", "--data", folder]
    more = [word for scope in scopes for word in ("--scope", scope)]
    return subprocess.run([*new, *more], capture_output=True, text=True, check=True).stdout.strip()


def give(page: Any, label: str, key: str) -> None:
    page.get_by_label(label).fill(key)
    page.get_by_role("button", name="Use it").click()


def test_a_mechanism_that_is_written_asks_for_a_key_and_keeps_its_text(browsing, asking, folder):
    """It said what it lacked, and had no field for it; neither had a key that may only read."""
    with browsing.page(f"{asking}/#/editor", expected=REFUSED) as page:
        expect(page.get_by_label("Key (jp_", exact=False)).to_be_visible()
        text = page.get_by_label("Scene document")
        text.get_by_text('"mine"').click()
        page.keyboard.press("End")
        page.keyboard.type(' "description": "of hers",')
        expect(text).to_contain_text("of hers")
        assert barriers(page) == []
        give(page, "Key (jp_", key_of(folder, "jobs:read"))
        page.get_by_text("This needs a key for jobs:write").first.wait_for()
        give(page, "Another key (jp_", key_of(folder))
        page.get_by_text("Degrees of freedom: 2").wait_for()
        expect(text).to_contain_text("of hers")
        expect(page.get_by_role("button", name="Use it")).to_have_count(0)


def test_a_command_to_copy_shows_the_key_where_one_is_asked_for(browsing, asking, folder):
    """As it was copied the service refused it."""
    with browsing.page(f"{asking}/#/new/pendulum", expected=REFUSED) as page:
        give(page, "Key (jp_", key_of(folder))
        page.get_by_role("button", name="curl").click()
        shown = page.get_by_label("The same job", exact=True)
        expect(shown).to_have_text(re.compile(r'-H "Authorization: Bearer \$JOINTPLAY_KEY" '))
