from collections.abc import Iterator
from pathlib import Path

import pytest
from redis import Redis

from jointplay.service.processes.broker import Broker
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    broker = Broker(tmp_path / "broker", tmp_path / "broker.log")
    try:
        broker.start()
        yield broker
    finally:
        broker.stop()


@pytest.fixture
def redis(broker: Broker) -> Iterator[Redis]:
    redis = Redis.from_url(broker.url)
    yield redis
    redis.close()


@pytest.fixture
def settings(tmp_path: Path, broker: Broker) -> Settings:
    return Settings(data=tmp_path / "data", redis_url=broker.url, republish_after=0.05)


@pytest.fixture
def catalogue(settings: Settings) -> Iterator[Catalogue]:
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    yield catalogue
    catalogue.close()
