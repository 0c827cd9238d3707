"""Keys of the service, and whose jobs are."""

from dataclasses import replace

import pytest
from stepped_clock import Clock

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import KeyNotFound
from jointplay.storage.catalogue.keys import id_in
from jointplay.storage.catalogue.records import NewJob, SubmissionKey

NEW = NewJob("simulate", {"duration": 2.0}, "d" * 64, "0.1.0+abc")


def test_a_key_opens_until_it_expires_or_is_revoked(catalogue: Catalogue, clock: Clock) -> None:
    text, made = catalogue.make_key("ada", ["jobs:read", "jobs:write"], "laptop", 60.0)
    assert id_in(text) == made.id
    key = catalogue.key(made.id)
    assert key == made
    assert key.is_of(text)
    assert not key.is_of(text[:-1] + ("A" if text[-1] != "A" else "B"))
    assert text not in str(key)
    assert text.rpartition("_")[2] not in str(key)
    assert key.lives(clock.now + 59)
    assert not key.lives(clock.now + 60)
    lasting, _ = catalogue.make_key("ada", ["admin"], "", None)
    assert lasting != text
    revoked = catalogue.revoke_key(id_in(lasting) or "")
    assert not revoked.lives(clock.now)
    clock.now += 1
    assert catalogue.revoke_key(revoked.id) == revoked
    catalogue.note_use_of_key(made.id)
    assert {one.last_used for one in catalogue.all_keys()} == {clock.now, None}


@pytest.mark.parametrize(
    ("owner", "scopes", "complaint"),
    [
        ("", ["admin"], "is no owner"),
        ("Ada Lovelace", ["admin"], "is no owner"),
        ("a" * 65, ["admin"], "is no owner"),
        ("ada", [], "the scopes are"),
        ("ada", ["jobs:delete"], "the scopes are"),
    ],
)
def test_an_impossible_key_is_not_made(
    catalogue: Catalogue, owner: str, scopes: list[str], complaint: str
) -> None:
    with pytest.raises(ValueError, match=complaint):
        catalogue.make_key(owner, scopes, "", None)
    assert catalogue.all_keys() == ()


def test_an_unknown_key_is_named(catalogue: Catalogue) -> None:
    for act in (catalogue.key, catalogue.revoke_key):
        with pytest.raises(KeyNotFound, match="01234567"):
            act("01234567")


@pytest.mark.parametrize("text", ["", "jp_", "jp_0123_x", "jp_01234567_" + "x" * 44, "x" * 10_000])
def test_what_is_no_key_names_none(text: str) -> None:
    assert id_in(text) is None


def test_owners_find_their_own_jobs_only(catalogue: Catalogue) -> None:
    mine, yours = (replace(NEW, owner=owner) for owner in ("ada", "bob"))
    first = catalogue.submit(mine, reuse=True).job
    assert catalogue.submit(mine, reuse=True).job.id == first.id
    other = catalogue.submit(yours, reuse=True)
    assert other.created
    assert [job.id for job in catalogue.jobs(owner="ada").jobs] == [first.id]
    assert len(catalogue.jobs().jobs) == 2
    batch = catalogue.submit_batch([mine], owner="ada").batch
    assert catalogue.batch(batch.id).owner == "ada"


def test_two_owners_may_use_one_idempotency_key(catalogue: Catalogue) -> None:
    keys = [SubmissionKey("k" * 255, "f", owner=owner) for owner in ("", "ada", "bob")]
    made = [catalogue.submit(replace(NEW, owner=key.owner), key) for key in keys]
    assert all(one.created for one in made)
    again = [catalogue.submit(replace(NEW, owner=key.owner), key) for key in keys]
    assert [one.job.id for one in again] == [one.job.id for one in made]
