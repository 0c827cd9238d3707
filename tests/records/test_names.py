"""A name is refused when a job is admitted, never by the store of the run that it belongs to."""

from typing import Any

import numpy as np
import pytest
import zarr
from hypothesis import given, reject, settings
from hypothesis import strategies as st
from zarr.storage import ZipStore

from jointplay.records.failure import InvalidInput
from jointplay.records.names import GROUPS, RESERVED_OUTPUTS, STORED
from jointplay.records.run import CertificateRecord, LabelledArray
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.scene import presets
from jointplay.storage.results import pyramid
from jointplay.storage.results.layout import Partition
from jointplay.storage.results.writer import ResultWriter
from jointplay.worker.layouts import layout_of_run
from tests.storage.results.made_up_runs import MadeUpRun, made_up_impacts, made_up_layout
from tests.stores import target


def admitted(name: str) -> Admission:
    """Admit a pendulum with an output of that name."""
    scene: dict[str, Any] = presets.document("pendulum")
    scene["outputs"].append({"name": name, "channel": "rod.omega"})
    admission = admit({"kind": "simulate", "scene": scene, "duration": 0.1})
    assert isinstance(admission, Admission)
    return admission


@pytest.mark.parametrize("name", sorted(STORED))
def test_admission_refuses_every_name_that_the_store_keeps(name):
    with pytest.raises(InvalidInput) as refused:
        admitted(name)
    (problem,) = refused.value.problems
    assert problem.pointer.startswith("/scene/outputs/")
    assert problem.pointer.endswith("/name")
    assert f"'{name}' is reserved; take another" in problem.detail


@settings(max_examples=200, deadline=None)
@given(
    st.sampled_from(sorted(RESERVED_OUTPUTS))
    | st.from_regex(r"[A-Za-z][A-Za-z0-9_-]{0,31}", fullmatch=True)
    | st.from_regex(r"[A-Za-z][A-Za-z0-9_.-]{0,31}", fullmatch=True)
)
def test_a_name_that_is_admitted_can_be_stored(name):
    try:
        admission = admitted(name)
    except InvalidInput:
        reject()
    layout = layout_of_run(admission)
    assert name in [channel.name for channel in layout.channels]


def test_every_name_that_a_store_uses_is_reserved(tmp_path):
    long_enough = Partition(4, 4, 2**20, pyramid_above=10, bucket=4, level_rows=32)
    run = MadeUpRun(made_up_layout(100, 2, partition=long_enough), made_up_impacts(3))
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 1.0)
    some = {"error": LabelledArray(np.zeros(1), ("instant",), {})}
    there = target(tmp_path / "store")
    writer.seal(there, peaks=run.peaks, summary={}, certificate=CertificateRecord({}, some))
    root = zarr.open_group(ZipStore(tmp_path / "store.zip", mode="r"), mode="r")
    assert {*root.group_keys(), pyramid.GROUP} == {*GROUPS}
    channels = {channel.name for channel in run.layout.channels}
    assert {*root.array_keys()} - channels == STORED - {*GROUPS, "c"}
