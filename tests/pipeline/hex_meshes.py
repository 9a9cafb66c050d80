#!/usr/bin/python3
"""hex_meshes.py PROGRAM SCRATCH: hex meshes as the input of `hexfield info` and `hexfield decompose`.

Broken meshes end with exit code 3 and one sentence that names the place; good ones in every format and layout that
others write come through; `hexfield run --decompose` says in its report what came of it; meshes of other origin
(python-post/hex_meshes.py) lose their nodes, or the rest is reported, and keep their shape and features.
"""

import json
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
sys.dont_write_bytecode = True
import program

PROGRAM, SCRATCH = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
# Minutes each, with the integer program.
TOO_LONG = ["blocks_lattice", "blocks_random", "blocks_sponge", "split_lattice", "swept_gear"]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def grid(nx, ny, nz, shift=(0, 0, 0), edge=1.0):
    """points, hexes of nx x ny x nz cubes."""
    points = [(shift[0] + edge * x, shift[1] + edge * y, shift[2] + edge * z)
              for z in range(nz + 1) for y in range(ny + 1) for x in range(nx + 1)]
    cells = [(x, y, z) for z in range(nz) for y in range(ny) for x in range(nx)]
    return points, [tuple(x + i + (nx + 1) * (y + j + (ny + 1) * (z + k)) for i, j, k in CORNERS) for x, y, z in cells]


def joined(first, second):
    """Two meshes with the vertices at equal places made one."""
    points, index = list(first[0]), {p: v for v, p in enumerate(first[0])}
    for p in second[0]:
        if p not in index:
            index[p] = len(points)
            points.append(p)
    return points, first[1] + [tuple(index[second[0][v]] for v in h) for h in second[1]]


def vtk(mesh):
    points, hexes = mesh
    lines = ["# vtk DataFile Version 2.0", "hexes", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [" ".join(map(repr, map(float, p))) for p in points]
    lines += [f"CELLS {len(hexes)} {9 * len(hexes)}"] + ["8 " + " ".join(map(str, h)) for h in hexes]
    return "\n".join(lines + [f"CELL_TYPES {len(hexes)}"] + ["12"] * len(hexes)) + "\n"


def column_cut(bent):
    """The middle column of 3 x 3 x 2 hexes cut in two along a bent face: its inner edges lie between two hexes."""
    points, hexes = grid(3, 3, 2)
    extra = len(points)
    points += [(1.6, 1.4, z) for z in range(3)]
    for z in range(2):
        c, x = hexes[4 + 9 * z], extra + z
        hexes[4 + 9 * z] = (c[0], c[1], c[2], x, c[4], c[5], c[6], x + 1)
        hexes.append((c[0], x, c[2], c[3], c[4], x + 1, c[6], c[7]) if bent else (x, c[1], c[2], c[3], x + 1, *c[5:8]))
    return points, hexes


def inverted():
    points, hexes = grid(2, 2, 2)
    points[13] = (2.5, 1.0, 1.0)
    return points, hexes


def valence_one():
    """A hex whose two faces at an edge are one face of the neighbour's: that edge lies inside, in one hex only."""
    points, hexes = grid(1, 1, 1)
    a = hexes[0]
    return points + [(2, 0, 0), (2, 0, 1)], [a, (a[1], 8, a[2], a[1], a[5], 9, a[6], a[5])]


BROKEN = [  # name, mesh, words of the sentence
    ("edge_only", joined(grid(1, 1, 1), grid(1, 1, 1, (1, 1, 0))), ["(1, 1, 0.5)"]),
    ("vertex_only", joined(grid(1, 1, 1), grid(1, 1, 1, (1, 1, 1))), ["(1, 1, 1)", "do not hang together"]),
    ("face_in_three", (grid(3, 1, 1)[0] + [(1, 0, -1), (2, 0, -1), (2, 1, -1), (1, 1, -1)],
                       grid(3, 1, 1)[1] + [(1, 2, 6, 5, 9, 10, 14, 13)]), ["("]),
    ("hanging", joined(grid(1, 1, 1, edge=2.0), grid(2, 2, 1, (0, 0, 2))), ["defects", "(0, 0, 2)"]),
    ("doubled_vertices", (grid(1, 1, 1)[0] + grid(1, 1, 1, (1, 0, 0))[0],
                          grid(1, 1, 1)[1] + [tuple(v + 8 for v in h) for h in grid(1, 1, 1)[1]]), ["hanging", "(1, "]),
    ("doubled_hex", (grid(2, 2, 2)[0], grid(2, 2, 2)[1] + [grid(2, 2, 2)[1][3]]), ["same vertices", "(1.5, 1.5, 0.5)"]),
    ("valence_one", valence_one(), ["twice", "("]),
    ("valence_two", column_cut(True), ["("]),
    ("inverted", inverted(), ["scaled Jacobian", "("]),
    ("vertex_twice", (grid(2, 1, 1)[0], [(0, 1, 1, 3, 6, 7, 10, 9), grid(2, 1, 1)[1][1]]), ["twice", "("]),
]


def one_sentence(done, words):
    said = done.sentences()
    if len(said) != 1 or not program.is_one_sentence(said[0]):
        return [f"not one sentence: {said} in {done.err[-1000:]}"]
    return [f"'{word}' is not in: {said[0]}" for word in words if word not in said[0]]


def broken_meshes():
    for name, mesh, words in BROKEN:
        file, out = SCRATCH / f"{name}.vtk", SCRATCH / f"{name}.out.vtk"
        file.write_text(vtk(mesh))
        for arguments in (["info", file], ["decompose", file, "-o", out]):
            done = program.run(PROGRAM, 1, arguments, timeout=120)
            wrong = [f"exit code {done.code} instead of 3: {done.err[-300:]}"] if done.code != 3 else []
            wrong += one_sentence(done, [file.name, *words])
            wrong += ["a mesh was written"] if out.exists() else []
            yield [f"{name}, {arguments[0]}: {w}" for w in wrong]


def other_writers():
    """Files of meshio in every way it has, and those of the program itself."""
    import meshio
    import numpy as np

    points, hexes = grid(2, 2, 1)
    mesh = meshio.Mesh(np.array(points, float), [("hexahedron", np.array(hexes)), ("quad", np.array([hexes[0][:4]]))],
                       cell_data={"CellEntityIds": [np.array([1, 1, 2, 2]), np.array([7])]})
    files = []
    for name, settings in (("text.vtu", {"binary": False}), ("zlib.vtu", {"compression": "zlib"}),
                           ("plain.vtu", {"compression": None}), ("mesh.vtk", {})):
        files.append(SCRATCH / name)
        meshio.write(files[-1], mesh, **settings)
    for name in ("own.vtu", "own.msh", "own.mesh", "own.vtk"):
        files.append(SCRATCH / name)
        done = program.run(PROGRAM, 1, ["convert", files[3], files[-1]])
        yield [f"{name}: {done.err}"] if done.code != 0 else []
    for file in files:
        done = program.run(PROGRAM, 1, ["info", file])
        wanted = ["hexes     4", "vertices  18", "quads     1 in 1 colours", "nodes     0"]
        yield [f"{file.name}: '{w}' is not in {done.out}{done.err}" for w in wanted if w not in done.out]
        out = SCRATCH / f"{file.name}.after.vtk"
        done = program.run(PROGRAM, 1, ["decompose", file, "-o", out])
        yield [f"{file.name}: decompose: {done.code} {done.err}"] if done.code != 0 or not out.exists() else []


def decomposed_run():
    mesh, out = ROOT / "tests" / "data" / "tetrahedron.msh", SCRATCH / "run"
    done = program.run(PROGRAM, 1, ["run", mesh, "-o", out, "--target-hexes", "200", "--decompose"])
    report = json.loads((out / "report.json").read_text())
    found = report["decomposition"]
    wrong = [f"exit code {done.code}: {done.err}"] if done.code != 0 else []
    wrong += [] if report["options"]["decompose"] else ["the option is not in the report"]
    wrong += [] if found["nodes"]["before"] == 1 and found["nodes"]["after"] == 0 else [f"nodes: {found}"]
    better = found["scaled_jacobian_min"]["after"] > found["scaled_jacobian_min"]["before"]
    wrong += [] if found["taken"] == better and found["sheets"] == 1 else [f"taken though not better: {found}"]
    smallest = found["scaled_jacobian_min"]["after" if better else "before"]
    wrong += [] if report["hex"]["scaled_jacobian"]["min"] == smallest else [f"{report['hex']} is not that of {found}"]
    info = program.run(PROGRAM, 1, ["info", out / "hex.vtk"]).out
    wrong += [] if f"nodes     {0 if better else 1}" in info else [f"hex.vtk is another mesh: {info}"]
    # The checkpoint keeps what was found.
    done = program.run(PROGRAM, 1, ["run", mesh, "-o", out, "--target-hexes", "200", "--decompose", "--resume"])
    again = json.loads((out / "report.json").read_text())["decomposition"]
    wrong += [] if done.code == 0 and again == found else [f"resumed: {again} instead of {found}"]
    yield [f"run --decompose: {w}" for w in wrong]


def stopped():
    """A signal or the time limit ends the search, also inside the integer program, with a mesh and exit code 9."""
    made = SCRATCH / "stopped"
    script = [sys.executable, str(ROOT / "python-post" / "hex_meshes.py"), str(made), "blocks_lattice"]
    subprocess.run(script, check=True, stdout=subprocess.DEVNULL)
    for name, limit in (("signal", []), ("limit", ["--time-limit", "2"])):
        out = SCRATCH / f"{name}.vtk"
        process = program.start(PROGRAM, 1, ["decompose", made / "blocks_lattice.vtk", "-o", out, "--threads", "1", *limit])
        if not limit:
            time.sleep(2)
            process.send_signal(signal.SIGTERM)
        begin = time.monotonic()
        try:
            text, err = process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            program.kill_all(process)
            yield [f"stopped by {name}: deaf"]
            continue
        wrong = [f"exit code {process.returncode}: {err}"] if process.returncode != 9 else []
        wrong += [f"only after {time.monotonic() - begin:.1f} s"] if time.monotonic() - begin > 30 else []
        wrong += one_sentence(program.Done(process.returncode, text, err), ["Stopped by", out.name])
        wrong += [] if "the search was stopped" in text else [f"not in the report: {text[-300:]}"]
        check = program.run(PROGRAM, 1, ["check", out, "--against", made / "blocks_lattice.tets.vtk"])
        wrong += [f"check: {check.out}{check.err}"] if check.code != 0 else []
        yield [f"stopped by {name}: {w}" for w in wrong]


def other_origins():
    made = SCRATCH / "made"
    script = [sys.executable, str(ROOT / "python-post" / "hex_meshes.py"), str(made)]
    subprocess.run(script, check=True, stdout=subprocess.DEVNULL)
    for file in sorted(made.glob("*.tets.vtk")):
        name = file.name.removesuffix(".tets.vtk")
        if name in TOO_LONG:
            continue
        out = SCRATCH / f"{name}.vtk"
        done = program.run(PROGRAM, 1, ["decompose", made / f"{name}.vtk", "-o", out, "--threads", "1"], timeout=600)
        wrong = [f"exit code {done.code}: {done.err}"] if done.code != 0 else []
        nodes = re.findall(r"nodes     (\d+)", done.out)
        quality = re.findall(r"smallest scaled Jacobian ([\d.-]+)", done.out)
        print(f"{name}: nodes {' -> '.join(nodes)}, smallest scaled Jacobian {' -> '.join(quality)}", flush=True)
        if not nodes or (nodes[-1] != "0" and "the search was exhaustive" not in done.out):
            wrong.append(f"nodes are left without proof: {done.out[-600:]}")
        check = program.run(PROGRAM, 1, ["check", out, "--against", file])
        wrong += [f"check: {check.out}{check.err}"] if check.code != 0 else []
        yield [f"{name}: {w}" for w in wrong]


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    wrong, cases = [], 0
    for group in (broken_meshes(), other_writers(), decomposed_run(), stopped(), other_origins()):
        for found in group:
            cases += 1
            wrong += found
            for line in found:
                print(line, flush=True)
    print(f"{cases} cases, {len(wrong)} wrong")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
