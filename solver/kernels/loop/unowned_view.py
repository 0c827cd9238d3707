"""Views of arrays that own nothing: passed between kernels without counting references.

Numba counts the references of every array that it hands to a function, atomically; in the driving
loop that took a sixth of the time. The caller keeps the arrays alive.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from collections.abc import Callable
from typing import Any, cast

from numba.core import cgutils
from numba.extending import intrinsic


def _unowned(_typing: Any, array: Any) -> Any:
    """Return a view of an array that owns nothing."""

    def generate(context, builder, signature, arguments):
        source = context.make_array(signature.args[0])(context, builder, value=arguments[0])
        view = context.make_array(signature.return_type)(context, builder)
        cgutils.copy_struct(view, source)
        view.meminfo = cgutils.get_null_value(view.meminfo.type)
        return view._getvalue()

    return array(array), generate


unowned = cast(Callable[[Any], Any], intrinsic(_unowned))
