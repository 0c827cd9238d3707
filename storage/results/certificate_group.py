"""The group of a run's certificate: small arrays that a store gets when it is sealed."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import zarr

from jointplay.records.run import CertificateRecord, LabelledArray
from jointplay.storage.results import shards
from jointplay.storage.results.metadata import DOUBLE, Document, array, group

CERTIFICATE: Final = "certificate"


def nodes(certificate: CertificateRecord) -> dict[str, Document]:
    """Make the documents of the group and its arrays by path; an array is one chunk."""
    arrays = {
        name: array(
            one.values.shape,
            [max(length, 1) for length in one.values.shape],
            DOUBLE,
            one.dimensions,
            one.attributes,
        )
        for name, one in certificate.arrays.items()
    }
    below = {f"{CERTIFICATE}/{name}": document for name, document in arrays.items()}
    return {CERTIFICATE: group(certificate.attributes, arrays), **below}


def chunks(certificate: CertificateRecord) -> Iterator[tuple[str, bytes]]:
    """Encode the arrays by key; those without values have no chunk."""
    for name, one in certificate.arrays.items():
        if one.values.size:
            index = "/".join("0" for _ in one.dimensions)
            content = shards.compress(one.values.astype(DOUBLE, copy=False))
            yield f"{CERTIFICATE}/{name}/c/{index}", content


def read(root: zarr.Group) -> CertificateRecord | None:
    """Read the group; None if the store has none."""
    found = root.get(CERTIFICATE)
    if not isinstance(found, zarr.Group):
        return None
    arrays = {
        name: LabelledArray(
            np.asarray(one[...], np.float64),
            tuple(str(dimension) for dimension in one.metadata.dimension_names or ()),  # type: ignore[union-attr]
            dict(one.attrs),
        )
        for name, one in found.arrays()
    }
    return CertificateRecord(dict(found.attrs), arrays)
