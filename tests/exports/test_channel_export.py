"""CSV and JSON of channels: every bit, every unit, in bounded memory."""

import csv
import io
import json
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from jointplay.exports.run import csv_lines, json_pieces
from jointplay.records.channel import Channel
from jointplay.records.channel_choice import NoSuchChannel
from jointplay.records.run import Dataset
from jointplay.records.run_rows import RunRows
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter
from tests.stores import target

CHANNELS = (Channel("slider7.x", "m", "position"), Channel("A.normal_force", "N", "normal force"))


def dataset(values):
    time = np.arange(len(values)) * 0.1
    columns = {channel.name: values[:, index] for index, channel in enumerate(CHANNELS)}
    return Dataset({}, CHANNELS, time, columns)


tables = arrays.arrays(np.float64, st.tuples(st.integers(0, 5), st.just(2)), elements=st.floats())


@settings(deadline=None)
@given(values=tables)
def test_csv_gives_back_every_bit(values):
    source = dataset(values)
    header, *rows = csv.reader(io.StringIO("".join(csv_lines(source))))
    assert header == ["time [s]", "slider7.x [m]", "A.normal_force [N]"]
    found = np.array([[float(cell) for cell in row] for row in rows]).reshape(-1, 3)
    np.testing.assert_array_equal(found, np.column_stack([source.time, values]))


@settings(deadline=None)
@given(values=tables)
def test_json_gives_back_every_bit_and_null_for_what_is_no_number(values):
    document = json.loads("".join(json_pieces(dataset(values))), parse_constant=pytest.fail)
    assert document["complete"] is True
    assert document["time"]["unit"] == "s"
    force = document["channels"]["A.normal_force"]
    assert (force["unit"], force["long_name"]) == ("N", "normal force")
    expected = [value if np.isfinite(value) else None for value in values[:, 1].tolist()]
    assert force["values"] == expected


def test_seventeen_significant_digits():
    (*_, row) = csv_lines(dataset(np.array([[0.1, 1 / 3]])))
    assert row == "0,0.10000000000000001,0.33333333333333331\n"


def test_comments_come_first_each_on_its_own_line():
    lines = list(csv_lines(dataset(np.ones((1, 2))), comments=["job 7", "two\nlines", ""]))
    assert lines[:4] == ["# job 7\n", "# two\n", "# lines\n", "#\n"]
    assert lines[4].startswith("time [s],")


def test_channels_and_window_are_chosen():
    source = dataset(np.arange(20.0).reshape(10, 2))
    text = "".join(csv_lines(source, ["A.normal_force"], start=0.25, stop=0.5))
    assert [line.split(",")[1] for line in text.splitlines()] == [
        "A.normal_force [N]", "7", "9", "11"
    ]  # fmt: skip
    document = json.loads("".join(json_pieces(source, ["A.normal_force"], 0.25, 0.5)))
    assert list(document["channels"]) == ["A.normal_force"]
    assert document["channels"]["A.normal_force"]["values"] == [7.0, 9.0, 11.0]


@pytest.mark.parametrize("writer", [csv_lines, json_pieces])
def test_unknown_channels_are_refused_before_any_text(writer):
    with pytest.raises(NoSuchChannel, match=r"no channel 'slider8\.x'; did you mean slider7\.x"):
        next(writer(dataset(np.ones((1, 2))), ["slider8.x"]))


def test_a_long_history_is_exported_in_bounded_memory(tmp_path):
    rows = 200_000
    layout = ResultLayout((Channel("x", "m", "position"),), rows, 0, ())
    writer = ResultWriter.create(tmp_path / "store", layout)
    values = np.random.default_rng(0).normal(size=(rows, 1))
    writer.append(RunRows(sample_time=np.arange(float(rows)), samples=values))
    writer.seal(target(tmp_path / "store"), peaks={}, summary={})
    reader = ResultReader(tmp_path / "store.zip")
    tracemalloc.start()
    try:
        lines = sum(piece.count("\n") for piece in csv_lines(reader))
        length = sum(map(len, json_pieces(reader)))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert lines == rows + 1
    assert length > 20 * rows
    # a chunk of 16 384 rows takes 4.5 MB as Python floats and text, all rows so would take 55 MB
    assert peak < 9e6


def test_the_store_and_memory_export_alike(tmp_path):
    values = np.random.default_rng(0).normal(size=(7, 2))
    specs = CHANNELS
    writer = ResultWriter.create(tmp_path / "store", ResultLayout(specs, 7, 0, ()))
    in_memory = dataset(values)
    writer.append(RunRows(sample_time=in_memory.time, samples=values))
    writer.seal(target(tmp_path / "store"), peaks={}, summary={})
    stored = ResultReader(tmp_path / "store.zip")
    assert list(csv_lines(stored)) == list(csv_lines(in_memory))
    assert "".join(json_pieces(stored)) == "".join(json_pieces(in_memory))
