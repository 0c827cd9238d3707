"""Starts beside the centred one share what was found of it, and nothing changes by that."""

from typing import Any

import numpy as np
import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.mechanics import assembly
from jointplay.solver.mechanics.start import shared_closings
from jointplay.solver.mechanics.start.closings import closings
from jointplay.solver.scene.document import Scene

JANSEN = ("jansen-leg", "Pk", 1e-4)
PRESS = ("seven-bar-press", "A", 3e-4)


@pytest.fixture(autouse=True)
def nothing_is_kept() -> None:
    forget()


def forget() -> None:
    for kept in (assembly._found, assembly._poses, shared_closings._kept):
        kept.clear()


def starts_of(preset: str, joint: str, size: float, count: int, number: str) -> list[Scene]:
    drawn = {"distribution": "uniform", "low": -size, "high": size}
    job: dict[str, Any] = {
        "kind": "basin-stability",
        "scene": {"preset": preset},
        "starts": {f"/start/joints/{joint}/{number}/{axis}": drawn for axis in (0, 1)},
        "samples": count,
        "settle": 1,
        "record": 4,
        "indicators": ["recurrence"],
    }
    study = admit(job)
    return [study.point_scene(point) for point in range(count)]


@pytest.mark.parametrize("case", [JANSEN, PRESS], ids=["jansen-leg", "press"])
def test_eccentric_starts_are_those_found_alone(
    case: tuple[str, str, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    scenes = starts_of(*case, 3, "eccentricity")
    forget()
    together = [assembly.assemble(scene) for scene in scenes]
    monkeypatch.setattr(assembly, "shared_closings", closings)
    for scene, found in zip(scenes, together, strict=True):
        forget()
        alone = assembly.assemble(scene.model_copy())
        assert (found.pose == alone.pose).all()
        assert (found.velocity == alone.velocity).all()


def test_ways_to_close_are_looked_for_once(monkeypatch: pytest.MonkeyPatch) -> None:
    looked = []

    def counted(places: Any) -> Any:
        looked.append(places)
        return closings(places)

    scenes = starts_of(*JANSEN, 4, "eccentricity")
    forget()
    monkeypatch.setattr(shared_closings, "closings", counted)
    poses = [assembly._found_of(scene).closed.pose for scene in scenes]
    assert len({pose.tobytes() for pose in poses}) == 4
    assert len(looked) == 1


def test_starts_that_differ_in_rates_have_one_pose(monkeypatch: pytest.MonkeyPatch) -> None:
    posed, pose = [], assembly._posed

    def counted(places: Any) -> Any:
        posed.append(places)
        return pose(places)

    scenes = starts_of(*PRESS, 4, "rate")
    forget()
    monkeypatch.setattr(assembly, "_posed", counted)
    found = [assembly.assemble(scene) for scene in scenes]
    assert len(posed) == 1
    assert len({one.velocity.tobytes() for one in found}) == 4
    assert all((one.pose == found[0].pose).all() for one in found)


def test_far_from_the_middle_of_the_play_ways_to_close_are_looked_for() -> None:
    scenes = starts_of("jansen-leg", "Pk", 1e-4, 2, "eccentricity")
    start = scenes[0].start.model_copy(
        update={
            "joints": {
                "Pk": scenes[0].start.joints["Pk"].model_copy(update={"eccentricity": [0.5, 0.0]})
            }
        }
    )
    forget()
    assembly.assemble(scenes[0].model_copy(update={"start": start}))
    assert not shared_closings._kept
    assert np.isfinite(assembly.assemble(scenes[1]).residual)
