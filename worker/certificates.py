"""A trajectory's certificate as records of its store: arrays with units, and a document."""

from typing import Any

from jointplay.records.run import CertificateRecord, LabelledArray
from jointplay.records.strict_json import finite
from jointplay.solver.runs.certificate.certificate import Certificate

IN_ITS_UNIT = "in the unit of its channel"
EXTREMES = ("lowest minimum", "highest minimum", "lowest maximum", "highest maximum")


def record_of(certificate: Certificate) -> CertificateRecord:
    """Return what a store keeps of a certificate."""
    columns = {
        "time": (certificate.time, ("instant",), "s", "time"),
        "error": (
            certificate.error,
            ("instant", "channel"),
            None,
            "estimated error of each channel; where the motion is not converged, how far"
            " companions are apart",
        ),
        "until": (
            certificate.until,
            ("channel",),
            "s",
            "time until which the estimated error is a small share of the channel's scale",
        ),
        "extremes": (
            certificate.extremes,
            ("channel", "extreme"),
            None,
            f"over several lanes: {', '.join(EXTREMES)}",
        ),
        "edges": (certificate.edges, ("edge", "channel"), None, "edges of the histograms' bins"),
        "share": (certificate.share, ("bin", "channel"), "1", "share of time in a bin"),
        "spread": (
            certificate.spread,
            ("bin", "channel"),
            "1",
            "standard deviation over companions of the share of time in a bin",
        ),
    }
    arrays = {
        name: LabelledArray(values, dimensions, _meaning(unit, long_name))
        for name, (values, dimensions, unit, long_name) in columns.items()
    }
    return CertificateRecord(finite(certificate.facts), arrays)


def _meaning(unit: str | None, long_name: str) -> dict[str, Any]:
    if unit is None:
        return {"long_name": f"{long_name}, {IN_ITS_UNIT}"}
    return {"units": unit, "long_name": long_name}
