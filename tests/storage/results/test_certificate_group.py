"""The certificate of a run in its store: small arrays that it gets when it is sealed."""

import numpy as np
import pytest
import zarr
from made_up_runs import MadeUpRun, made_up_layout, target
from zarr.storage import ZipStore

from jointplay.records.impact import IMPACT
from jointplay.records.run import CertificateRecord, LabelledArray
from jointplay.storage.errors import InvalidAppend
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter

TABLE = np.array([[1.0, np.nan], [np.inf, -0.0], [3.0, 4.0]])
CERTIFICATE = CertificateRecord(
    {"horizon": 0.5, "converged": [[0.0, 0.5]], "exponent": None},
    {
        "error": LabelledArray(TABLE, ("instant", "channel"), {"long_name": "estimated error"}),
        "time": LabelledArray(np.arange(3.0), ("instant",), {"units": "s"}),
        "nothing": LabelledArray(np.zeros((0, 2)), ("edge", "channel"), {}),
    },
)


def sealed(folder, certificate):
    run = MadeUpRun(made_up_layout(6, 0), np.zeros(0, IMPACT))
    writer = ResultWriter.create(folder / "store", run.layout)
    run.append(writer, 0.0, 1.0)
    assert ResultReader(folder / "store").certificate() is None
    there = target(folder / "store")
    writer.seal(there, peaks=run.peaks, summary={}, certificate=certificate)
    return ResultReader(folder / "store.zip")


def test_it_is_read_as_it_was_written(tmp_path):
    reader = sealed(tmp_path, CERTIFICATE)
    reader.verify()
    found = reader.certificate()
    assert found.attributes == CERTIFICATE.attributes
    assert set(found.arrays) == set(CERTIFICATE.arrays)
    for name, array in CERTIFICATE.arrays.items():
        assert found.arrays[name].values.tobytes() == array.values.tobytes()
        assert found.arrays[name].dimensions == array.dimensions
        assert found.arrays[name].attributes == array.attributes


def test_stock_zarr_reads_it_alone(tmp_path):
    sealed(tmp_path, CERTIFICATE)
    group = zarr.open_group(ZipStore(tmp_path / "store.zip"), path="certificate", mode="r")
    assert group.attrs["horizon"] == 0.5
    np.testing.assert_array_equal(group["error"][:], TABLE)


def test_a_store_without_one_has_none(tmp_path):
    reader = sealed(tmp_path, None)
    assert reader.certificate() is None
    assert not any(key.startswith("certificate") for key in reader.files)


def test_a_document_that_json_cannot_carry_is_refused(tmp_path):
    with pytest.raises(InvalidAppend, match="certificate must be finite"):
        sealed(tmp_path, CertificateRecord({"horizon": float("nan")}, {}))
