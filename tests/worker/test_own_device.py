"""The device that a worker tells of is one that it has, with the bits of its processor."""

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.runs.device_trial import DeviceTrial
from jointplay.storage.catalogue.records import WorkerDevice
from jointplay.worker.own_device import of_trial, tried_device

TRIAL = DeviceTrial("a card " + "x" * 64, 2, same_bits=True, revolutions=6e5, steps=9e8)


def test_a_device_is_told_with_the_rate_of_its_trial() -> None:
    own = of_trial("cuda:0", TRIAL, 33792)
    assert (own.name, own.record) == ("cuda:0", WorkerDevice(TRIAL.name[:64], 9e8, 33792))


def test_processes_that_share_a_device_tell_of_their_parts() -> None:
    own = of_trial("cuda:0", TRIAL, 33792, 4)
    assert (own.record.rate, own.record.lanes) == (TRIAL.steps / 4, 33792 // 4)


def test_a_device_with_other_bits_is_none() -> None:
    other = DeviceTrial("a card", 2, same_bits=False, revolutions=6e5, steps=9e8)
    with pytest.raises(InvalidInput, match="'cuda:0', a card, has other bits"):
        of_trial("cuda:0", other, 33792)


def test_the_processor_is_no_device_and_one_that_is_not_there_is_refused() -> None:
    assert tried_device("cpu") is None
    with pytest.raises(InvalidInput, match="cannot be opened"):
        tried_device("cuda:9999")
