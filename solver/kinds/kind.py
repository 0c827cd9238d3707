"""One kind of job: its document, its admission, what it plans and what can be asked of it."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Generic, TypeVar, get_args

from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.statistics import Output

J = TypeVar("J", bound=MechanismJob)


class Kind(ABC, Generic[J]):
    """A member of `solver.kinds.KINDS`; `J` is the model of its documents.

    A member whose answer is points with sections, extremes, statistics or numbers returns a
    `Study`, one whose answer is a trajectory an `Admission`; everything after that is shared. How
    its points are computed is said by `solver.computations`, under the name of the kind.
    """

    document: ClassVar[type[MechanismJob]]
    """The same as `J`. Its field `kind` is a literal, the name of the kind."""
    results: ClassVar[tuple[str, ...]] = ("points", "figures", "zarr")
    """Parts of a job's address in the service under which its results are read."""
    loads_much: ClassVar[bool] = False
    """Whether checking a document loads what nothing else of an API needs."""

    option: ClassVar[str] = ""
    """Option of a command line that asks for it, if that is not its name."""

    @property
    def name(self) -> str:
        """Name by which documents ask for it."""
        return str(get_args(self.document.model_fields["kind"].annotation)[0])

    @abstractmethod
    def admit(self, job: J) -> Admission | Study:
        """Check a parsed job whole and fill in its defaults.

        Raises
        ------
        InvalidInput
            With what is wrong, at its field or value.
        LimitExceeded
            The job is sound but too large; the sentence gives the estimate.
        """

    @abstractmethod
    def plan(self, job: J, filled: dict[str, Any]) -> Admission | Study:
        """Return what `admit` returned for a job that it filled in; nothing is checked again.

        `job` is parsed from `filled`: `Admission.job` or `Study.job`, as it was stored.
        """

    def varied(self, job: J, study: Study) -> Iterable[str]:
        """Return the parameters that it varies: values that a scene has of them have no effect."""
        return study.parameters

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return unit and long name of numbers a point that not every study has, by name."""
        return {}
