"""Settings that all tests share."""

import pytest
from hypothesis import settings

from tests import expensive


def pytest_addoption(parser: pytest.Parser) -> None:
    """Take a seed: another one damages other bytes."""
    parser.addoption("--seed", type=int, default=0, help="of the damages to files")


@pytest.hookimpl(tryfirst=True)  # before tests are chosen by their marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave expensive tests to the long ones."""
    expensive.mark(items)


# the machine that tests run on may be busy: a slow example is no failure
settings.register_profile("repeatable", deadline=None, derandomize=True, max_examples=30)
# `pytest --hypothesis-profile=search` looks for new counterexamples
settings.register_profile("search", deadline=None, max_examples=500)
settings.load_profile("repeatable")
