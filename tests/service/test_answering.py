"""The process that answers one question at a time: lost, too slow, asked by too many, ended."""

import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

import pytest

from jointplay.service import answering
from jointplay.service.answering import AnsweringProcess, Busy, Hindered, NoAnswer, TooSlow
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.processor_time import processor_time
from tests.waiting import is_alive, until

PROGRAM = """
import os
import sys
import time
from multiprocessing.connection import Connection
from pathlib import Path

open("started", "a").write("once\\n")
while Path("slowly").exists():
    time.sleep(0.01)
with Connection(int(sys.argv[1])) as asking:
    asking.send(None)
    while True:
        what, file = asking.recv()
        if what == "end unless there":
            known = Path(file).exists()
            Path(file).touch()
            if not known:
                os._exit(0)
        while what == "wait until there" and not Path(file).exists():
            time.sleep(0.01)  # leaves the processor to whoever makes the file
        if what == "end":
            os._exit(0)
        asking.send(os.getpid())
"""


@pytest.fixture
def process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[AnsweringProcess]:
    (tmp_path / "answering_program.py").write_text(PROGRAM)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    made = AnsweringProcess("answering_program", 600.0)
    yield made
    made.close()


def starts() -> int:
    return Path("started").read_text().count("once")


def test_a_question_that_is_lost_with_the_process_is_asked_once_more(process):
    assert process.answer(("end unless there", "mark")) == process.answer(("answer", ""))
    assert starts() == 2


def test_a_question_that_ends_the_process_twice_has_no_answer(process):
    with pytest.raises(NoAnswer):
        process.answer(("end", ""))
    assert starts() == 2
    assert is_alive(process.answer(("answer", "")))


def computes(monkeypatch: pytest.MonkeyPatch, looked: Callable[[int], float | None]) -> None:
    """Have the process compute as long as `looked` says, in s, of the looks at it so far."""
    looks = count()
    monkeypatch.setattr(answering, "processor_time", lambda _: looked(next(looks)))


@pytest.mark.parametrize("spent", [lambda looks: 0.05 * looks, lambda _: None])
def test_an_answer_that_takes_too_long_ends_the_process(process, monkeypatch, spent):
    """By its computing, or by the clock where the system does not tell that."""
    pid = process.answer(("answer", ""))
    process.patience = 0.1
    computes(monkeypatch, spent)
    with pytest.raises(TooSlow):
        process.answer(("wait until there", "never"))
    assert not is_alive(pid)
    assert starts() == 1


def test_a_process_that_is_not_let_compute_is_waited_for(process, monkeypatch):
    """A scene of five bodies was refused as too large, since others had the processors."""

    def looked(looks: int) -> float:
        if looks == 3:
            Path("there").touch()
        return 0.0

    process.patience = 0.2
    computes(monkeypatch, looked)
    assert is_alive(process.answer(("wait until there", "there")))


def test_who_asks_a_process_that_is_never_let_compute_may_ask_again(process, monkeypatch):
    process.patience = 0.05
    computes(monkeypatch, lambda _: 0.0)
    with pytest.raises(Hindered):
        process.answer(("wait until there", "never"))
    with pytest.raises(RequestRefused) as refused, answering.refusing("", ValueError(), ""):
        process.answer(("wait until there", "never"))
    assert refused.value.kind is kinds.UNAVAILABLE


@pytest.mark.skipif(sys.platform != "linux", reason="nothing tells it")
def test_the_computing_of_what_a_process_has_started_counts(tmp_path):
    program = "import subprocess, sys; subprocess.run([sys.executable, '-c', sys.argv[1]])"
    spin = "import time\nwhile time.process_time() < 0.3: pass\nopen('spun', 'w')\ninput()"
    gone = os.spawnv(os.P_NOWAIT, sys.executable, [sys.executable, "-c", "pass"])
    os.waitpid(gone, 0)
    assert processor_time(gone) is None
    with subprocess.Popen(
        [sys.executable, "-c", program, spin], cwd=tmp_path, stdin=subprocess.PIPE
    ) as started:
        until((tmp_path / "spun").exists)
        assert processor_time(started.pid) >= 0.28


def test_the_start_is_no_part_of_an_answer(tmp_path, process):
    slowly = tmp_path / "slowly"
    slowly.touch()
    slow = AnsweringProcess("answering_program", 600.0, start=0.1)
    with pytest.raises(Busy):
        slow.answer(("answer", ""))
    slowly.unlink()
    slow.start = 600.0
    assert is_alive(slow.answer(("answer", "")))
    assert starts() == 1  # it went on starting
    slow.close()


def test_one_too_many_is_not_kept_waiting(process):
    answers = []

    def ask():
        answers.append(process.answer(("wait until there", "go")))

    askers = [threading.Thread(target=ask) for _ in range(8)]
    for asker in askers:
        asker.start()
    until(lambda: process.queue.waiting() == 7)
    with pytest.raises(Busy):
        process.answer(("answer", ""))
    Path("go").touch()
    for asker in askers:
        asker.join()
    assert len(answers) == 8
    assert {process.answer(("answer", ""))} == set(answers)


def test_a_process_that_is_closed_has_ended_and_another_is_started(process):
    pid = process.answer(("answer", ""))
    process.close()
    assert not is_alive(pid)
    assert process.answer(("answer", "")) != pid
