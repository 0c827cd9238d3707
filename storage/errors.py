"""Errors of results stores."""


class ResultsError(Exception):
    """Base of every error of this package; its text is a full sentence."""


class InvalidLayout(ResultsError):
    """The layout names something that a store cannot hold."""


class InvalidAppend(ResultsError):
    """Rows do not continue where the last ones ended, or do not fit the layout."""


class StoreExists(ResultsError):
    """The folder already holds a store; a store is written once."""


class StoreSealed(ResultsError):
    """The store has been sealed and takes no more rows."""


class NotAStore(ResultsError):
    """The folder holds no results store that this version can read."""


class CorruptStore(ResultsError):
    """The files are not those that the manifest or the checkpoint speaks of."""


class LostObject(CorruptStore):
    """A file is gone that should be there."""


class CheckpointMismatch(ResultsError):
    """The checkpoint belongs to another layout, or to a folder that lacks its rows."""


class IncompleteStudy(ResultsError):
    """Blocks of a study are missing that should be there when it is sealed."""


class TooLarge(ResultsError):
    """An object has more bytes than its object store takes."""


class UnknownChannel(ResultsError):
    """A channel was asked for that the store does not have."""

    def __init__(self, name: str, known: tuple[str, ...]) -> None:
        super().__init__(f"there is no channel {name!r}; the channels are {', '.join(known)}")
        self.name = name
