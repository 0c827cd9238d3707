"""CSV and JSON of studies: every bit, every unit, one row a section or a point."""

import csv
import io
import json
import sys
import tracemalloc
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from closed_form_study import bifurcation, one_point, sweep

from jointplay.exports.study import point_json, point_lines, section_json, section_lines
from jointplay.exports.table_columns import columns_of
from jointplay.records.window_query import WindowQuery

OBSERVED = ["left.eccentricity_x", "block.vx"]


def rows_of(lines):
    return list(csv.reader(io.StringIO("".join(lines))))


def test_sections_are_one_row_each_with_the_value_of_their_point():
    source = bifurcation(points=5, record=3, failed=(2,))
    header, *rows = rows_of(section_lines(source, OBSERVED, range(1, 4)))
    titles = ["left.eccentricity_x [m]", "block.vx [m/s]"]
    assert header == ["point", "play [m]", "section", "time [s]", *titles]
    assert [row[0] for row in rows] == ["1", "1", "1", "3", "3", "3"]
    assert [row[2] for row in rows] == ["0", "1", "2"] * 2
    table = np.array(rows, dtype=float)
    np.testing.assert_array_equal(table[:3, 1], source.values[1, 0])
    np.testing.assert_array_equal(table[3:, 3], source.times[3])
    np.testing.assert_array_equal(table[3:, 4], source.section_values["left.eccentricity_x"][3])
    np.testing.assert_array_equal(table[:3, 5], source.section_values["block.vx"][1])


def test_sections_of_one_point_have_no_parameter():
    header, *rows = rows_of(section_lines(one_point(record=4), ["block.x"], range(1)))
    assert header == ["point", "section", "time [s]", "block.x [m]"]
    assert len(rows) == 4


def test_points_have_a_word_for_what_became_of_them_and_a_verdict():
    source = bifurcation(points=6, judged=True, failed=(1,), unfinished=(4, 5))
    source = replace(source, reasons={3: "it recurs after 2, K is 0"})
    header, *rows = rows_of(point_lines(source, [], range(6)))
    assert header[:6] == ["point", "status", "verdict", "reason", "failure", "play [m]"]
    assert [row[3] for row in rows[2:4]] == ["", "it recurs after 2, K is 0"]
    assert [row[1] for row in rows] == ["done", "failed", "done", "done", "running", "waiting"]
    assert (rows[1][2], rows[1][4]) == ("", "step-size-underflow")
    names = source.verdict_names
    assert rows[3][2] == names[source.verdicts[3]]
    sections = header.index("sections [1]")
    assert [float(row[sections]) for row in rows] == source.counts.tolist()
    column = header.index("lyapunov [1/s]")
    assert float(rows[3][column]) == source.indicators["lyapunov"][3]
    assert rows[1][column] == "nan"


def test_a_continuation_that_goes_both_ways_has_a_direction():
    source = bifurcation(points=3, record=2, both=True)
    told = ["forward"] * 3 + ["backward"] * 3
    header, *rows = rows_of(point_lines(source, [], range(6)))
    assert header[:3] == ["point", "direction", "status"]
    assert [row[1] for row in rows] == told
    header, *rows = rows_of(section_lines(source, OBSERVED, range(2, 5)))
    assert header[:3] == ["point", "direction", "play [m]"]
    assert [row[1] for row in rows] == ["forward"] * 2 + ["backward"] * 4
    for pieces in (point_json(source, [], range(6)), section_json(source, [], range(6))):
        assert json.loads("".join(pieces))["direction"] == told
    job = SimpleNamespace(is_study=True, study=lambda *_: source)
    for table in ("points", "poincare"):
        (column,) = (
            one for one in columns_of(job, table, WindowQuery()) if one.name == "direction"
        )
        assert list(column.values) == (told if table == "points" else np.repeat(told, 2).tolist())


def test_extremes_of_a_sweep_stand_beside_its_parameters():
    source = sweep((4, 2))
    header, *rows = rows_of(point_lines(source, ["stroke"], range(2, 8)))
    assert header[3:] == [
        "play [m]",
        "friction [1]",
        "stroke minimum [m]",
        "stroke minimum at [s]",
        "stroke maximum [m]",
        "stroke maximum at [s]",
        "stroke range [m]",
        "steps [1]",  # the statistics of a channel that was not chosen are left out
        "left.contact_share [1]",
    ]
    assert [int(row[0]) for row in rows] == list(range(2, 8))
    maxima = [float(row[7]) for row in rows]
    np.testing.assert_array_equal(maxima, source.extremes["stroke"].maximum[2:])


def test_json_gives_back_every_bit_and_null_for_what_is_no_number():
    source = bifurcation(points=5, record=3, judged=True, failed=(2,))
    source = replace(source, reasons={4: "nothing recurs"})
    text = "".join(section_json(source, OBSERVED, range(1, 5)))
    document = json.loads(text, parse_constant=pytest.fail)
    assert (document["complete"], document["first_point"]) == (True, 1)
    assert document["values"]["play"] == source.values[1:, 0].tolist()
    assert document["status"] == ["done", "failed", "done", "done"]
    assert document["time"][1] == document["sections"]["block.vx"][1] == []
    assert document["sections"]["block.vx"][3] == source.section_values["block.vx"][4].tolist()
    document = json.loads("".join(point_json(source, [], range(5))), parse_constant=pytest.fail)
    assert document["columns"]["lyapunov [1/s]"][2] is None
    assert document["columns"]["lyapunov [1/s]"][4] == source.indicators["lyapunov"][4]
    assert document["verdict"][2] == ""
    assert document["reason"] == ["", "", "", "", "nothing recurs"]


def test_many_sections_take_no_more_memory_than_a_block_of_them():
    source = bifurcation(points=400, record=2000)  # 800 000 rows of three numbers
    tracemalloc.start()
    size = sum(len(piece) for piece in section_lines(source, ["block.x"], range(400)))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert size > 40_000_000
    assert peak < 60_000_000  # a block of 200 000 values as text and as numbers
