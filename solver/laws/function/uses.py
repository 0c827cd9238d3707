"""Functions in fields of a document: what a table is between its knots where it does not say.

What moves a joint needs an acceleration that varies smoothly; a force should not exceed what was
given.
"""

from typing import Annotated

from pydantic import AfterValidator

from jointplay.solver.laws.function import FUNCTIONS, Function
from jointplay.solver.quantities.registry import MemberOf

Prescribed = Annotated[
    Function,
    MemberOf(FUNCTIONS, "type", required=True),
    AfterValidator(lambda function: function.used("smooth")),
]
"""A motion, or a profile that moves a follower."""
Course = Annotated[
    Function,
    MemberOf(FUNCTIONS, "type", required=True),
    AfterValidator(lambda function: function.used("monotone")),
]
"""A factor of a force that varies."""
