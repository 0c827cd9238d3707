"""Answers to the reports of a block that is computed."""

from collections.abc import Callable

from jointplay.worker.execute import Answer, Progress


def after(slices: int, answer: Answer, names: list[str]) -> Callable[[Progress], Answer]:
    """Let so many slices pass, then take a restart point and give an answer."""
    seen = 0

    def report(progress: Progress) -> Answer:
        nonlocal seen
        seen += 1
        if seen <= slices:
            return Answer.go_on
        names.append(progress.keep()[0])
        return answer

    return report
