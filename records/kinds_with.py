"""Which kinds of jobs have a result: what is said where a job of another kind is asked for it."""

from collections.abc import Collection, Mapping


def kinds_with(results: Mapping[str, Collection[str]], *wanted: str) -> str:
    """Return which jobs have one of the wanted results, as the end of a sentence; empty: none.

    `results` : names of the results of each kind, by the kind's name.
    """
    kinds = [kind for kind, names in results.items() if not {*names}.isdisjoint(wanted)]
    listed = " or ".join([", ".join(kinds[:-1])] * (len(kinds) > 1) + kinds[-1:])
    return f"; jobs of kind {listed} do" if kinds else ""
