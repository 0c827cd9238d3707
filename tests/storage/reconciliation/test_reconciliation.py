"""Whatever contradicts itself in an installation is found, and mended where that can be."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from jointplay.storage.catalogue.inconsistencies import INCONSISTENCIES, Patience
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.reconciliation import findings, rows
from tests.storage.reconciliation.harms import Harm, content_of, flip, remove
from tests.storage.reconciliation.installation import RUN, Installed

ELSEWHERE = "01ARZ3NDEKTSV4RRFFQ69G5FAV"
Break = Callable[[Installed], None]


def every_file(installed: Installed) -> dict[str, bytes]:
    return {name: content_of(one) for name, one in installed.every_object().items()}


def test_nothing_is_found_in_an_installation_that_is_well(installed: Installed) -> None:
    before = every_file(installed)
    assert len(before) > 6
    assert installed.look() == []
    assert every_file(installed) == before


def restore(installed: Installed) -> None:
    installed.catalogue.mark_damaged(installed.jobs["swept"], "it was")


def leave_a_fenced_attempt(installed: Installed) -> None:
    sealed = installed.sealed("succeeded")
    sealed.object_store.put(sealed.key.replace("-a1", "-a2"), [content_of(sealed)])


def leave_a_run_beside_a_study(installed: Installed) -> None:
    job = installed.catalogue.get(installed.jobs["swept"])
    late = installed.settings.sealed_run(job.id, job.attempt)
    late.object_store.put(late.key, [content_of(installed.sealed("succeeded"))])


def leave_a_partial_result(installed: Installed) -> None:
    key = f"{installed.sealed('succeeded').key}.0a1b2c3d.partial"
    (installed.settings.data / "results" / key).write_bytes(b"half")


def leave_a_running_folder(installed: Installed) -> None:
    installed.running("swept").put("part", [b""])


def leave_a_partial_part(installed: Installed) -> None:
    folder = installed.settings.running_folder(installed.jobs["cut short"])
    (folder / "study" / "parts" / "1.partial").write_bytes(b"")


def orphan_rows(installed: Installed) -> None:
    installed.sql(f"UPDATE block SET job = '{ELSEWHERE}' WHERE job = '{installed.jobs['swept']}'")


def lose_a_wake_up(installed: Installed) -> None:
    installed.sql("DELETE FROM outbox")


def leave_a_wake_up(installed: Installed) -> None:
    block = f"{installed.jobs['swept']}-0"
    others = "queue, created, due, tries"
    installed.sql(f"INSERT INTO outbox (block, {others}) SELECT '{block}', {others} FROM outbox")


def leave_a_block(installed: Installed) -> None:
    job = installed.jobs["cancelled"]
    installed.sql(f"UPDATE block SET state = 'queued' WHERE job = '{job}'")


def forget_the_worker(installed: Installed) -> None:
    installed.sql("UPDATE block SET lease_until = 1.0 WHERE state = 'running'")


def hold_for_years(installed: Installed) -> None:
    installed.sql("UPDATE block SET lease_until = 1e11 WHERE state = 'running'")


def do_not_settle(installed: Installed) -> None:
    job = installed.jobs["swept"]
    installed.sql(f"UPDATE job SET state = 'running' WHERE id = '{job}'")


MENDED = {
    restore: ("results", "are whole", "no longer marked"),
    leave_a_fenced_attempt: ("results", "is left over", "removed"),
    leave_a_run_beside_a_study: ("results", "is left over", "removed"),
    leave_a_partial_result: ("results", "is left over", "removed"),
    leave_a_running_folder: ("running", "is left over", "removed"),
    leave_a_partial_part: ("running", "is left over", "removed"),
    lose_a_wake_up: ("catalogue", "no wake-up is due", "announced"),
    leave_a_wake_up: ("catalogue", "waits for no worker", "removed"),
    leave_a_block: ("catalogue", "its job has ended", "cancelled"),
    forget_the_worker: ("catalogue", "ran out long ago", "taken back"),
    hold_for_years: ("catalogue", "longer than can be", "shortened"),
    do_not_settle: ("catalogue", "though its blocks have", "settled"),
}


OF_A_FOLDER = (leave_a_partial_result, leave_a_partial_part)


@pytest.mark.parametrize(
    ("installed", "damage"),
    [("in_a_folder", one) for one in MENDED]
    + [("in_servers", one) for one in MENDED if one not in OF_A_FOLDER],
    indirect=["installed"],
)
def test_what_is_wrong_is_found_once_and_mended(installed: Installed, damage: Break) -> None:
    damage(installed)
    where, found, mended = MENDED[damage]
    (finding,) = installed.look()  # looking mends nothing
    assert (finding.where, found in finding.found) == (where, True), finding
    assert mended in str(finding.mended)
    (finding,) = installed.mend()
    left = installed.look()
    if mended == "marked":
        assert [(one.found, one.mend) for one in left] == [(finding.found, None)]
        assert "submit" in str(left[0].advice)
    else:
        assert left == []


def test_a_block_that_is_taken_back_is_computed_again(installed: Installed) -> None:
    forget_the_worker(installed)
    installed.mend()
    (block,) = installed.catalogue.blocks(installed.jobs["running"])
    assert (block.state, block.losses) == (BlockState.queued, 1)
    assert installed.claim(installed.jobs["running"]).block.attempt == 2


def test_a_block_whose_worker_wakes_up_is_left_to_it(
    installed: Installed, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After a sleep of the machine all leases seem to have run out; heartbeats follow at once."""

    def beat(_: float) -> None:
        installed.catalogue.heartbeat(f"{installed.jobs['running']}-0", 1, installed.settings.lease)

    forget_the_worker(installed)
    monkeypatch.setattr(rows.time, "sleep", beat)
    assert installed.mend() == []


def test_a_block_whose_worker_wakes_up_while_it_is_taken_back_is_left_to_it(
    installed: Installed,
) -> None:
    """A heartbeat may come between the look and the lock, where a database is shared."""
    forget_the_worker(installed)
    block = f"{installed.jobs['running']}-0"
    (overdue,) = (one for one in INCONSISTENCIES if "lease ran out" in one.found)
    stale = replace(overdue, find=lambda *_: [block])
    installed.catalogue.heartbeat(block, 1, installed.settings.lease)
    installed.catalogue.reconcile(stale, Patience(installed.settings.lease, 1.0, 3))
    (found,) = installed.catalogue.blocks(installed.jobs["running"])
    assert (found.state, found.losses) == (BlockState.running, 0)
    installed.sql("UPDATE block SET lease_until = 0")
    installed.catalogue.reconcile(stale, Patience(installed.settings.lease, 1.0, 3))
    (found,) = installed.catalogue.blocks(installed.jobs["running"])
    assert (found.state, found.losses) == (BlockState.queued, 1)


def test_orphaned_rows_are_removed(installed: Installed) -> None:
    orphan_rows(installed)
    (found,) = [one for one in installed.mend() if "not there" in one.found]
    assert found.subjects == ("rows 2 in block",)
    assert installed.catalogue.blocks(ELSEWHERE) == ()
    assert not any("not there" in one.found for one in installed.look())


def test_whole_results_without_a_job_get_one_that_can_be_found(installed: Installed) -> None:
    """The catalogue is lost, or a copy from before the jobs; only what was whole is adopted."""
    lost = {label: installed.catalogue.get(job) for label, job in installed.jobs.items()}
    installed.sql("DELETE FROM job", rules=True)
    found = {one.found: one for one in installed.mend()}
    assert len([one for one in found.values() if one.mended == "its job was made again"]) == 1
    jobs = {job.label: job for job in installed.catalogue.every_job()}
    assert set(jobs) == {"succeeded", "swept"}
    for label, job in jobs.items():
        former = lost[label]
        same = ("id", "kind", "spec", "digest", "solver_version", "scene", "state", "attempt")
        for name in (*same, "progress_fraction"):
            assert getattr(job, name) == getattr(former, name), name
        assert job.created == pytest.approx(former.created, abs=1e-3)  # ids count milliseconds
        assert job.finished == pytest.approx(installed.clock(), abs=60.0)  # who waits for it ends
    left = {one.subjects[0].rpartition("/")[2]: one for one in installed.look()}
    running = ("cut short", "cut short, too", "given up", "running")
    cancelled = installed.sealed("cancelled").key.rpartition("/")[2]
    assert set(left) == {cancelled, *(installed.jobs[label] for label in running)}
    assert all(one.mend is None and one.advice for one in left.values())


def test_a_job_that_is_made_again_is_kept_as_one_that_is_submitted_now(
    installed: Installed,
) -> None:
    """When it was to expire is lost; that it has expired already nobody would expect."""
    installed.settings = installed.settings.model_copy(update={"keep": 3600.0})
    installed.clock.ahead = 86_400.0
    installed.sql("DELETE FROM job", rules=True)
    installed.mend()
    for job in installed.catalogue.every_job():
        assert job.expires == pytest.approx(installed.clock() + 3600.0, abs=60.0)
        assert not installed.catalogue.expired(job)


def test_results_that_a_user_put_there_are_left_to_him(installed: Installed) -> None:
    sealed = installed.sealed("succeeded")
    copy = StoredObject(sealed.object_store, f"{sealed.key}.bak")
    copy.put([content_of(sealed)])
    (installed.settings.data / "notes").write_text("mine")
    found = installed.mend()
    assert [one.mend for one in found] == [None, None]
    assert copy.exists()


@pytest.mark.parametrize("loss", [flip, remove])
def test_what_is_left_of_a_job_without_whole_results_is_kept(
    installed: Installed, loss: Harm
) -> None:
    """A fenced attempt's results may be the only ones that are whole."""
    leave_a_fenced_attempt(installed)
    sealed = installed.sealed("succeeded")
    loss(sealed)
    installed.mend()
    late = sealed.key.replace("-a1", "-a2")
    (finding,) = [one for one in installed.look() if late in one.subjects[0]]
    assert finding.mend is None
    assert "jointplay show" in str(finding.advice)


def test_a_job_that_nothing_will_end_is_left_to_the_user(installed: Installed) -> None:
    job = installed.jobs["cancelled"]
    installed.sql(f"UPDATE job SET state = 'running' WHERE id = '{job}'")
    (finding,) = installed.mend()
    assert finding.found == "has not ended, and nothing of it will be computed"
    assert f"jointplay cancel {job}" in str(finding.advice)


def test_a_clock_that_was_set_back_is_said(installed: Installed) -> None:
    installed.submit(RUN, "newest")
    installed.clock.ahead -= 3600.0
    (finding,) = [one for one in installed.look() if one.where == "clock"]
    seconds, _, rest = finding.found.partition(" ")
    assert 3000 < int(seconds) <= 3600  # less by as long as it took to look
    assert rest.startswith("s before the newest event")


def test_a_disk_without_room_is_said(installed: Installed) -> None:
    settings = installed.settings.model_copy(update={"reserve": 2**60})
    (finding,) = [one for one in findings(settings, installed.catalogue) if one.where == "disk"]
    assert "no job is accepted" in finding.found
    assert "MB" in str(finding.advice)
