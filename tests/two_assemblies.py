"""Mechanisms that close in two ways where they start: a toggle press and a five-bar."""

from typing import Any

PIN: dict[str, Any] = {
    "radial_clearance": 1e-4,
    "bearing_radius": 0.015,
    "contact": {"law": "lankarani-nikravesh", "restitution": 0.8},
    "friction": {"law": "modified-coulomb", "coefficient": 0.05},
}


def revolute(bearing: str, journal: str, **more: Any) -> dict[str, Any]:
    """Return a revolute joint."""
    return {"type": "revolute", "bearing": bearing, "journal": journal, **more}


def link(half: float, *points: str) -> dict[str, Any]:
    """Return a bar with points at both ends."""
    ends = {points[0]: [-half, 0.0], points[1]: [half, 0.0]}
    return {"mass": 1.5, "inertia": 0.01, "points": ends}


def toggle() -> dict[str, Any]:
    """Return a toggle press with clearance in its knee and its ram's pin."""
    return {
        "name": "toggle-press",
        "ground": {"points": {"O": [-0.35, 0.2], "P": [0.0, 0.4], "G": [0.0, 0.0]}},
        "bodies": {
            "crank": {"mass": 3.0, "inertia": 4e-3, "points": {"O": [0, 0], "A": [0.04, 0]}},
            "rod": link(0.15, "A", "K"),
            "upper": link(0.1, "P", "K"),
            "lower": link(0.11, "K", "S"),
            "ram": {"mass": 8.0, "inertia": 0.02, "points": {"S": [0, 0.05], "nose": [0, -0.05]}},
        },
        "joints": {
            "O": revolute("ground.O", "crank.O"),
            "A": revolute("crank.A", "rod.A"),
            "P": revolute("ground.P", "upper.P"),
            "K": revolute("upper.K", "lower.K", clearance=PIN),
            "R": revolute("upper.K", "rod.K"),
            "S": revolute("ram.S", "lower.S", clearance=PIN),
            "guide": {
                "type": "prismatic",
                "guide": "ground.G",
                "slider": "ram.nose",
                "axis": [0, 1],
            },
        },
        "drivers": {"motor": {"joint": "O", "position": 1.5708, "speed": 12.566}},
        "gravity": [0, -9.81],
        "start": {"points": {"rod.K": [-0.06, 0.21]}},
    }


def five_bar() -> dict[str, Any]:
    """Return a five-bar whose two cranks swing as sines of time."""
    swinging = {"type": "sinusoidal", "amplitude": 0.3, "frequency": 4.0}
    return {
        "name": "five-bar",
        "ground": {"points": {"P1": [-0.1, 0.0], "P2": [0.1, 0.0]}},
        "bodies": {
            "left": link(0.1, "P", "A"),
            "right": link(0.1, "P", "A"),
            "reach": link(0.15, "A", "T"),
            "hold": link(0.15, "A", "T"),
        },
        "joints": {
            "P1": revolute("ground.P1", "left.P"),
            "P2": revolute("ground.P2", "right.P"),
            "A1": revolute("left.A", "reach.A"),
            "A2": revolute("right.A", "hold.A"),
            "T": revolute("reach.T", "hold.T", clearance=PIN),
        },
        "drivers": {
            "m1": {"joint": "P1", "position": 2.0, "motion": {**swinging, "phase": 0.5}},
            "m2": {"joint": "P2", "position": 1.1, "motion": swinging},
        },
        "start": {"angles": {"reach": 0.9, "hold": 2.2}},
    }


def arm(**driver: Any) -> dict[str, Any]:
    """Return an arm on a revolute joint that a driver turns."""
    return {
        "name": "arm",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"arm": {"mass": 1.0, "inertia": 1e-3, "points": {"O": [0, 0], "E": [0.1, 0]}}},
        "joints": {"O": revolute("ground.O", "arm.O")},
        "drivers": {"motor": {"joint": "O", **driver}},
    }
