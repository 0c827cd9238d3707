"""Messages for blocks that there are not: found in the broker, and removed."""

from pathlib import Path

from redis import Redis

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.settings import Settings
from jointplay.worker.app import KEY_PREFIX, RUN_BLOCK, make_app
from jointplay.worker.stray_messages import stray_messages


def test_messages_without_a_block_are_removed_and_others_stay(
    settings: Settings, catalogue: Catalogue, redis: Redis
) -> None:
    job = catalogue.submit(NewJob("simulate", {}, "digest", "1")).job.id
    with make_app(settings.redis_url) as app:
        for block in (f"{job}-0", "no-such-block"):
            app.send_task(RUN_BLOCK, args=[block], queue="jobs")
    queue = f"{KEY_PREFIX}jobs"
    redis.lpush(queue, b"no message of Celery's")
    (finding,) = stray_messages(settings, catalogue)
    assert set(finding.subjects) == {"message for no-such-block", "message for nothing"}
    assert redis.llen(queue) == 3  # looking removes nothing
    for finding in stray_messages(settings, catalogue):
        assert finding.mend is not None
        finding.mend()
    assert list(stray_messages(settings, catalogue)) == []
    assert redis.llen(queue) == 1


def test_a_broker_of_ones_own_that_is_silent_is_left_to_the_user(
    settings: Settings, catalogue: Catalogue
) -> None:
    silent = settings.model_copy(update={"redis_url": "redis://127.0.0.1:1/0"})
    (finding,) = stray_messages(silent, catalogue)
    assert finding.subjects == ("JOINTPLAY_REDIS_URL",)
    assert finding.mend is None


def test_without_a_service_there_is_no_broker_to_ask(tmp_path: Path, catalogue: Catalogue) -> None:
    assert list(stray_messages(Settings(data=tmp_path), catalogue)) == []
