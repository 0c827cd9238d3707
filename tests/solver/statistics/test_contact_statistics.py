"""Promises of every statistic of contacts, and the definition of each of them."""

import math

import numpy as np
import pytest

from jointplay.records.impact import IMPACT
from jointplay.solver.statistics import OF_CONTACTS

START, END = 10.0, 20.0
# two joints between 10 and 20 s: one contact reaches in, one lasts beyond, one fills the half
CONTACTS = np.array(
    [
        (0, 9.0, 11.0, 0.1, 900.0, 1.0),
        (0, 12.0, 13.5, 0.1, 40.0, 1.0),
        (1, 14.0, 19.0, 0.1, 7.0, 1.0),
        (0, 19.5, math.nan, 0.1, 30.0, 1.0),
    ],
    dtype=IMPACT,
)
EXPECTED = {
    "impacts": [2.0, 1.0, 0.0],
    "largest_impact_force": [40.0, 7.0, 0.0],
    "contact_share": [0.3, 0.5, 0.0],
}
every_statistic = pytest.mark.parametrize("name", OF_CONTACTS)


def evaluated(name: str, pieces: list[np.ndarray]) -> np.ndarray:
    tally = np.zeros(3)
    for piece in pieces:
        OF_CONTACTS[name].add(tally, piece, START, END)
    return OF_CONTACTS[name].value(tally, START, END)


@every_statistic
def test_of_contacts_that_reach_over_the_ends_only_what_is_inside_counts(name: str) -> None:
    assert evaluated(name, [CONTACTS]).tolist() == EXPECTED[name]


@every_statistic
def test_its_bits_do_not_depend_on_how_the_contacts_come(name: str) -> None:
    random = np.random.default_rng(3)
    many = np.zeros(500, dtype=IMPACT)
    many["joint"] = random.integers(0, 3, 500)
    many["onset"] = np.sort(random.uniform(9.0, 20.0, 500))
    many["release"] = many["onset"] + random.exponential(0.01, 500)
    many["peak_force"] = random.exponential(100.0, 500)
    whole = evaluated(name, [many])
    for cuts in (1, 7, 200):
        pieces = np.split(many, np.sort(random.integers(0, 500, cuts)))
        assert evaluated(name, pieces).tobytes() == whole.tobytes()
