#!/usr/bin/python3
"""kill_resume.py PROGRAM SCRATCH [--mesh FILE | --cells N] [--stage STAGE] [--kills K] [--seed S]: kill -9 at random
moments, then go on.

One run is left alone; another is killed K times at random moments and resumed, each time on another number of ranks.
The hex meshes must be equal to 1e-8 in their coordinates, and the log must show no stage computed again that was in
the checkpoint before. With --stage every kill comes inside that stage. The mesh: that of a geometry file by Gmsh, or of
a box of N^3 cells.
"""

import argparse
import json
import random
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import program
from box_mesh import box


def hex_mesh(file):
    """Points and cells (type, vertices, colour) of a legacy VTK file in ASCII."""
    words = file.read_text().split()
    at = words.index("POINTS")
    count = int(words[at + 1])
    points = np.array(words[at + 3: at + 3 + 3 * count], float).reshape(-1, 3)
    at = words.index("CELLS")
    flat = list(map(int, words[at + 3: at + 3 + int(words[at + 2])]))
    cells, place = [], 0
    while place < len(flat):
        cells.append(flat[place + 1: place + 1 + flat[place]])
        place += 1 + flat[place]
    at = words.index("CELL_TYPES")
    types = list(map(int, words[at + 2: at + 2 + len(cells)]))
    at = words.index("LOOKUP_TABLE")
    colours = list(map(int, words[at + 2: at + 2 + len(cells)]))
    return points, list(zip(types, cells, colours))


def largest_difference(file, other_file):
    """Largest distance of corresponding points; the cells must be the same. The numbering may differ: it follows the
    tets in which the points of the integer grid lie, and on their faces the last bits decide."""
    points, cells = hex_mesh(file)
    others, other_cells = hex_mesh(other_file)
    assert len(points) == len(others), f"{len(points)} points became {len(others)}"
    distances, partner = cKDTree(points).query(others)
    assert len(set(partner)) == len(points), "points do not correspond"
    as_set = {(t, frozenset(v), c) for t, v, c in cells}
    other_set = {(t, frozenset(int(partner[i]) for i in v), c) for t, v, c in other_cells}
    assert as_set == other_set and len(cells) == len(other_cells), "the cells differ"
    return distances.max()


def recomputed_stages(log):
    """Stages that begin after a line says that they are in the checkpoint."""
    kept, again = set(), []
    for line in log.read_text().splitlines():
        begins = re.search(r"debug +(\w+) begins\.", line)
        saved = re.search(r"debug +(\w+) is in the checkpoint\.", line)
        if saved:
            kept.add(saved.group(1))
        if begins and begins.group(1) in kept:
            again.append(begins.group(1))
    return again


def end_of(process, seconds):
    """Exit code when the run ends by itself within the time; None after killing it."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if process.poll() is not None:
            process.communicate()
            return process.returncode
        time.sleep(0.01)
    program.kill_all(process)
    return None


def times_begun(log, stage):
    return log.read_text().count(f" {stage} begins.") if log.exists() else 0


def times_kept(log, stage):
    return log.read_text().count(f" {stage} is in the checkpoint.") if log.exists() else 0


def has_begun(process, log, stage, before):
    """Waits until the stage begins once more; False when the run ends without."""
    while times_begun(log, stage) == before:
        if process.poll() is not None:
            return False
        time.sleep(0.005)
    return True


def input_mesh(a):
    if a.mesh is None:
        return box(a.cells, a.cells, a.cells).write(a.scratch / "box.vtk")
    if a.mesh.suffix != ".geo":
        return a.mesh
    file = a.scratch / a.mesh.with_suffix(".msh").name
    subprocess.run(["gmsh", "-3", "-nt", "1", "-format", "msh41", "-save_all", a.mesh, "-o", file], check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    return file


def seconds_of(report, stage):
    return next(s["seconds"] for s in json.loads(report.read_text())["stages"] if s["name"] == stage)


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=Path)
    parser.add_argument("scratch", type=Path)
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--cells", type=int, default=4)
    parser.add_argument("--mesh", type=Path)
    parser.add_argument("--stage")
    parser.add_argument("--hexes", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


def main():
    a = arguments()
    shutil.rmtree(a.scratch, ignore_errors=True)
    a.scratch.mkdir(parents=True)
    mesh = input_mesh(a)
    options = ["--target-hexes", a.hexes, "--checkpoint-interval", 0.2, "--threads", 1]

    start = time.monotonic()
    alone = program.run(a.program, 1, ["run", mesh, "-o", a.scratch / "alone", *options], timeout=1800)
    lasts = time.monotonic() - start
    assert alone.code == 0, f"the run that is left alone: exit code {alone.code}: {alone.err}"
    if a.stage:
        lasts = seconds_of(a.scratch / "alone" / "report.json", a.stage)

    chance = random.Random(a.seed)
    out = a.scratch / "killed"
    resume = ["run", mesh, "-o", out, *options, "--resume"]
    kills = 0
    while kills < a.kills:
        ranks = chance.choice([1, 2, 3])
        wait = chance.uniform(0.05, lasts)
        before = times_begun(out / "log.txt", a.stage)
        process = program.start(a.program, ranks, resume)
        if a.stage and not has_begun(process, out / "log.txt", a.stage, before):
            code = end_of(process, 60)
        else:
            code = end_of(process, wait)
        if code is None and a.stage and times_kept(out / "log.txt", a.stage) > 0:
            shutil.rmtree(out)  # it came too late
            continue
        if code is None:
            kills += 1
            print(f"kill {kills}: {ranks} ranks, after {wait:.2f} s", flush=True)
            continue
        assert code == 0, f"after {kills} kills, on {ranks} ranks: exit code {code}"
        if recomputed_stages(out / "log.txt"):
            break
        compare(a, out)
        # Finished before its kill: the next round starts with an empty directory.
        shutil.rmtree(out)
    done = program.run(a.program, 2, resume, timeout=1800)
    assert done.code == 0, f"after {kills} kills: exit code {done.code}: {done.err}"
    largest = compare(a, out)
    left = [p.name for p in out.iterdir() if "iterate" in p.name or "writing" in p.name]
    assert not left, f"files are left behind: {left}"
    restored = [s["name"] for s in json.loads((out / "report.json").read_text())["stages"] if s["restored"]]
    what = f"stage {a.stage}" if a.stage else "a run"
    print(f"{kills} kills over {what} of {lasts:.1f} s; restored at the end: {restored}; largest difference {largest:.1e}")


def compare(a, out):
    again = recomputed_stages(out / "log.txt")
    assert not again, f"computed again although in the checkpoint: {again}"
    largest = largest_difference(a.scratch / "alone" / "hex.vtk", out / "hex.vtk")
    assert largest <= 1e-8 * (a.cells if a.mesh is None else 1), f"coordinates differ by {largest}"
    return largest


if __name__ == "__main__":
    main()
