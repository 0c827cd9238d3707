"""Findings that admission keeps from one job to the next never show in another."""

import copy

from jointplay.solver.kinds import admit
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene import presets
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import set_parameters

PRESS = presets.document("seven-bar-press")


def test_parameters_leave_the_document_they_are_set_in_as_it_was():
    before = copy.deepcopy(PRESS)
    set_parameters(PRESS, Scene.model_validate(PRESS), {"clearance": 3e-4, "friction": 0.07})
    assert before == PRESS


def test_jobs_of_one_preset_do_not_touch_each_other():
    def job(**parameters):
        scene = {"preset": "seven-bar-press", "parameters": parameters}
        return admit({"kind": "simulate", "scene": scene, "duration": 2.0})

    first = job()
    tight, loose = job(clearance=1e-4), job(clearance=3e-4)
    assert tight.scene != loose.scene
    assert (job().scene, job().digest) == (first.scene, first.digest)
    assert len({first.digest, tight.digest, loose.digest}) == 3


def test_scenes_share_what_their_structure_decides_and_no_more():
    def scene(**changes):
        return Scene.model_validate(PRESS | changes)

    press, weightless = scene(), scene(gravity=[0.0, 0.0])
    assert channels(press) is channels(weightless)
    assert spanning_tree(press) is spanning_tree(weightless)
    joints = copy.deepcopy(PRESS["joints"])
    joints["A"]["clearance"]["radial_clearance"] = 0.0
    ideal = scene(joints=joints)
    assert spanning_tree(ideal).play != spanning_tree(press).play
    assert len(channels(ideal)) < len(channels(press))
    assert len(channels(scene(outputs=[]))) == len(channels(press)) - len(PRESS["outputs"])
