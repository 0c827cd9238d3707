"""Demands on every member of a registry of laws: it is documented; draws of it share no examples.

A family's specification is a class: a law passes it by a subclass that draws the law.
"""

import inspect
import re
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from jointplay.solver.quantities.units import Strict

rates = st.floats(-2.0, 2.0)
"""Rates of depths, and of gaps, m/s."""


def documented(model: type[Strict]) -> None:
    text = inspect.getdoc(model) or ""
    assert re.search(r"Source: .*\b(19|20)\d\d\b", text, re.DOTALL)
    assert "Assumes" in text
    assert "Fails" in text


def for_any(**strategies: st.SearchStrategy[Any]) -> Callable[[Any], Any]:
    """Draw a law and more; several laws share a specification, and no database of examples."""
    shared = settings(suppress_health_check=[HealthCheck.differing_executors], database=None)
    return lambda test: shared(given(data=st.data(), **strategies)(test))
