"""The kernel of a job's run, and of what makes its steps again."""

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.runs.admission import Admission


def run_kernel(admission: Admission, method: str) -> Kernel:
    """Return the kernel of a run by a method; companions of a certificate are beside it.

    Raises what `ready_kernel` does.
    """
    job = admission.job
    alone = not job["certificate"]
    return ready_kernel(admission.scene, job["formulation"], method, alone=alone)
