import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.records import strict_json
from jointplay.records.strict_json import MalformedJson

json_values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**53), 2**53)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0")),
    lambda inner: st.lists(inner) | st.dictionaries(st.text("abc/~ é"), inner),
    max_leaves=20,
)


@given(json_values)
def test_what_json_writes_is_read_back_unchanged(document: object) -> None:
    assert strict_json.parse(json.dumps(document).encode()) == document


@pytest.mark.parametrize(
    ("text", "pointer", "says"),
    [
        (b'{"duration": NaN}', "/duration", "finite"),
        (b'{"a": [1, -Infinity]}', "/a/1", "finite"),
        (b'{"a": 1e400}', "/a", "1.7e308"),
        (b'{"a": -1e400}', "/a", "1.7e308"),
        (b'{"a": 1' + b"0" * 5000 + b"}", "/a", "1.7e308"),
        (b'{"a/b": {"~": NaN}}', "/a~1b/~0", "finite"),
        (b'{"kind": 1, "kind": 2}', "/kind", "twice"),
        (b'{"label": "\\ud800"}', "/label", "surrogate"),
        (b'{"label": "\\u0000"}', "/label", "NUL"),
        (b'{"kind": ', "", "line 1, column"),
        (b"", "", "not JSON"),
        (b'{"kind": "sim', "", "Unterminated string starting at line 1, column 10."),
        (b'{"kind": 1} x', "", "not JSON"),
        (b'\xff{"kind": 1}', "", "UTF-8"),
        (b"[" * 100_000, "", "nested"),
        (b"[" * 200 + b"]" * 200, "", "64 levels"),
    ],
)
def test_a_flaw_is_named_with_its_place(text: bytes, pointer: str, says: str) -> None:
    with pytest.raises(MalformedJson) as caught:
        strict_json.parse(text)
    assert [flaw.pointer for flaw in caught.value.flaws] == [pointer]
    assert says in caught.value.flaws[0].detail


def test_every_flaw_is_named_but_no_more_than_twenty() -> None:
    with pytest.raises(MalformedJson) as caught:
        strict_json.parse(b'{"a": NaN, "b": 1e999}')
    assert [flaw.pointer for flaw in caught.value.flaws] == ["/a", "/b"]
    with pytest.raises(MalformedJson) as caught:
        strict_json.parse(b"[" + b"NaN," * 999 + b"1]")
    assert len(caught.value.flaws) == 20


def test_integers_too_long_for_64_bits_are_read_as_floats() -> None:
    assert strict_json.parse(b"[100000000000000000000, 7]") == [1e20, 7]
    assert isinstance(strict_json.parse(b"100000000000000000000"), float)
