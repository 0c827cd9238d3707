"""Settings that all tests share."""

from hypothesis import settings

# the machine that tests run on may be busy: a slow example is no failure
settings.register_profile("repeatable", deadline=None, derandomize=True, max_examples=60)
# `pytest --hypothesis-profile=search` looks for new counterexamples
settings.register_profile("search", deadline=None, max_examples=500)
settings.load_profile("repeatable")
