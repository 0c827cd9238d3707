"""A calibration that was cut short goes on to the same result, and measures nothing twice."""

import pytest

from jointplay.solver.calibration.calibrate import calibrate, costs_of
from jointplay.solver.kinds import admit_calibration
from jointplay.solver.runs.processes import Interrupted
from jointplay.worker.local.measured import Measured, document_in
from jointplay.worker.local.measures import measures
from tests.solver.calibration.calibrations import bounce, computed

QUICK = bounce(search={"population": 4, "generations": 8}, spread={"generations": 4})


class Counted:
    """A measure that counts its calls, and with them the requests to end."""

    def __init__(self, calls):
        self.calls, self.left = 0, calls

    def asked(self):
        return self.calls >= self.left

    def of(self, measure):
        def counted(candidates):
            self.calls += 1
            return measure(candidates)

        return counted


def carried_out(path, calls):
    """Carry out the calibration until so many calls were made; return what it finds, and those."""
    calibration, counted = admit_calibration(QUICK), Counted(calls)
    kept = Measured(path, calibration)
    with measures(calibration, 1, counted.asked) as (fitted, every):
        outcome = calibrate(
            calibration,
            costs_of(calibration, kept.of(counted.of(fitted), every=False)),
            kept.of(counted.of(every), every=True),
            lambda done, note: None,
        )
    return outcome.document(), counted.calls


def test_one_that_was_cut_short_goes_on_and_measures_nothing_twice(tmp_path):
    path = tmp_path / "found.json.measured"
    whole = computed(QUICK).document()
    with pytest.raises(Interrupted):
        carried_out(path, 6)
    assert document_in(path) == admit_calibration(QUICK).document
    path.write_bytes(path.read_bytes()[:-3])  # the last frame was being written
    with pytest.raises(Interrupted):
        carried_out(path, 3)
    found, more = carried_out(path, 10_000)
    assert found == whole
    found, again = carried_out(path, 10_000)
    assert (found, again) == (whole, 0)
    _, all_of_them = carried_out(tmp_path / "other", 10_000)
    assert more == all_of_them - 4 - 2


def test_what_is_of_another_calibration_is_replaced(tmp_path):
    path = tmp_path / "found.json.measured"
    path.write_bytes(b"{}\n" + bytes(range(100)))
    assert document_in(path) is None
    calibration = admit_calibration(QUICK)
    Measured(path, calibration)
    assert document_in(path) == calibration.document
    assert document_in(tmp_path / "nothing") is None
