"""Cost and accuracy of every method and tolerance, on every preset that integrates anything."""

import jointplay
from jointplay.client import Refused
from jointplay.command_line.accuracy import accuracy_lines
from jointplay.solver.scene import presets


def main() -> None:
    for name in presets.names():
        try:
            job = jointplay.run(jointplay.jobs.accuracy_study(name))
        except Refused:  # drivers prescribe every motion
            continue
        print(f"\n### {name}\n")
        print("\n".join(accuracy_lines(job.accuracy)))


if __name__ == "__main__":
    main()
