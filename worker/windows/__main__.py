"""`python -m jointplay.worker.windows FD`: answers questions about trajectories, until it is idle.

Receives each through the connection whose file descriptor is its argument.
"""

from jointplay.worker.answering import answer_questions
from jointplay.worker.windows.evaluate import answer

_IDLE = 300.0  # s

if __name__ == "__main__":
    answer_questions(answer, _IDLE)
