"""Statistics of contacts over a lash that begins at zero: declared as of any other clearance."""

from jointplay.solver.kinds import KINDS, Study, admit
from tests.solver.cams import CIRCLE, follower, valve


def test_statistics_of_a_cam_that_is_ideal_at_the_first_point_have_units() -> None:
    scene = valve(follower("flat", CIRCLE), driven=False)
    target = {"path": "/joints/cam/clearance/lash"}
    scene["parameters"] = {"lash": {"help": "Lash.", "unit": "m", "targets": [target]}}
    job = {
        "kind": "sweep",
        "scene": scene,
        "grid": {"lash": [0.0, 1e-4]},
        "duration": 0.1,
        "statistics": ["contact_share", "largest_impact_force"],
    }
    study = admit(job)
    assert isinstance(study, Study)
    units = {name: unit for name, (unit, _) in KINDS["sweep"].outputs(study).items()}
    assert units["cam.contact_share"] == "1"
    assert units["cam.largest_impact_force"] == "N"
