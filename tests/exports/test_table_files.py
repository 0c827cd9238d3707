"""A job's tables in every form of file: the same numbers, bit for bit, and their units."""

import csv
import errno
import io
import json
import sys
from pathlib import Path

import numpy as np
import pyarrow
import pytest
from pyarrow import feather, parquet
from scipy.io import loadmat

import jointplay
from jointplay import jobs
from jointplay.exports.table_query import NoSuchPart
from jointplay.records import table_files
from jointplay.records.table_files import NotInstalled, UnknownForm, form_of


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run") / "OUT"
    return jointplay.run("slider-crank", clearance=1e-4, duration=0.02, output=folder)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    described = jobs.bifurcation("slider-crank", "clearance", [1e-4, 2e-4], settle=2, record=3)
    return jointplay.run(described, output=tmp_path_factory.mktemp("study") / "OUT", processes=1)


def of_csv(path):
    with path.open() as file:
        titles, *rows = csv.reader(file)
    columns = zip(*rows, strict=True)
    named = zip(titles, columns, strict=True)
    return {title.split(" [")[0]: np.array(one, np.float64) for title, one in named}


def of_json(path):
    columns = json.loads(path.read_bytes())["columns"]
    return {name: np.array(one["values"], np.float64) for name, one in columns.items()}


def of_npz(path):
    with np.load(path) as found:
        return {name: found[name] for name in found.files if name not in ("units", "complete")}


def of_matlab(path):
    found = loadmat(path, simplify_cells=True)
    return {"time": found["time"], "P.normal_force": found["P"]["normal_force"]}


def of_arrow(path):
    return columns_in(pyarrow.ipc.open_stream(io.BytesIO(path.read_bytes())).read_all())


def of_arrow_file(path):
    """The format of the suffix .arrow, which other programs expect: pandas, polars, R."""
    return columns_in(feather.read_table(path))


def of_parquet(path):
    return columns_in(parquet.read_table(path))


def columns_in(table):
    assert table.schema.field("time").metadata == {b"unit": b"s"}
    return {name: table[name].to_numpy() for name in table.column_names}


READERS = {".csv": of_csv, ".json": of_json, ".npz": of_npz, ".mat": of_matlab}
READERS |= {".arrow": of_arrow_file, ".feather": of_arrow_file, ".arrows": of_arrow}
READERS |= {".parquet": of_parquet}


def test_every_form_is_read_here():
    assert set(READERS) == set(table_files.SUFFIXES)


@pytest.mark.parametrize("suffix", READERS)
def test_a_window_is_the_same_in_every_form(job, tmp_path, suffix):
    window = job.window("P.normal_force", 0.004, 0.012)
    path = job.export(
        tmp_path / f"force{suffix}", channels="P.normal_force", start=0.004, stop=0.012
    )
    found = READERS[suffix](path)
    np.testing.assert_array_equal(found["time"], window.time)
    np.testing.assert_array_equal(found["P.normal_force"], window["P.normal_force"])


@pytest.mark.parametrize("suffix", [".csv", ".npz", ".parquet", ".mat"])
@pytest.mark.parametrize("table", ["peaks", "impacts", "poincare"])
def test_every_table_of_a_run_goes_into_a_file(job, tmp_path, table, suffix):
    assert job.export(tmp_path / f"out{suffix}", table).stat().st_size > 100


def test_words_and_numbers_of_tables_are_kept(job, study, tmp_path):
    impacts = parquet.read_table(job.export(tmp_path / "impacts.parquet", "impacts"))
    assert impacts["joint"].to_pylist() == job.results.impacts().joint
    np.testing.assert_array_equal(impacts["impulse"].to_numpy(), job.results.impacts().impulse)
    points = parquet.read_table(study.export(tmp_path / "points.parquet", "points"))
    assert points["clearance"].to_pylist() == [1e-4, 2e-4]
    assert points["status"].to_pylist() == ["done", "done"]
    sections = of_npz(study.export(tmp_path / "sections.npz"))
    assert sections["point"].tolist() == [0, 0, 0, 1, 1, 1]
    np.testing.assert_array_equal(sections["time"], study.study().section_times().ravel())


def test_verdicts_have_their_reasons_and_exponents_their_unit_in_every_table(tmp_path):
    described = jobs.bifurcation(
        "impact-oscillator", "speed", [25.0], settle=5, record=12, indicators=["lyapunov"]
    )
    judged = jointplay.run(described, output=tmp_path / "OUT", processes=1)
    (reason,) = judged.points["reason"]
    assert "," in reason  # which is no end of a cell
    text = judged.export(tmp_path / "points.csv", "points").read_text()
    titles, row = csv.reader(text.splitlines())
    cells = dict(zip(titles, row, strict=True))
    assert cells["reason"] == reason
    assert float(cells["lyapunov [1/s]"]) == judged.points["lyapunov"][0]
    assert float(cells["smallest_step [s]"]) > 0
    assert judged.points.attrs["units"]["lyapunov"] == "1/s"
    assert judged.dataset["lyapunov"].attrs["units"] == "1/s"


@pytest.mark.parametrize(
    "asked", [{"start": -3}, {"start": 2.7}, {"stop": np.nan}, {"start": 10**6}, {"step": 1e-3}]
)
def test_points_that_a_study_does_not_have_are_refused(study, tmp_path, asked):
    with pytest.raises(NoSuchPart, match=f"^{next(iter(asked))}"):
        study.export(tmp_path / "x.npz", **asked)
    assert list(tmp_path.iterdir()) == []


def test_a_table_that_is_not_whole_leaves_the_one_before(job, tmp_path, monkeypatch):
    def half(path, content):
        with path.open("wb") as file:
            file.write(content[:9])
        raise OSError(errno.ENOSPC, "No space left on device")

    file = tmp_path / "x.npz"
    file.write_bytes(b"the table before")
    link = tmp_path / "link.npz"
    link.symlink_to(file)
    monkeypatch.setattr(Path, "write_bytes", half)
    for name in (file, link):
        with pytest.raises(OSError, match="No space"):
            job.export(name)
    assert file.read_bytes() == b"the table before"
    assert sorted(tmp_path.iterdir()) == [link, file]
    monkeypatch.undo()
    job.export(link)
    assert of_npz(file).keys() == of_npz(link).keys()
    assert link.is_symlink()


def test_what_no_form_is_named_for_is_refused(job, study, tmp_path):
    with pytest.raises(UnknownForm, match=r"x\.xls: tables are written as \.csv, .* or \.parquet"):
        job.export(tmp_path / "x.xls")
    with pytest.raises(ValueError, match="a simulation has no table 'points'; it has history"):
        job.export(tmp_path / "x.csv", "points")
    with pytest.raises(ValueError, match="a study has no table 'history'"):
        study.export(tmp_path / "x.csv", "history")
    assert list(tmp_path.iterdir()) == []


def test_a_form_that_needs_a_package_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises((NotInstalled, ValueError)):
        form_of("x.parquet")
