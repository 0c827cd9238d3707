"""The kinds of jobs as the service describes them."""

from jointplay import job_fields
from jointplay.solver.kinds import KINDS
from tests.service.answers import get


def test_kinds_are_described_as_the_command_line_has_them(http):
    found = get(http, "/v1/kinds")["kinds"]
    assert list(found) == list(KINDS)
    for name, kind in job_fields.KINDS.items():
        assert found[name]["help"] == kind["help"]
        option = kind.get("option")
        assert found[name]["option"] == (option and {"name": None, **option})
        assert found[name]["results"] == list(KINDS[name].results)
        assert list(found[name]["fields"]) == list(kind["fields"])
        for field, shown in found[name]["fields"].items():
            assert shown.items() >= kind["fields"][field].items()
