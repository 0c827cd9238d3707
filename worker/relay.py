"""Relay and reaper, `jointplay.worker.relay`: announces queued blocks and ends lost leases.

Several may run; the catalogue lets one of them at a time lead and do the work. If two ever overlap
nothing breaks: a redundant wake-up finds nothing to claim.
"""

import logging
import signal
import threading
import time

from kombu.exceptions import OperationalError
from redis.exceptions import RedisError

from jointplay.records.log_lines import about, begin
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable, WrongRevision
from jointplay.storage.catalogue.records import QUEUES
from jointplay.storage.installation import OtherFiles, require_own_files
from jointplay.storage.settings import Settings
from jointplay.worker.app import KEY_PREFIX, RUN_BLOCK, make_app
from jointplay.worker.measuring import measure_results
from jointplay.worker.process_name import has_ended, own_name
from jointplay.worker.removal import clear_up, remove_expired
from jointplay.worker.wake_up import WakeUpListener, connection

_TASK = "relay"
_JUMP = "jump of the clock"
"""Task of one of the relays that see the same jump."""
_LEAD_SECONDS = 5.0
_LONGEST_TURN = 5.0  # s; between two turns of a process that was not stopped
_UNDERWAY = 2.0  # s; a message is in a queue, or its block is claimed, after less than that
_SOLVERS_PERIOD = 10.0  # s
_RAREST_CLEARING = 600.0
"""Seconds between two looks for what jobs left, where there is nothing: it lists many keys."""
_RESULTS_PATIENCE = 2.0  # s; the next leader goes on with it
_log = logging.getLogger(__name__)


class Relay:
    """Publishes wake-ups from the outbox and takes blocks back from lost workers."""

    def __init__(self, catalogue: Catalogue, settings: Settings) -> None:
        self._catalogue = catalogue
        self._settings = settings
        self._app = make_app(settings.redis_url)
        self._redis = connection(settings.redis_url or "redis://")
        self._name = own_name()
        self._reap_next = self._look_for_solvers_next = self._trust_leases = 0.0
        self._clear_up_pause = settings.lease
        self._clear_up_next = time.monotonic() + settings.lease
        self._last_round, self._last_seen = time.monotonic(), catalogue.clock()
        self._queues_empty_since: float | None = None
        self._results: threading.Thread | None = None
        self._lead_until = 0.0

    def turn(self) -> None:
        """Do a round; what goes wrong in it is logged, and tried again in another one."""
        try:
            self.do_round()
        except Unavailable as error:
            _log.warning("trying again: %s", error)
        except Exception:  # noqa: BLE001  (without a relay no job would be computed)
            _log.exception("trying again")

    def do_round(self) -> None:
        """Do what is due now, if this process leads."""
        now = time.monotonic()
        seen = self._catalogue.clock()
        jumped = self._give_the_living_time(now, seen)
        if jumped:  # others may lead since then
            self._lead_until = 0.0
        if now > self._lead_until - _LEAD_SECONDS / 2:
            if not self._lead():
                return
            self._lead_until = now + _LEAD_SECONDS
        if jumped > 0.0 and self._catalogue.take_lead(_JUMP, self._name, self._settings.lease):
            self._catalogue.pass_over(jumped, seen - jumped)
        if now >= self._reap_next:
            self._reap_next = now + self._settings.reaper_period
            self._catalogue.mend_after_setting_back(
                self._settings.lease, self._settings.republish_after
            )
            ended = [name for name in self._catalogue.holders() if has_ended(name)]
            until = seen if now >= self._trust_leases else 0.0
            reaped = self._catalogue.reap(self._settings.max_attempts, ended, until=until)
            for block in reaped.requeued:
                with about(block=block):
                    _log.warning("block %s lost its worker and is queued again", block)
            for job in reaped.ended:
                with about(job=job):
                    _log.error("job %s lost too many workers", job)
            self._catalogue.settle()
            self._look_after_results()
        if now >= self._look_for_solvers_next:
            self._look_for_solvers_next = now + _SOLVERS_PERIOD
            ended = [name for name in self._catalogue.workers() if has_ended(name)]
            self._catalogue.forget_workers(ended)
            self._catalogue.note_unserved()
        self.publish()

    def _lead(self) -> bool:
        """Take or keep the lead; at once where the process that had it has ended."""
        leader = self._catalogue.leader(_TASK)
        if leader is not None and has_ended(leader):
            self._catalogue.release_lead(_TASK, leader)
        return self._catalogue.take_lead(_TASK, self._name, _LEAD_SECONDS)

    def _look_after_results(self) -> None:
        """Measure and remove results in a thread: other work must not wait for disks."""
        if self._results is None or not self._results.is_alive():
            waits = time.monotonic() < self._clear_up_next
            if waits and not (self._catalogue.removable(1) or self._catalogue.unmeasured(1)):
                return
            self._results = threading.Thread(target=self._tidy, name="results", daemon=True)
            self._results.start()

    def _tidy(self) -> None:
        measure_results(self._catalogue, self._settings)
        remove_expired(self._catalogue, self._settings)
        if time.monotonic() >= self._clear_up_next:
            found = clear_up(self._catalogue, self._settings)
            longer = min(2 * self._clear_up_pause, _RAREST_CLEARING)
            self._clear_up_pause = self._settings.lease if found else longer
            self._clear_up_next = time.monotonic() + self._clear_up_pause

    def _give_the_living_time(self, now: float, seen: float) -> float:
        """Call no lease run out yet where the catalogue's clock was set, or all here was stopped.

        All leases seem to have run out then; the living extend theirs with their next heartbeat.
        Returns the seconds by which the clock was set, or this machine slept; else 0.
        """
        awake, passed = now - self._last_round, seen - self._last_seen
        jumped = 0.0
        if abs(passed - awake) > _LONGEST_TURN:  # it was set, or this machine slept
            jumped = passed - awake
            _log.warning("the clock has gone on by %.1f s in %.1f s", passed, awake)
            self._trust_leases = now + self._settings.lease
        elif awake > _LONGEST_TURN:
            _log.warning("%.1f s have passed since the last turn", awake)
            self._trust_leases = max(self._trust_leases, now + self._settings.heartbeat + 1.0)
        self._last_round, self._last_seen = now, seen
        return jumped

    def publish(self) -> None:
        """Send every due wake-up to Redis; what cannot be sent stays due."""
        if self._lost_messages() and (lost := self._catalogue.announce_again()):
            _log.warning("Redis has lost %d wake-ups, which are sent again", lost)
        outstanding = self._settings.relay_outstanding
        seen = self._catalogue.clock()
        due = self._catalogue.due_wake_ups(outstanding, self._settings.most_running)
        sent = []
        try:
            # what workers that joined have claimed stays there, if no other takes messages
            room = outstanding - self._messages() if due else 0
            for wake_up in due[: max(room, 0)]:
                self._app.send_task(RUN_BLOCK, args=[wake_up.block], queue=wake_up.queue)
                sent.append(wake_up.block)
        except (OperationalError, RedisError, OSError) as error:
            _log.warning("Redis does not answer, trying again: %s", error)
        if sent:
            patience = self._settings.republish_after
            self._catalogue.mark_published(tuple(sent), patience, seen=seen)

    def _lost_messages(self) -> bool:
        """Tell whether wake-ups were sent, and yet Redis has had no message for a while."""
        if not self._catalogue.on_the_way():
            self._queues_empty_since = None
            return False
        try:
            empty = not self._messages()
        except RedisError:
            empty = False
        now = time.monotonic()
        since = (self._queues_empty_since or now) if empty else None
        lost = since is not None and now - since > _UNDERWAY
        self._queues_empty_since = None if lost else since
        return lost

    def _messages(self) -> int:
        """Count what waits in Redis for workers."""
        return sum(int(self._redis.llen(f"{KEY_PREFIX}{queue}")) for queue in QUEUES)

    def release_lead(self) -> None:
        """Let another relay take over at once."""
        if self._results is not None:
            self._results.join(_RESULTS_PATIENCE)
        self._app.close()
        self._redis.close()
        try:
            self._catalogue.release_lead(_TASK, self._name)
        except Unavailable as error:
            _log.warning("another relay takes over in %g s: %s", _LEAD_SECONDS, error)


def main() -> None:
    """Relay and reap until SIGTERM or SIGINT."""
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    settings = Settings()
    begin(settings.log_format)
    if settings.redis_url is None:
        raise SystemExit("set JOINTPLAY_REDIS_URL, such as redis://localhost:6379/0")
    catalogue = Catalogue(settings.catalogue_url)
    try:
        catalogue.migrate()
        require_own_files(settings, catalogue)
    except (Unavailable, WrongRevision, OtherFiles) as error:  # the service tells what helps
        why = ": ".join((str(error), *getattr(error, "__notes__", ())))
        raise SystemExit(f"the relay does not start: {why}") from None
    relay = Relay(catalogue, settings)
    with WakeUpListener(settings.redis_url) as listener:
        while not stop.is_set():
            relay.turn()
            listener.wait(settings.relay_period)
    relay.release_lead()
    catalogue.close()


if __name__ == "__main__":
    main()
