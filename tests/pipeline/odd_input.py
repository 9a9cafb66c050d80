#!/usr/bin/python3
"""odd_input.py PROGRAM SCRATCH RANKS: odd but legal input gives a mesh or a verdict with its reason, never a hang."""

import json
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import program
from box_mesh import TetFile, box, joined

PROGRAM, SCRATCH, RANKS = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])

ONE_TET = TetFile([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(10, (0, 1, 2, 3), 1)])
CASES = [  # name, mesh, exit codes that are right, options
    ("several_components", joined(box(1, 1, 1), box(2, 1, 1, origin=(5.0, 0.0, 0.0))), {0}, ["--target-hexes", "24"]),
    ("no_tags", box(2, 2, 2, tags=False), {0}, ["--target-hexes", "64"]),
    ("one_tet", ONE_TET, {0, 4, 5, 6, 7}, ["--target-hexes", "10"]),
    ("more_ranks_than_tets", box(1, 1, 1), {0}, ["--target-hexes", "8"]),
    ("edge_length", box(2, 1, 1), {0}, ["--edge-length", "0.5"]),
    ("far_away_and_small", box(2, 1, 1, origin=(1e4, -1e4, 1e4), edge=1e-3), {0}, ["--target-hexes", "16"]),
    ("one_hex_wanted", box(2, 2, 2), {0}, ["--target-hexes", "1"]),
]


def result_of(name, mesh, codes, options):
    file = mesh.write(SCRATCH / f"{name}.vtk")
    out = SCRATCH / name
    ranks = 8 if name == "more_ranks_than_tets" else RANKS
    done = program.run(PROGRAM, ranks, ["run", file, "-o", out, "--check", *options], timeout=200)
    if done.code not in codes:
        return [f"{name}: exit code {done.code}, not in {sorted(codes)}: {done.err[-1500:]}"]
    verdict = json.loads((out / "report.json").read_text())["verdict"]
    wrong = [] if verdict["code"] == done.code and len(verdict["text"]) > 20 else [f"{name}: verdict {verdict}"]
    if done.code == 0 and program.run(PROGRAM, 1, ["check", out / "hex.vtk", "--against", file]).code != 0:
        wrong.append(f"{name}: hexfield check finds defects in hex.vtk")
    if done.code in (4, 5, 6, 7) and not (out / "why.vtk").exists():
        wrong.append(f"{name}: no why.vtk")
    print(f"{name}: {verdict['code']}: {verdict['text']}")
    return wrong


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    wrong = [w for case in CASES for w in result_of(*case)]
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
