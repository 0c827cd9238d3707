"""A contact law from outside: Hertz's, which loses nothing, latches nothing and has no floor."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
import pytest
from hypothesis import strategies as st
from pydantic import Field

from jointplay.client import Refused
from jointplay.solver.laws.contact import LAWS
from jointplay.solver.laws.contact.law import ContactLaw
from jointplay.solver.laws.fit import Fit
from jointplay.solver.quantities.scalars import Scalar, positive_part, power
from jointplay.solver.scene.document import Scene
from tests.seams.conftest import Platform
from tests.solver.laws.specification.contact import ContactSpecification


class Hertz(ContactLaw):
    """F_n = K δ^1.5.

    Assumes elastic bodies. Fails where impacts lose energy: there is no damping.

    Source: Hertz 1882, as printed in Johnson 1985, Contact Mechanics, eq. 4.22.
    """

    law: Literal["hertz"] = "hertz"
    hardness: Annotated[float, Field(gt=0.0, le=1e18, json_schema_extra={"unit": "N/m^1.5"})]

    def normal_force(self, fit: Fit, depth: Scalar, rate: Scalar, impact_rate: Scalar) -> Scalar:
        return self.hardness * power(positive_part(depth), 1.5)

    def elastic_energy(self, fit: Fit, depth: Scalar) -> Scalar:
        return 0.4 * self.hardness * power(positive_part(depth), 2.5)


class TestHertz(ContactSpecification):
    model = Hertz
    laws = st.builds(Hertz, hardness=st.floats(1e6, 1e12))


HARDNESS, CLEARANCE, SPEED = 1e9, 1e-3, 0.2


def thrown(contact: dict[str, Any]) -> dict[str, Any]:
    """Return a job: a weightless journal thrown against its bearing, across and back."""
    return {
        "kind": "simulate",
        "scene": {
            "name": "thrown-journal",
            "ground": {"points": {"O": [0.0, 0.0]}},
            "bodies": {"journal": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}}},
            "joints": {
                "bearing": {
                    "type": "revolute",
                    "bearing": "ground.O",
                    "journal": "journal.centre",
                    "clearance": {
                        "radial_clearance": CLEARANCE,
                        "bearing_radius": 0.01,
                        "contact": contact,
                    },
                }
            },
            "start": {"velocities": {"journal": [SPEED, 0.0]}},
        },
        "duration": 0.1,
        "tolerance": 1e-9,
    }


@pytest.fixture
def hertz() -> Iterator[None]:
    LAWS["hertz"] = Hertz
    yield
    del LAWS["hertz"]


def test_a_law_that_is_in_no_registry_is_refused_at_its_tag(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(thrown({"law": "hertz", "hardness": HARDNESS}))
    (field,) = refused.value.fields
    assert field.pointer == "/scene/joints/bearing/clearance/contact/law"
    assert "'lankarani-nikravesh'" in field.detail


@pytest.mark.usefixtures("hertz")
def test_its_parameters_are_checked_as_its_own(platform: Platform) -> None:
    pointer = "/scene/joints/bearing/clearance/contact"
    for contact, field, words in (
        ({"law": "hertz", "hardness": -1.0}, "hardness", "greater than 0 N/m^1.5"),
        ({"law": "hertz"}, "hardness", "required"),
        ({"law": "hertz", "hardness": 1.0, "restitution": 0.9}, "restitution", "no field"),
        ({"law": "kelvin"}, "law", "' or 'hertz'"),
    ):
        with pytest.raises(Refused) as refused:
            platform.client.submit(thrown(contact))
        (found,) = refused.value.fields
        assert found.pointer == f"{pointer}/{field}"
        assert words in found.detail


@pytest.mark.usefixtures("hertz")
def test_schemas_describe_it() -> None:
    schema = Scene.model_json_schema()["$defs"]
    choice = schema["Clearance"]["properties"]["contact"]
    assert choice["discriminator"]["mapping"]["hertz"] == "#/$defs/Hertz"
    assert schema["Hertz"]["properties"]["hardness"]["unit"] == "N/m^1.5"


@pytest.mark.usefixtures("hertz")
@pytest.mark.parametrize(
    "formulation", ["reduced", pytest.param("lagrange", marks=pytest.mark.long)]
)
def test_a_journal_bounces_elastically_by_it(platform: Platform, formulation: str) -> None:
    contact = {"law": "hertz", "hardness": HARDNESS}
    job = platform.computed(thrown(contact) | {"formulation": formulation})
    assert job.state == "succeeded"
    impacts = job.impacts
    # the first after c / v, then 2 c / v apart with a contact of 2.94 d / v in between
    deepest = (2.5 * SPEED**2 / (2.0 * HARDNESS)) ** 0.4
    assert len(impacts) == 9
    force = HARDNESS * deepest**1.5
    # tolerance 1e-9 of local error over about a hundred steps a contact
    np.testing.assert_allclose(impacts["peak_force"], force, rtol=1e-5)
    np.testing.assert_allclose(impacts["impulse"], 2.0 * SPEED, rtol=1e-5)
    lasted = impacts["release"] - impacts["onset"]
    np.testing.assert_allclose(lasted, 2.943275184324706 * deepest / SPEED, rtol=1e-4)
    energy = job.statistics["energy"]
    assert abs(energy["contact_loss"]) < 1e-6 * 0.5 * SPEED**2
    # a tangent follows the law, whose derivative is found, not written
    assert job.certificate["exponent"] is not None
    assert np.isfinite(job.certificate["exponent"]["value"])
