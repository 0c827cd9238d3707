"""Reads functions that are made by functions, such as `jointplay.jobs.sweep`, for the reference.

Sources show an assignment; what is assigned has the signature and the documentation.
"""

import inspect
from typing import Any

import griffe

MAKERS = ("_described(", "_submitting(", "awaited(", "changing(", "iterated(")


class MadeFunctions(griffe.Extension):
    """Replaces such assignments by the functions that they make."""

    def on_attribute_instance(self, *, attr: griffe.Attribute, **_: Any) -> None:
        """Replace an attribute by the function that it is."""
        if attr.parent is None or not str(attr.value).startswith(MAKERS):
            return
        made = griffe.dynamic_import(attr.path)
        parameters = map(_parameter, inspect.signature(made).parameters.values())
        function = griffe.Function(
            attr.name,
            lineno=attr.lineno,
            parameters=griffe.Parameters(*parameters),
            docstring=griffe.Docstring(inspect.getdoc(made) or "", parser="numpy"),
            parent=attr.parent,
        )
        attr.parent.set_member(attr.name, function)


def _parameter(one: inspect.Parameter) -> griffe.Parameter:
    kind = griffe.ParameterKind(one.kind.description)
    default = None if one.default is inspect.Parameter.empty else repr(one.default)
    return griffe.Parameter(one.name, kind=kind, default=default)
