"""Peaks as a table for people."""

from jointplay.command_line.peaks import peak_table


def test_rounding_beside_a_larger_extreme_is_nothing() -> None:
    found = {"crank.x": (4.9e-18, 0.08), "crank.vx": (-0.25, -0.0), "crank.ax": (-0.8, -4.9e-14)}
    rows = [
        {"channel": name, "unit": "m", "minimum": low, "maximum": high}
        | {"minimum_time": 0.5, "maximum_time": 0.0}
        for name, (low, high) in found.items()
    ]
    _, *lines = peak_table(rows)
    read = [line.split()[1:4:2] for line in lines]
    assert read == [["0", "0.08"], ["-0.25", "0"], ["-0.8", "-4.9e-14"]]
