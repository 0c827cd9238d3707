from random import Random

import pytest

from tests.storage.reconciliation.installation import (
    Installed,
    database,
    in_a_folder,
    in_servers,
    whole,
)

SAMPLE = 12


@pytest.fixture(params=["in_a_folder", "in_servers"])
def installed(request: pytest.FixtureRequest) -> Installed:
    """An installation with catalogue and results in the stores of this run of the test."""
    made: Installed = request.getfixturevalue(request.param)
    return made


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave to the long suite what the short one need not ask of servers too, but for a sample."""
    asking = [one for one in items if "reconciliation" in one.nodeid and "in_servers" in one.name]
    sampled = Random(len(asking)).sample(asking, min(SAMPLE, len(asking)))
    for item in asking:
        if item not in sampled:
            item.add_marker(pytest.mark.long)
