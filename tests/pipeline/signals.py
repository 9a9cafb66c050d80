#!/usr/bin/python3
"""signals.py PROGRAM SCRATCH RANKS: a signal to one rank, and a time limit, end the run with 9; --resume goes on."""

import json
import os
import shutil
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import program
from box_mesh import box

PROGRAM, SCRATCH, RANKS = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])


def wait_for(condition, seconds=60):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited too long"
        time.sleep(0.005)


def ranks_of(process):
    """The processes that run the program itself; once its handlers are in place."""
    name = PROGRAM.name.encode()
    found = []
    for pid in {process.pid, *program.ranks_of(process)}:
        try:
            if name in Path(f"/proc/{pid}/comm").read_bytes():
                found.append(pid)
        except OSError:
            pass
    return sorted(found)


def catches(pid, number):
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    mask = next(line.split()[1] for line in lines if line.startswith("SigCgt:"))
    return int(mask, 16) >> (number - 1) & 1 == 1


def stop_one_rank(mesh, number):
    out = SCRATCH / f"signal{number}"
    process = program.start(PROGRAM, RANKS, ["run", mesh, "-o", out])
    wait_for(lambda: (out / "log.txt").exists() or process.poll() is not None)
    os.kill(ranks_of(process)[-1], number)
    _, err = process.communicate(timeout=120)
    assert process.returncode == 9, f"signal {number}: exit code {process.returncode}: {err}"
    verdict = json.loads((out / "report.json").read_text())["verdict"]
    assert verdict["code"] == 9 and signal.Signals(number).name in verdict["text"], verdict
    assert (out / "run.h5").exists() and not (out / "hex.vtk").exists()
    resumed = program.run(PROGRAM, 4 - RANKS, ["run", mesh, "-o", out, "--resume"])
    assert resumed.code == 0, resumed.err
    stages = json.loads((out / "report.json").read_text())["stages"]
    assert stages[0]["restored"], stages


def time_limit(mesh):
    out = SCRATCH / "limit"
    stopped = program.run(PROGRAM, RANKS, ["run", mesh, "-o", out, "--time-limit", "0.001"])
    assert stopped.code == 9, stopped.err
    assert "time limit" in json.loads((out / "report.json").read_text())["verdict"]["text"]
    assert program.run(PROGRAM, 4 - RANKS, ["run", mesh, "-o", out, "--resume"]).code == 0
    resumed = json.loads((out / "report.json").read_text())
    first = [s["name"] for s in resumed["stages"]]
    again = program.run(PROGRAM, RANKS, ["run", mesh, "-o", out, "--from", "extract"])
    assert again.code == 0, again.err
    stages = json.loads((out / "report.json").read_text())["stages"]
    assert [s["name"] for s in stages] == first
    assert [s["restored"] for s in stages] == [s["name"] not in ("extract", "improve") for s in stages], stages


def unheard():
    """A wish to stop is granted even where the program cannot hear it: here it waits for a pipe without a writer."""
    pipe, out = SCRATCH / "pipe.vtk", SCRATCH / "unheard"
    os.mkfifo(pipe)
    for command in (["run", pipe, "-o", out], ["info", pipe]):
        process = program.start(PROGRAM, 1, command)
        wait_for(lambda: any(catches(pid, signal.SIGTERM) for pid in ranks_of(process)))
        for pid in ranks_of(process):
            os.kill(pid, signal.SIGTERM)
        _, err = process.communicate(timeout=60)
        assert process.returncode == 9, f"{command}: exit code {process.returncode}: {err}"
        assert "Stopped" in err, err


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    mesh = box(6, 6, 6).write(SCRATCH / "box.vtk")
    for number in (signal.SIGUSR1, signal.SIGTERM):
        stop_one_rank(mesh, number)
    time_limit(mesh)
    if RANKS == 1:
        unheard()
    print(f"signals and time limit on {RANKS} ranks: as they must be")


if __name__ == "__main__":
    main()
