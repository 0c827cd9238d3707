"""Every file of a store of every kind, damaged: nothing is served that is not what was stored.

Each answer is what it was before, or a problem that names the file; the job is marked then. For the
table of all files and damages: ``pytest -m long -s tests/service/damage --seed 7``.
"""

import random
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from tests.sampled import sampled
from tests.service.damage.damages import WHOLE, Damage, content_of, damages, put
from tests.service.damage.installations import BACKENDS, Installation
from tests.service.damage.readings import Denied, Reading, readings
from tests.service.damage.subjects import KINDS
from tests.service.damage.table import Outcome, Table, outcome_of

SOME = 6
"""Readings of what is struck, and as many of other results."""
# aiohttp leaves its connections to the garbage collector
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")


@pytest.fixture(scope="module")
def installation(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Installation]:
    with BACKENDS[request.param](tmp_path_factory.mktemp("damaged")) as made:
        yield made


@pytest.fixture(scope="module")
def table(installation: Installation, request: pytest.FixtureRequest) -> Iterator[Table]:
    """Counts of one installation."""
    table = Table()
    yield table
    print("\n" + "\n".join(table.lines()))  # noqa: T201 - shown by -s


class Striker:
    """Damages files of a subject, one after the other, and reads its results each time."""

    def __init__(self, installation: Installation, table: Table, scratch: Path, seed: int) -> None:
        self._http = installation.http
        self._catalogue = installation.catalogue
        self._installation = installation
        self._table = table
        self._scratch = scratch
        self._seed = seed

    def strike(self, kind: str, few: int | None = None) -> None:
        """Do all damages, or a few; after each, read what it strikes and some other results."""
        chance = random.Random(f"{self._seed} {kind}")
        subject = self._installation.subject(kind)
        ways = readings(self._http, self._installation.client, subject, self._scratch)
        found = list(damages(subject, chance))
        if few is not None:  # of as many sorts
            chance.shuffle(found)
            found = list({one.name: one for one in found}.values())[:few]
        plan = {one: self._chosen(one, ways, chance) for one in found}
        before = dict(self._results({way for chosen in plan.values() for way in chosen}))
        assert len(before) > 5
        status = "409" if subject.running else "410"
        wrong: list[str] = []
        for damage, chosen in plan.items():
            whole = content_of(damage.file.stored)
            damage.strike()
            self._table.damages[kind, damage.name] += 1
            told = [way for way in chosen if way in before]
            detected = 0
            for way in told:
                outcome, said = outcome_of(way, before[way], damage, status)
                self._table.readings[kind, damage.name, outcome] += 1
                detected += outcome is Outcome.detected
                if outcome in (Outcome.silent, Outcome.error):
                    wrong.append(f"{damage}: {outcome} {way}: {said[:300]}")
            marked = self._http.get(f"/v1/jobs/{subject.job}").json()["damaged"]
            if (marked is not None) != (detected > 0 and not subject.running):
                wrong.append(f"{damage}: marked as {marked}")
            if not subject.running and damage.name in WHOLE and detected < len(told):
                wrong.append(f"{damage}: noticed by {detected} of {len(told)} readings")
            put(damage.file.stored, whole)
            self._catalogue.mark_damaged(subject.job, None)
        assert not wrong, f"{len(wrong)} readings:\n" + "\n".join(wrong[:20])
        assert dict(self._results(before)) == before

    @staticmethod
    def _chosen(damage: Damage, ways: list[Reading], chance: random.Random) -> list[Reading]:
        """Return some readings of what is struck, and some of the others."""
        own = [one for one in ways if one.key in damage.keys]
        others = [one for one in ways if one not in own]
        return [
            one for group in (own, others) for one in chance.sample(group, min(SOME, len(group)))
        ]

    @staticmethod
    def _results(ways: Iterable[Reading]) -> Iterator[tuple[Reading, bytes]]:
        for way in ways:
            with suppress(Denied):
                yield way, way.read()


@pytest.fixture
def striker(
    installation: Installation, table: Table, tmp_path: Path, request: pytest.FixtureRequest
) -> Striker:
    return Striker(installation, table, tmp_path, request.config.getoption("--seed"))


@pytest.mark.parametrize("kind", sampled(KINDS, 7))
@pytest.mark.parametrize("installation", ["folder"], indirect=True)
def test_nothing_is_served_that_was_not_stored(striker: Striker, kind: str) -> None:
    """A sample of what the last test does."""
    striker.strike(kind, few=2)


@pytest.mark.parametrize("kind", ["simulate", "running simulate", "running sweep"])
@pytest.mark.parametrize("installation", ["bucket"], indirect=True)
def test_nothing_is_served_from_a_bucket_that_was_not_stored(striker: Striker, kind: str) -> None:
    striker.strike(kind, few=2)


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("installation", BACKENDS, indirect=True)
def test_nothing_is_served_that_was_not_stored_whatever_is_done(
    striker: Striker, kind: str
) -> None:
    striker.strike(kind)
