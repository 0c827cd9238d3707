"""A fault that lasts for a day leaves a line a minute in the logs, not one a second."""

import logging

import pytest

from jointplay.records.log_repetitions import OncePerPeriod


def test_a_warning_is_written_once_a_minute_with_how_many_were_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lines: list[str] = []
    handler = logging.Handler()
    monkeypatch.setattr(handler, "emit", lambda record: lines.append(record.getMessage()))
    now = 1000.0
    handler.addFilter(OncePerPeriod(lambda: now))
    log = logging.Logger("of this test")
    log.addHandler(handler)
    for _ in range(150):  # seconds
        log.warning("trying again: %s", "the catalogue is damaged")
        log.info("of a request")
        now += 1.0
    warned = [line for line in lines if line != "of a request"]
    text = "trying again: the catalogue is damaged"
    assert warned == [text, *[f"{text} (and 59 times since it was written)"] * 2]
    assert lines.count("of a request") == 150
    log.warning("trying again: %s", "the catalogue does not answer")
    assert lines[-1].endswith("does not answer")
    for _ in range(2):
        log.error("unexpected", exc_info=ValueError("a"))
    assert lines[-2:] == ["unexpected", "unexpected"]
