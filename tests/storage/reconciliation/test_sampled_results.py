"""All results are looked for; where not all are read, a sample and what is in doubt are."""

from collections import Counter
from collections.abc import Iterable, Sequence

import pytest

from jointplay.storage.catalogue.records import NOT_REPRODUCED
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.reconciliation import Extent, Finding, extent, findings, results
from tests.storage.reconciliation.harms import content_of, flip, remove, write
from tests.storage.reconciliation.installation import Installed


@pytest.fixture
def read(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """Count the results of which every byte is read."""
    counted: Counter[str] = Counter()
    verified = results.verified

    def counting(sealed: StoredObject) -> object:
        counted[results.job_in(sealed.key)] += 1
        return verified(sealed)

    monkeypatch.setattr(results, "verified", counting)
    monkeypatch.setattr(extent, "SAMPLE", 1)
    return counted


def looked(installed: Installed, way: Extent) -> list[Finding]:
    return [*findings(installed.settings, installed.catalogue, extent=way)]


def seed_without(installed: Installed, job: str) -> int:
    """Find a seed whose sample leaves out a job."""
    ended = [one.id for one in installed.catalogue.every_job() if one.state.terminal]
    return next(seed for seed in range(99) if job not in Extent(seed).chosen(ended, []))


def test_bytes_are_read_of_a_sample_or_of_all(installed: Installed, read: Counter[str]) -> None:
    harmed = installed.jobs["succeeded"]
    flip(installed.sealed("succeeded"))
    told: list[float] = []
    some = Extent(seed_without(installed, harmed), lambda done, _: told.append(done))
    assert looked(installed, some) == []
    assert (some.counted.read, harmed in read) == (1, False)
    assert some.counted.there > 2
    assert told == sorted(told)
    every = Extent()
    (finding,) = looked(installed, every)
    assert finding.subjects == (f"job {harmed}",)
    assert every.counted.read == every.counted.there == some.counted.there


def test_what_is_not_there_or_is_marked_is_found_whatever_the_sample(
    installed: Installed, read: Counter[str]
) -> None:
    harmed = installed.jobs["succeeded"]
    seed = seed_without(installed, harmed)
    installed.catalogue.mark_damaged(harmed, "it was")
    (finding,) = looked(installed, Extent(seed))
    assert finding.mended == "no longer marked as damaged"
    installed.catalogue.mark_damaged(harmed, None)
    remove(installed.sealed("succeeded"))
    (finding,) = looked(installed, Extent(seed))
    assert finding.found.endswith("is gone")


@pytest.mark.parametrize("first", ["contradicted", "damaged"])
def test_contradicted_results_stay_so_when_a_file_is_damaged_and_restored(
    installed: Installed, first: str
) -> None:
    job, catalogue = installed.jobs["succeeded"], installed.catalogue
    if first == "damaged":
        catalogue.mark_damaged(job, "it was")
    catalogue.mark_not_reproduced(job)
    sealed = installed.sealed("succeeded")
    whole = content_of(sealed)
    flip(sealed)
    (finding,) = looked(installed, Extent())
    assert finding.found != NOT_REPRODUCED
    assert (finding.mended, finding.mend) == (None, None)
    catalogue.mark_damaged(job, finding.found)  # as a request for the file does
    write(sealed, whole)
    (finding,) = looked(installed, Extent())
    assert (finding.found, finding.mend) == (NOT_REPRODUCED, None)
    catalogue.mark_damaged(job, None)
    assert catalogue.get(job).damaged == NOT_REPRODUCED


def test_what_is_in_its_place_is_not_asked_for_again(
    installed: Installed, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A bucket is asked for nothing but its list about results that nobody reads."""
    asked: Counter[str] = Counter()
    exists = StoredObject.exists

    def counting(self: StoredObject) -> bool:
        asked[results.job_in(self.key)] += 1
        return exists(self)

    monkeypatch.setattr(extent, "SAMPLE", 1)
    monkeypatch.setattr(StoredObject, "exists", counting)
    harmed = installed.jobs["succeeded"]
    assert looked(installed, Extent(seed_without(installed, harmed))) == []
    assert harmed not in asked


@pytest.mark.parametrize("moment", ["listed", "read"])
def test_a_job_whose_rows_go_meanwhile_is_nothing_to_find(
    installed: Installed, moment: str
) -> None:
    harmed = installed.jobs["succeeded"]
    flip(installed.sealed("succeeded"))

    def remove_rows() -> None:
        installed.sql(
            f"DELETE FROM block WHERE job = '{harmed}'", f"DELETE FROM job WHERE id = '{harmed}'"
        )

    class Late(Extent):
        """A look that begins some time after the list was made."""

        def chosen(self, results: Sequence[str], besides: Iterable[str]) -> list[str]:
            if moment == "listed":
                remove_rows()
            return super().chosen(results, besides)

    def report(done: float, _: str) -> None:
        if moment == "read" and not done:
            remove_rows()

    found = results.damage(installed.settings, installed.catalogue, Late(report=report))
    assert [*found] == []
