"""No quantity of a table replaces another one of the same name, whatever a scene calls its own."""

import csv
import io
import json
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow
import pytest
from scipy.io import loadmat

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from closed_form_study import bifurcation

import jointplay
from jointplay import jobs
from jointplay.client.axes import on_axes
from jointplay.exports.study import point_lines, section_lines
from jointplay.exports.table_columns import columns_of
from jointplay.records.channel import Channel
from jointplay.records.table_files import Column, encode
from jointplay.records.window_query import WindowQuery

OWN = ["steps", "lyapunov", "status", "verdict", "failure", "reason", "point", "section"]
OWN += ["sections", "time", "direction", "extreme"]


@pytest.fixture(params=OWN)
def study(request):
    """A diagram whose parameter is called as another column."""
    made = bifurcation(points=4, record=3, judged=True, both=True, failed=(2,))
    return replace(made, parameters=(Channel(request.param, "1", ""),))


def cells_of(lines):
    titles, *rows = csv.reader(io.StringIO("".join(lines)))
    assert len({*titles}) == len(titles)
    return dict(zip(titles, zip(*rows, strict=True), strict=True))


def test_a_parameter_that_is_called_as_another_column_is_in_every_table(study):
    (parameter,) = study.parameters
    name, values = f"parameter.{parameter.name}", study.values[:, 0].tolist()
    cells = cells_of(point_lines(study, [], range(8)))
    assert [float(one) for one in cells[f"{name} [1]"]] == values
    assert set(cells["steps [1]"]) == {"1000"}
    assert cells["status"][2] == "failed"
    cells = cells_of(section_lines(study, ["block.x"], range(8)))
    assert {float(one) for one in cells[f"{name} [1]"]} == {*values}
    assert cells["section"][:3] == ("0", "1", "2")
    job = SimpleNamespace(is_study=True, study=lambda *_: study)
    for table in ("points", "poincare"):
        columns = columns_of(job, table, WindowQuery())
        assert [one.name for one in columns].count(name) == 1
        assert len({one.name for one in columns}) == len(columns)


def test_a_parameter_that_is_called_as_another_variable_is_an_axis(study):
    (parameter,) = study.parameters
    found = on_axes(study)
    axis = f"parameter.{parameter.name}"
    assert found["steps"].dims == (axis, "direction")
    np.testing.assert_array_equal(found[axis], np.unique(study.values))
    assert found["status"].sel(direction="forward").values.tolist().count("failed") == 1
    assert found["block.x"].dims == (axis, "direction", "section")
    assert found["time"].shape == found["block.x"].shape


def test_an_output_may_be_called_as_a_parameter_and_as_a_column_of_points(tmp_path):
    scene = json.loads((Path(jointplay.__file__).parent / "scenes" / "pendulum.json").read_text())
    scene["outputs"] = [
        {"name": name, "channel": "rod.theta"} for name in ("angle", "status", "minimum")
    ]
    scene["parameters"]["steps"] = scene["parameters"].pop("mass")
    angles, masses = [-1.5, -1.0], [1.0, 2.0]
    described = jobs.sweep(scene, {"angle": angles, "steps": masses}, duration=0.1)
    job = jointplay.run(described, output=tmp_path / "OUT", processes=1)
    points = job.points
    assert sorted(points["angle"]) == [-1.5, -1.5, -1.0, -1.0]
    assert sorted(points["parameter.steps"]) == [1.0, 1.0, 2.0, 2.0]
    assert (points["steps"] > 2.0).all()
    assert set(points["status"]) == {"done"}
    found = job.dataset
    assert set(found["status"].values.ravel()) == {"done"}
    largest = found["channel.angle"].sel(extreme="maximum")
    assert largest.dims == ("angle", "parameter.steps")
    np.testing.assert_array_equal(found["channel.status"], found["channel.angle"])
    peaks = job.peaks.xs("angle", level="channel")
    assert sorted(peaks["angle"]) == [-1.5, -1.5, -1.0, -1.0]
    assert (peaks["maximum"] >= peaks["angle"]).all()


NUMBERS = np.array([1.0, 2.0])
NAMES = ["units", "complete", "file", "a-b", "a_b", "A", "A.value", "A.x", "A-x", "x" * 70]
NAMES += ["x" * 69 + "y", "units.x", "9", "x9", "a_b_2", "spread_minimum"]


@pytest.fixture(scope="module")
def columns():
    """Every one with values of its own."""
    named = [Column(name, f"u{at}", NUMBERS + at) for at, name in enumerate(NAMES)]
    spread = [Column("spread", "us", NUMBERS + at, part) for at, part in ((50, "minimum"),)]
    return [*named, *spread, Column("A", "uA", NUMBERS + 90), Column("yes", "", NUMBERS > 1.0)]


def firsts(columns):
    return sorted(float(one.values[0]) for one in columns)


def test_numpys_archive_has_every_column_beside_its_own_arrays(columns):
    with np.load(io.BytesIO(encode("x.npz", columns, complete=True))) as found:
        named = [str(name) for name, _ in found["units"]]
        assert sorted(float(found[name][0]) for name in named) == firsts(columns)
        assert found["complete"].item() is True
        assert dict(found["units"])["file_2"] == "u2"


def test_json_and_arrow_have_every_column_under_a_name_of_its_own(columns):
    document = json.loads(encode("x.json", columns, complete=True))["columns"]
    assert sorted(float(one["values"][0]) for one in document.values()) == firsts(columns)
    table = pyarrow.ipc.open_file(encode("x.arrow", columns, complete=True)).read_all()
    assert len({*table.column_names}) == len(columns)
    assert sorted(table[name][0].as_py() for name in table.column_names) == firsts(columns)


def test_matlabs_structs_have_every_column_and_the_unit_at_the_same_place(columns):
    found = loadmat(io.BytesIO(encode("x.mat", columns, complete=True)), simplify_cells=True)

    def leaves(tree, *path):
        for name, below in tree.items():
            if isinstance(below, dict):
                yield from leaves(below, *path, name)
            elif not name.startswith("__"):
                yield (*path, name), below

    units = dict(leaves(found.pop("units")))
    assert found.pop("complete") == 1
    values = {path: float(one[0]) for path, one in leaves(found)}
    assert sorted(values.values()) == firsts(columns)
    assert max(len(part) for path in values for part in path) == 63
    at = {column.values[0]: column.unit for column in columns}
    for path, first in values.items():
        unit = units[path] if path in units else units[path[:-1]]  # of minimum and maximum one
        assert (unit if len(unit) else "") == at[first]


def test_cells_of_csv_are_cut_where_they_end():
    columns = [Column('force "N"', "N/m, k", NUMBERS), Column("word", "", np.array(["a\rb", "c"]))]
    columns.append(Column("yes", "", NUMBERS > 1.0))
    text = encode("x.csv", columns, complete=True).decode()
    titles, *rows = csv.reader(io.StringIO(text, newline=""))
    assert titles == ['force "N" [N/m, k]', "word", "yes"]
    assert rows == [["1", "a\rb", "0"], ["2", "c", "1"]]
