"""Job documents by name: what `jointplay.Client` submits and `jointplay.run` computes.

A scene is the name of a preset, a scene document, or the path of one.  Every kind takes its
fields; every other name is a parameter of the scene, in SI units:

>>> from jointplay import jobs
>>> jobs.simulate("pendulum", duration=1.0, mass=2.0, label="heavy")["scene"]
{'preset': 'pendulum', 'parameters': {'mass': 2.0}}
"""

from collections.abc import Callable, Mapping
from functools import partial
from inspect import Parameter, Signature
from textwrap import fill
from typing import Any

from jointplay.job_fields import KINDS, REQUEST, help_of
from jointplay.scene_choice import Scene, scene_document, with_parameters

Document = dict[str, Any]
_paragraph = partial(fill, width=96, initial_indent="    ", subsequent_indent="    ")


def _described(kind: str) -> Callable[..., Document]:
    """Return the function that makes documents of a kind: its own fields also by position."""
    fields = KINDS[kind]["fields"]
    signature = _signature(fields)

    def describe(*args: Any, **named: Any) -> Document:
        bound = signature.bind(*args, **named).arguments
        scene, parameters = bound.pop("scene"), bound.pop("given", {})
        written = {
            name: _as_field(fields.get(name, {}), value)
            for name, value in bound.items()
            if value is not None
        }
        values = {name: _plain(value) for name, value in parameters.items()}
        chosen = with_parameters(scene_document(scene), values, fields)
        return {"kind": kind, "scene": chosen, **written}

    shown: Any = describe  # for those who ask with help() or a question mark
    shown.__name__ = shown.__qualname__ = kind.replace("-", "_")
    shown.__signature__ = signature
    shown.__doc__ = _documentation(KINDS[kind]["help"], fields)
    return describe


def _signature(fields: Mapping[str, Any]) -> Signature:
    parameters = [Parameter("scene", Parameter.POSITIONAL_OR_KEYWORD, annotation=Scene)]
    own = [name for name, field in fields.items() if "own" in field]
    for name in sorted(own, key=lambda name: "required" not in fields[name]):
        default = Parameter.empty if "required" in fields[name] else None
        parameters.append(Parameter(name, Parameter.POSITIONAL_OR_KEYWORD, default=default))
    others = [*(name for name in fields if name not in own), *REQUEST]
    parameters += [Parameter(name, Parameter.KEYWORD_ONLY, default=None) for name in others]
    parameters.append(Parameter("given", Parameter.VAR_KEYWORD))
    return Signature(parameters, return_annotation=Document)


def _documentation(summary: str, fields: Mapping[str, Any]) -> str:
    described = {"scene": "Name of a preset, a scene document, or the path of one."}
    described |= {name: help_of(field) for name, field in fields.items()}
    described["cache, expires"] = (
        "Whether an identical job of a service will do, and when it may go, RFC 3339."
    )
    described["given"] = "Parameters of the scene, in SI units."
    lines = [f"{name}\n{_paragraph(text)}" for name, text in described.items()]
    return "\n".join([summary, "", "Parameters", "----------", *lines, ""])


def _as_field(field: Mapping[str, Any], value: Any) -> Any:
    """Return a value as the document has it: one name is a list of one."""
    single = field.get("form") == "names" and isinstance(value, str)
    return [value] if single and value not in field.get("words", ()) else _plain(value)


def _plain(value: Any) -> Any:
    """Return numbers and arrays of numpy, and any sequence, as JSON takes them."""
    if isinstance(value, Mapping):
        return {name: _plain(one) for name, one in value.items()}
    if hasattr(value, "tolist"):
        return value.tolist()
    return [_plain(one) for one in value] if isinstance(value, list | tuple | range) else value


def functions() -> dict[str, Callable[..., Document]]:
    """Return the function of every kind, by its name."""
    return {kind.replace("-", "_"): _described(kind) for kind in KINDS}


def __getattr__(name: str) -> Callable[..., Document]:
    """Return the function of a kind, which makes its documents."""
    found = functions()
    if name not in found:
        raise AttributeError(f"module 'jointplay.jobs' has no attribute {name!r}")
    globals().update(found)
    return found[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *functions()})
