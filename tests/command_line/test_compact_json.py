"""Documents as the command line writes them: JSON that people can read."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.command_line.compact_json import WIDTH, compact_json

SCENES = Path(__file__).resolve().parents[2] / "scenes"
WRITTEN = [SCENES / "seven_bar_press_fitted.json", SCENES / "calibrations" / "seven_bar_press.json"]

values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=40,
)  # fmt: skip


@given(values)
def test_what_is_written_reads_as_what_was_meant(value):
    assert json.loads(compact_json(value)) == value


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.name)
def test_shipped_documents_stand_as_they_would_be_written(path):
    text = path.read_text()
    assert compact_json(json.loads(text)) + "\n" == text


def test_only_what_is_longer_than_a_line_is_broken():
    lines = compact_json({"a": [1, 2, {"b": 3}], "long": list(range(100))}).splitlines()
    assert lines[1] == '  "a": [1, 2, {"b": 3}],'
    assert len(lines) == 105
    edge = {"k": ["x"] * (WIDTH // 5)}
    assert max(map(len, compact_json([edge, edge]).splitlines())) <= WIDTH


def test_what_json_cannot_carry_is_refused():
    with pytest.raises(ValueError, match="JSON"):
        compact_json({"a": float("nan")})
