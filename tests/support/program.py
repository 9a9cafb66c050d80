"""Runs the program for tests: alone or under mpirun, with a time limit, never leaving a process behind."""

import os
import re
import signal
import subprocess


class Done:
    def __init__(self, code, out, err):
        self.code = code
        self.out = out
        self.err = err

    def sentences(self):
        """What the program itself says on stderr, without the lines of the launcher."""
        return [line for line in self.err.splitlines() if line.startswith("hexfield: ")]


def command(program, ranks, arguments):
    line = [str(program), *map(str, arguments)]
    return line if ranks == 1 else ["mpirun", "-np", str(ranks), *line]


def start(program, ranks, arguments, **settings):
    """A run in a process group of its own."""
    return subprocess.Popen(command(program, ranks, arguments), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True, **settings)


def kill_all(process):
    """kill -9 of the launcher and of all ranks, which have process groups of their own."""
    ranks = ranks_of(process)
    for pid in [process.pid, *ranks]:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.communicate()


def ranks_of(process):
    """Ids of the processes below a launcher; of the program itself when it runs alone."""
    found, todo = [], [process.pid]
    while todo:
        pid = todo.pop()
        try:
            with open(f"/proc/{pid}/task/{pid}/children") as children:
                below = [int(word) for word in children.read().split()]
        except OSError:
            below = []
        found += below
        todo += below
    return found or [process.pid]


def run(program, ranks, arguments, timeout=300, **settings):
    process = start(program, ranks, arguments, **settings)
    try:
        out, err = process.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        kill_all(process)
        raise AssertionError(f"no end after {timeout} s: {' '.join(command(program, ranks, arguments))}")
    return Done(process.returncode, out, err)


def is_one_sentence(text):
    return re.fullmatch(r"hexfield: \S.*[.?]", text) is not None
