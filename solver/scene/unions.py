"""Fields that may be written in several forms: the form is recognised first, then checked strictly.

Pydantic would try every form and complain about each; so only the form that was meant complains.
"""

from collections.abc import Callable, Mapping
from typing import Any

from pydantic import Discriminator, Tag

_PREFIX = "form: "


def form(name: str) -> Tag:
    """Return the mark of one form of a field."""
    return Tag(_PREFIX + name)


def discriminated_by(tell: Callable[[Any], str | None], otherwise: str) -> Discriminator:
    """Return what tells the forms of a field apart.

    `tell` takes the value and returns the name of its form, or None; `otherwise` is said of a value
    that has none of the forms: a sentence without its full stop.
    """

    def tagged(value: Any) -> str | None:
        name = tell(value)
        return None if name is None else _PREFIX + name

    return Discriminator(tagged, custom_error_type="no_such_form", custom_error_message=otherwise)


def is_form(part: str) -> bool:
    """Tell whether a part of an error's location names a form, which is no key of a document."""
    return part.startswith(_PREFIX)


def has(value: Any, field: str) -> bool:
    """Tell whether a value, parsed or not, is an object with a field."""
    return field in value if isinstance(value, Mapping) else hasattr(value, field)
