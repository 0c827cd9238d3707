"""A checkpoint gives back every bit, and refuses what it is not."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from jointplay.records.checkpoint import (
    ForeignCheckpoint,
    UnusableCheckpoint,
    decode,
    encode,
    packed,
)

RECORDS = np.array([(1, 0.1), (2, math.nan)], [("count", "<i4"), ("time", "<f8")])
facts = st.dictionaries(
    st.text(max_size=8),
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    max_size=5,
)
numbers = arrays.arrays(
    st.sampled_from([np.dtype("<f8"), np.dtype("<i8"), np.dtype("u1")]),
    arrays.array_shapes(min_dims=0, min_side=0),
)


@given(facts, st.dictionaries(st.text(min_size=1, max_size=8), numbers, max_size=4))
def test_facts_and_arrays_come_back_bit_for_bit(given_facts, given_arrays):
    content = encode("a run", "1", given_facts, given_arrays)
    found = decode(content, "a run", "1")
    assert repr(found.facts) == repr(given_facts)  # repr: NaN is not equal to itself
    assert list(found.arrays) == list(given_arrays)
    for name, array in given_arrays.items():
        same = found.arrays[name]
        assert (same.dtype, same.shape, same.tobytes()) == (
            array.dtype,
            array.shape,
            array.tobytes(),
        )
    assert encode("a run", "1", given_facts, given_arrays) == content


def test_records_and_bytes_are_kept_and_arrays_can_be_written_to():
    content = encode("a run", "1", {}, {"records": RECORDS, "inner": packed(b"\0checkpoint\n")})
    found = decode(content, "a run", "1")
    assert found.arrays["records"].dtype == RECORDS.dtype
    assert found.arrays["records"].tobytes() == RECORDS.tobytes()
    assert found.content("inner") == b"\0checkpoint\n"
    found.arrays["records"]["count"] = 7


@pytest.mark.parametrize("position", [0, 30, 60, 100, 150, -1])
def test_a_flipped_bit_is_found(position):
    content = bytearray(encode("a run", "1", {"seconds": 0.1}, {"x": np.arange(9.0)}))
    content[position] ^= 1
    with pytest.raises(UnusableCheckpoint, match="damaged"):
        decode(bytes(content), "a run", "1")


@pytest.mark.parametrize("content", [b"", b"\n\n", b"PK\3\4" + bytes(100), b"{}"])
def test_other_bytes_are_refused(content):
    with pytest.raises(UnusableCheckpoint, match="none of this program"):
        decode(content, "a run", "1")


def test_one_that_was_cut_off_is_refused():
    content = encode("a run", "1", {}, {"x": np.arange(9.0)})
    for size in range(len(content)):
        with pytest.raises(UnusableCheckpoint):
            decode(content[:size], "a run", "1")


def test_another_kind_and_another_version_are_named():
    content = encode("a run", "1.0+abc", {}, {})
    with pytest.raises(ForeignCheckpoint, match="one of a run, not of a study"):
        decode(content, "a study", "1.0+abc")
    with pytest.raises(ForeignCheckpoint, match=r"version 1\.0\+abc, this one is 2"):
        decode(content, "a run", "2")
