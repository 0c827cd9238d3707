"""The laws as documents: complete, and from the laws themselves."""

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.laws.catalogue import FAMILIES, laws

LAWS = laws()


def test_every_member_of_every_registry_is_there_and_describes_itself() -> None:
    members = [(family, name) for family, registry in FAMILIES.items() for name in registry]
    assert [(law.family, law.name) for law in LAWS] == members
    for law in LAWS:
        assert law.formula
        assert law.assumes.startswith("Assumes ")
        assert law.fails.startswith("Fails ")
        assert law.source
        model = FAMILIES[law.family][law.name]
        assert {p.name for p in law.parameters} >= set(model.model_fields) - {"law", "type"}


def test_parameters_have_their_unit_range_and_default() -> None:
    (law,) = laws("threlfall")
    assert [parameter.model_dump(exclude_defaults=True) for parameter in law.parameters] == [
        {
            "name": "coefficient",
            "unit": "1",
            "help": "",
            "required": True,
            "above": 0.0,
            "maximum": 10.0,
        },
        {
            "name": "full_velocity",
            "unit": "m/s",
            "help": "",
            "required": False,
            "default": 1e-3,
            "above": 0.0,
            "maximum": 1e3,
        },
    ]


def test_laws_that_latch_say_so_and_what_they_deliver() -> None:
    latching = {law.name for law in LAWS if law.latches}
    assert {"lankarani-nikravesh", "exact", "flores"} <= latching
    assert not {"tsuji", "kuwabara-kono", "adams-impact", "johnson", "lugre"} & latching
    (flores,) = laws("flores")
    assert flores.restitution is not None
    asked = flores.restitution.asked.index(0.5)
    assert flores.restitution.delivered[asked] == 0.4704
    both = laws("lankarani-nikravesh")
    assert [law.family for law in both] == ["contact", "dissipation"]
    assert both[0].restitution == both[1].restitution


def test_a_family_or_a_law_is_chosen_by_its_name() -> None:
    assert [law.name for law in laws("friction")] == list(FAMILIES["friction"])
    with pytest.raises(InvalidInput) as refused:
        laws("jonson")
    assert "johnson" in str(refused.value)
