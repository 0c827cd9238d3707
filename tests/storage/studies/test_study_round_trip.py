"""Rows that a study hands over are what readers find."""

from dataclasses import replace

import numpy as np
import pytest
import zarr
from made_up_studies import MadeUpStudy, made_up_layout, made_up_map
from zarr.storage import ZipStore

from jointplay.records.channel import Channel
from jointplay.records.point import Failure
from jointplay.storage.errors import CorruptStore, InvalidLayout, NotAStore, UnknownChannel
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed, Running, files_at, pack
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.live import LiveStudy
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create

SHAPES = {
    "octets": {},
    "one point": {"points": 1, "blocks": ((0, 1),)},
    "uneven blocks": {"points": 56, "blocks": ((0, 24), (24, 32))},
    "blocks that share no divisor": {"points": 30, "blocks": ((0, 7), (7, 9), (16, 14))},
    "most blocks alike": {
        "points": 86,
        "blocks": ((0, 16), (16, 16), (32, 16), (48, 16), (64, 12), (76, 10)),
    },
    "chunks on boundaries": {"points": 36, "record": 3000, "blocks": ((0, 13), (13, 2), (15, 21))},
    "more sections than a chunk": {"points": 9, "record": 9000, "blocks": ((0, 8), (8, 1))},
    "a chunk of sections exactly": {"points": 9, "record": 4096, "blocks": ((0, 8), (8, 1))},
    "no sections": {"record": 0},
    "no peaks": {"channels": 0},
}
LAYOUTS = {name: made_up_layout(**fields) for name, fields in SHAPES.items()} | {
    "a map": made_up_map(3, 5),
    "a map wider than a chunk": made_up_map(2, 300, record=0),
    "a map higher than a chunk": made_up_map(300, 2, blocks=((0, 513), (513, 87))),
}


@pytest.fixture(params=LAYOUTS)
def study(request):
    return MadeUpStudy(LAYOUTS[request.param])


def assert_equal(reader, study):
    layout = study.layout
    np.testing.assert_array_equal(reader.values, layout.values)
    np.testing.assert_array_equal(reader.section_times(), study.times)
    for column, spec in enumerate(layout.observables):
        np.testing.assert_array_equal(reader.sections(spec.name), study.sections[:, :, column])
    for column, spec in enumerate(layout.channels):
        np.testing.assert_array_equal(np.array(reader.peaks(spec.name)).T, study.peaks[:, column])
    np.testing.assert_array_equal(reader.counts, study.counts)
    expected = [3 if point in study.failing else 2 for point in range(layout.points)]
    np.testing.assert_array_equal(reader.status, expected)
    assert reader.failures == {
        point: Failure("step-size-underflow", f"point {point} cannot go on", 0.1 * point)
        for point in study.failing
    }
    np.testing.assert_array_equal(reader.statistics["steps"], study.steps)
    whole = np.array([point not in study.failing for point in range(layout.points)])
    np.testing.assert_array_equal(
        reader.indicators["lyapunov"], np.where(whole, study.exponents, np.nan)
    )
    np.testing.assert_array_equal(reader.verdicts, np.where(whole, 1, -1))
    assert reader.reasons == {p: f"point {p} recurs" for p in np.flatnonzero(whole).tolist()}


def test_a_sealed_study_reads_back(tmp_path, study):
    reader = StudyReader(study.write(tmp_path / "study"))
    assert (reader.sealed, reader.complete, reader.kind) == (True, True, "bifurcation")
    assert_equal(reader, study)
    assert reader.verdict_names == ("undecided", "periodic")
    assert reader.attributes["summary"] == {
        "done": study.layout.points - len(study.failing),
        "failed": len(study.failing),
    }
    reader.verify()


def test_a_study_whose_blocks_are_done_reads_the_same_before_it_is_sealed(tmp_path, study):
    create(tmp_path, study.layout)
    for index in reversed(range(len(study.layout.blocks))):
        study.write_block(tmp_path, index)
    reader = StudyReader(tmp_path)
    assert not reader.complete
    assert_equal(reader, study)


def test_windows_of_points_and_of_sections(tmp_path):
    study = MadeUpStudy(made_up_layout(points=9, record=9000, blocks=((0, 8), (8, 1))))
    reader = StudyReader(study.write(tmp_path / "study"))
    np.testing.assert_array_equal(reader.sections("slider7.q1", 2, 5), study.sections[2:5, :, 1])
    np.testing.assert_array_equal(reader.section_times(7), study.times[7:])
    time, columns = reader.point_sections(8, ["slider7.q0"], 4000, 4200)
    np.testing.assert_array_equal(time, study.times[8, 4000:4200])
    assert columns.keys() == {"slider7.q0"}
    np.testing.assert_array_equal(columns["slider7.q0"], study.sections[8, 4000:4200, 0])
    few = int(np.flatnonzero(study.counts < 9000)[0])
    time, columns = reader.point_sections(few)
    assert len(time) == study.counts[few] == len(columns["slider7.q1"])
    assert reader.section_times(20, 30).shape == (0, 9000)


def test_stock_zarr_reads_a_sealed_study_with_units_and_dimensions(tmp_path):
    study = MadeUpStudy(made_up_layout())
    store = ZipStore(study.write(tmp_path / "study"))
    stock = zarr.open_group(store, mode="r")
    array = stock["sections/slider7.q1"]
    assert array.metadata.dimension_names == ("point", "section")
    assert array.attrs["units"] == "m"
    np.testing.assert_array_equal(array[:], study.sections[:, :, 1])
    assert stock["statistics/energy_residual"].attrs["units"] == "J"
    assert stock["status"].attrs["flag_meanings"] == "waiting running done failed"
    codes = stock.attrs["failures"]
    assert [codes[code] for code in stock["failure"][:4]] == ["", "", "", "step-size-underflow"]
    assert stock["failure_time"][3] == pytest.approx(0.3)
    assert stock["peaks/maximum"].shape == (20, 3)
    # every array's own document is there as well, for clients that open it alone
    alone = zarr.open_array(store, path="indicators/lyapunov", mode="r")
    assert alone.shape == (20,)


def test_a_store_of_a_study_is_found_by_its_schema(tmp_path):
    with pytest.raises(NotAStore, match="holds no results"):
        StudyReader(tmp_path)
    store = tmp_path / "store.zip"
    store.write_bytes(b"".join(pack([("zarr.json", b'{"attributes": {"study_schema": 99}}')])))
    with pytest.raises(NotAStore, match="schema 99; this version reads 1"):
        StudyReader(store)


def test_what_was_not_kept_is_named(tmp_path):
    reader = StudyReader(MadeUpStudy(made_up_layout()).write(tmp_path / "study"))
    with pytest.raises(UnknownChannel, match=r"slider7\.q0, slider7\.q1"):
        reader.sections("nonsense")
    with pytest.raises(UnknownChannel, match=r"A\.force0"):
        reader.peaks("slider7.q0")


@pytest.mark.parametrize("key", ["sections/slider7.q0/c/1/0", "failures.json", "status/c/0"])
def test_a_flipped_bit_of_a_sealed_study_is_found(tmp_path, key):
    store = MadeUpStudy(made_up_layout()).write(tmp_path / "study")
    files = files_at(store)
    assert isinstance(files, Packed)
    offset, size, _ = files.entry(key)
    content = bytearray(store.read_bytes())
    content[offset + size // 2] ^= 4
    store.write_bytes(content)
    with pytest.raises(CorruptStore, match=key):
        StudyReader(store).verify()


@pytest.mark.parametrize(
    ("blocks", "record", "chunk"),
    [
        (((0, 32), (32, 32), (64, 8)), 50, (32, 50)),  # one file a block
        (((0, 24), (24, 32)), 50, (24, 50)),
        (((0, 32), (32, 24), (56, 24)), 50, (8, 50)),
        (((0, 25), (25, 26)), 50, (25, 50)),
        (((0, 64), (64, 64)), 1000, (16, 1000)),  # 16 384 values at most
        (((0, 10_000),), 50, (327, 50)),  # one block of long chains: no boundary to respect
        (((0, 8),), 1_000_000, (1, 4096)),  # one point a chunk, so that none waits for another
        (((0, 1),), 3, (1, 3)),
    ],
)
def test_no_two_blocks_share_a_chunk(blocks, record, chunk):
    points = sum(count for _, count in blocks)
    layout = made_up_layout(points=points, record=record, blocks=blocks)
    assert layout.chunk == chunk
    assert all(first % chunk[0] == 0 for first, _ in blocks)


def test_chunks_are_not_made_small_for_the_sake_of_a_few_boundaries():
    blocks = tuple((64 * index, 64) for index in range(13))
    blocks += ((832, 56), (888, 56), (944, 56))
    assert made_up_layout(points=1000, record=50, blocks=blocks).chunk == (64, 50)
    blocks = ((0, 997), (997, 997))  # a continuation in both directions
    assert made_up_layout(points=1994, record=50, blocks=blocks).chunk == (327, 50)
    blocks = ((0, 13), (13, 11), (24, 12))
    assert made_up_layout(points=36, record=3000, blocks=blocks).chunk == (5, 3000)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"blocks": ((0, 8), (9, 11))}, "after point 8 begins at point 9"),
        ({"blocks": ((0, 8),)}, "hold 8 of 20 points"),
        ({"blocks": ((0, 20), (20, 0))}, "begins at point 20"),
        ({"attributes": {"value": float("nan")}}, "finite JSON"),
    ],
)
def test_a_layout_that_cannot_be_stored_is_refused(change, sentence):
    with pytest.raises(InvalidLayout, match=sentence):
        made_up_layout(**change)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"observables": "time"}, "'time' occurs twice"),
        ({"channels": "a/b"}, "cannot name an array"),
        ({"record": 0}, "sections are recorded of observables"),
        ({"values": np.zeros((20, 2))}, "need as many columns"),
    ],
)
def test_names_and_shapes_must_fit(change, sentence):
    fields = {
        name: getattr(made_up_layout(), name)
        for name in ("parameters", "values", "observables", "record", "channels", "blocks")
    }
    for name, value in change.items():
        specs = fields["observables"][:1]
        renamed = (type(specs[0])(value, "m", ""),) if isinstance(value, str) else value
        fields[name] = renamed
    with pytest.raises(InvalidLayout, match=sentence):
        StudyLayout(**fields)


def test_every_name_but_that_of_the_time_of_sections_is_free(tmp_path):
    # `values` and `sections` are groups, which have no chunks: an array of theirs named `c`, as
    # Zarr begins the keys of chunks, is nobody's chunk, and what the root holds is another place
    names = ("c", "c.0", "time", "values", "sections", "peaks", "status", "certificate", "pyramid")
    plain = made_up_layout(points=20, record=7)
    values = np.random.default_rng(1).normal(size=(20, len(names)))
    parameters = tuple(Channel(name, "1", "a parameter") for name in names)
    observables = tuple(Channel(name, "m", "a coordinate") for name in names if name != "time")
    layout = replace(plain, parameters=parameters, values=values, observables=observables)
    study = MadeUpStudy(layout)
    path = study.write(tmp_path / "store")
    growing = LiveStudy(StudyReader(Running(tmp_path / "store")), {})
    assert_equal(StudyReader(path), study)
    assert_equal(StudyReader(tmp_path / "store"), study)
    root = zarr.open_group(ZipStore(path), mode="r")
    sealed = Packed(StoredObject(Folder(str(path.parent)), path.name))
    for column, name in enumerate(names):
        np.testing.assert_array_equal(root[f"values/{name}"][:], values[:, column])
        assert growing.chunk(f"values/{name}/c/0") == sealed.read(f"values/{name}/c/0")
    for column, spec in enumerate(observables):
        np.testing.assert_array_equal(
            root[f"sections/{spec.name}"][:], study.sections[:, :, column]
        )
    assert growing.document("values/c/zarr.json") == sealed.read("values/c/zarr.json")
    assert growing.chunk("values/c/0") is None
