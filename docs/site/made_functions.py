"""Reads functions that are made by functions, such as `Client.jobs`, for the reference.

Sources show an assignment, or of the functions of kinds of jobs a loop; what is assigned has the
signature and the documentation.
"""

import inspect
from typing import Any

import griffe

from jointplay.client import Client
from jointplay.jobs import functions

MAKERS = ("awaited(", "changing(", "iterated(")


class MadeFunctions(griffe.Extension):
    """Replaces such assignments by the functions that they make."""

    def on_attribute_instance(self, *, attr: griffe.Attribute, **_: Any) -> None:
        """Replace an attribute by the function that it is."""
        if attr.parent is None or not str(attr.value).startswith(MAKERS):
            return
        _put(attr.parent, attr.name, griffe.dynamic_import(attr.path))

    def on_module_members(self, *, mod: griffe.Module, **_: Any) -> None:
        """Add the functions of all kinds of jobs."""
        if mod.path == "jointplay.jobs":
            for name, made in functions().items():
                _put(mod, name, made)

    def on_class_members(self, *, cls: griffe.Class, **_: Any) -> None:
        """Add the methods of all kinds of jobs."""
        if cls.path == "jointplay.client.client.Client":
            for name in functions():
                _put(cls, name, getattr(Client, name))


def _put(parent: griffe.Module | griffe.Class, name: str, made: Any) -> None:
    function = griffe.Function(
        name,
        parameters=griffe.Parameters(*map(_parameter, inspect.signature(made).parameters.values())),
        docstring=griffe.Docstring(inspect.getdoc(made) or "", parser="numpy"),
        parent=parent,
    )
    parent.set_member(name, function)


def _parameter(one: inspect.Parameter) -> griffe.Parameter:
    kind = griffe.ParameterKind(one.kind.description)
    default = None if one.default is inspect.Parameter.empty else repr(one.default)
    return griffe.Parameter(one.name, kind=kind, default=default)
