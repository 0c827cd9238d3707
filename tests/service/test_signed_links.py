"""Links that open one job's stored arrays without a key."""

import hmac
from base64 import urlsafe_b64encode
from dataclasses import replace
from functools import partial
from pathlib import Path

import httpx
import pytest
import xarray

from jointplay.service.access import authentication
from jointplay.service.access.link_secret import LinkSecret
from jointplay.service.access.signed import Link
from jointplay.service.problems import RequestRefused
from jointplay.storage.catalogue.keys import Key
from jointplay.storage.object_stores import object_store_at
from tests.service.guarded import Guarded

OF_NO_KEY = urlsafe_b64encode(b"0" * 26 + bytes(48)).decode()
"""A token whose key's name has characters that PostgreSQL cannot be asked for."""


def test_a_signed_link_opens_the_arrays_of_its_job_to_stock_clients(guarded: Guarded) -> None:
    with guarded.as_("ada") as ada:
        made = ada.post(f"/v1/jobs/{guarded.job}/links", params={"seconds": 3600})
        assert made.status_code == 201
        address = f"{guarded.url}{made.json()['zarr']}"
        history = ada.get(f"/v1/jobs/{guarded.job}/history", params={"channels": "slider7.x"})
        assert ada.post(f"/v1/jobs/{guarded.job}/links", params={"seconds": 0}).status_code == 422
    stored = xarray.open_zarr(address)
    assert stored["slider7.x"].size == len(history.json()["time"]["values"])
    get = partial(httpx.get, trust_env=False)
    part = get(f"{address}/zarr.json", headers={"Range": "bytes=0-9"})
    assert (part.status_code, len(part.content)) == (206, 10)
    assert part.headers["Cache-Control"].startswith("private")
    assert httpx.post(f"{address}/zarr.json", trust_env=False).status_code == 405
    for other in ("", "/peaks", "/zarr/../peaks", "/zarr/%2e%2e/peaks", "/links"):
        answer = get(f"{address.removesuffix('/zarr')}{other}")
        assert answer.status_code == 404, other


def test_a_link_lasts_for_its_time_and_as_long_as_its_key(
    guarded: Guarded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(authentication, "_REMEMBERED", 0.0)
    text = guarded.key("ada")
    key = guarded.catalogue.key(text.split("_")[1])
    now = int(guarded.catalogue.clock())
    assert guarded.settings is not None
    secret = LinkSecret(guarded.settings.object_store).made()

    def opened(link: Link, signer: Key) -> int:
        address = f"{guarded.url}/v1/shared/{link.signed_with(secret, signer)}/zarr/zarr.json"
        return httpx.get(address, trust_env=False).status_code

    good = Link(guarded.job, now + 100, key.id)
    assert opened(good, key) == 200
    assert opened(replace(good, until=now - 1), key) == 401
    assert opened(replace(good, key="00000000"), key) == 401
    forger = replace(key, sha256="0" * 64)
    assert opened(good, forger) == 401
    others = guarded.catalogue.key(guarded.key("bob").split("_")[1])
    assert opened(replace(good, key=others.id), others) == 404  # not his job
    unread = guarded.catalogue.key(guarded.key("ada", "jobs:read").split("_")[1])
    assert opened(replace(good, key=unread.id), unread) == 403
    guarded.catalogue.revoke_key(key.id)
    assert opened(good, key) == 401


def test_what_the_catalogue_knows_of_a_key_forges_no_link(guarded: Guarded) -> None:
    """Whoever has a copy of the catalogue, and not of the results, opens nothing with it."""
    with guarded.as_("ada") as ada:
        token = ada.post(f"/v1/jobs/{guarded.job}/links").json()["zarr"].split("/")[-2]
        key = guarded.catalogue.key(ada.headers["Authorization"].split("_")[1])
    link = Link.of(token)
    assert link is not None
    signed = link._content()
    forged = [hmac.digest(known, signed, "sha256") for known in (bytes.fromhex(key.sha256), b"")]
    opened = []
    for signature in (*forged, bytes(32), link.signature):
        token = urlsafe_b64encode(signed + signature).decode().rstrip("=")
        address = f"{guarded.url}/v1/shared/{token}/zarr/zarr.json"
        opened.append(httpx.get(address, trust_env=False).status_code)
    assert opened == [401, 401, 401, 200]


def test_the_secret_of_links_is_made_once_and_kept_with_the_results(tmp_path: Path) -> None:
    store = object_store_at(f"file:{tmp_path}")
    assert LinkSecret(store).read() is None
    first, second = LinkSecret(store), LinkSecret(store)
    assert first.made() == second.made() == first.known == LinkSecret(store).read()
    store.replace("secret-of-links", [b"damaged"])
    with pytest.raises(RequestRefused, match="damaged"):
        LinkSecret(store).made()
    assert first.made() == second.made()


@pytest.mark.parametrize("token", ["", "x", "A" * 103, "A" * 99, "é", "A" * 5000, "%00", OF_NO_KEY])
def test_what_is_no_token_leads_nowhere(guarded: Guarded, token: str) -> None:
    address = f"{guarded.url}/v1/shared/{token}/zarr/zarr.json"
    assert httpx.get(address, trust_env=False).status_code == 404
