"""A dict that forgets."""

from jointplay.records.bounded_dict import BoundedDict


def test_what_was_set_longest_ago_is_forgotten_first() -> None:
    kept: BoundedDict[str, int] = BoundedDict(2)
    kept["a"] = 1
    kept["b"] = 2
    kept["a"] = 3  # once more
    kept["c"] = 4
    assert list(kept.items()) == [("a", 3), ("c", 4)]
    kept["c"] += 1
    assert kept == {"a": 3, "c": 5}
