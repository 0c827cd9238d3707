"""A job's store over HTTP, opened with stock clients: xarray, zarr, fsspec, obstore."""

import json

import fsspec
import numpy as np
import pytest
import xarray
import zarr
from obstore.store import HTTPStore
from zarr.storage import FsspecStore, ObjectStore

# aiohttp leaves its connections to the garbage collector
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")


@pytest.fixture(scope="module")
def url(service_url, finished_job):
    return f"{service_url}/v1/jobs/{finished_job}/zarr"


@pytest.fixture(scope="module")
def long_url(service_url, worker):
    """A history of 20 001 samples: two chunks in a shard."""
    return f"{service_url}/v1/jobs/{worker.finished(output_step=1e-4)}/zarr"


def test_xarray_opens_the_history_lazily_with_units(url):
    history = xarray.open_zarr(url)
    assert history.sizes == {"sample": 2001}
    assert len(history.data_vars) == 96
    assert list(history.coords) == ["time"]
    assert history["slider7.vx"].attrs == {
        "units": "m/s",
        "long_name": "velocity x of the centre of mass (body slider7)",
    }
    column = list(history.attrs["channels"]).index("slider7.vx")
    time = history["time"].to_numpy()
    np.testing.assert_array_equal(history["slider7.vx"].to_numpy(), column + time)


@pytest.mark.parametrize("group", ["poincare", "impacts", "peaks"])
def test_xarray_opens_groups_by_name_and_by_address(url, group):
    by_name = xarray.open_zarr(url, group=group).load()
    by_address = xarray.open_zarr(f"{url}/{group}").load()
    assert by_name.data_vars
    xarray.testing.assert_identical(by_name, by_address)


def test_zarr_lists_everything_and_reads_slices_of_shards(long_url):
    root = zarr.open_group(long_url, mode="r")
    assert {"slider7.vx", "time", "poincare", "impacts", "peaks"} <= set(root.keys())
    assert set(root["peaks"].keys()) == {"minimum", "minimum_time", "maximum", "maximum_time"}
    assert root["time"].shards == (32_768,)
    time = np.linspace(0.0, 2.0, 20_001)
    np.testing.assert_array_equal(root["time"][16_380:16_390], time[16_380:16_390])
    np.testing.assert_array_equal(root["time"][:], time)


def test_obstore_reads_the_same(long_url):
    store = ObjectStore(HTTPStore(long_url, client_options={"allow_http": True}), read_only=True)
    root = zarr.open_group(store, mode="r", zarr_format=3)
    assert "slider7.vx" in set(root.keys())
    time = np.linspace(0.0, 2.0, 20_001)
    np.testing.assert_array_equal(root["time"][16_380:16_390], time[16_380:16_390])
    np.testing.assert_array_equal(root["time"][:], time)


def test_fsspec_reads_files_and_zarr_reads_through_it(long_url):
    files = fsspec.filesystem("http", asynchronous=False)
    document = json.loads(files.cat_file(f"{long_url}/zarr.json"))
    assert document["node_type"] == "group"
    assert files.info(f"{long_url}/time/c/0")["size"] > 260
    root = zarr.open_group(FsspecStore.from_url(long_url), mode="r", zarr_format=3)
    assert root["time"].shape == (20_001,)


def test_arrays_of_a_study_have_points_and_sections(service_url, finished_study):
    url = f"{service_url}/v1/jobs/{finished_study}/zarr"
    points = xarray.open_zarr(url)
    assert points.sizes == {"point": 20}
    assert points["status"].to_numpy().tolist().count(3) == 2
    sections = xarray.open_zarr(url, group="sections")
    assert sections.sizes == {"point": 20, "section": 6}
    values = xarray.open_zarr(url, group="values")
    np.testing.assert_allclose(values["clearance"], np.linspace(1e-4, 1e-3, 20))
