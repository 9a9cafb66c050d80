#!/usr/bin/python3
"""Smallest scaled Jacobian of singular nodes before and after their decomposition, as a Markdown table.

    decompose_table.py HEXFIELD DIRECTORY [--rows NAME...] [--check]

Makes hex meshes in DIRECTORY (one hex per triangle around each of the eight nodes with valences 3, 4 and 5; a padded
cube, tetrahedron and prism, a sphere and an ellipsoid), runs HEXFIELD decompose on each with a free boundary, once
without sheets and once with, and prints what the program says beside the figures of the paper. With --check it ends with
status 1 when a row falls short of the paper by more than 0.005 or a node is left.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

from hex_meshes import blocks_u, grid, refined, swept_hexagon

# Triangles around each node, counter-clockwise seen from outside.
NODES = {
    "(4,0,0)": "123 134 142 243",
    "(2,2,2)": "126 165 153 134 142 243 235 256",
    "(0,4,4)": "126 168 187 174 142 243 235 256 347 378 385 586",
    "(1,3,3)": "126 167 173 134 142 243 235 256 375 576",
    "(0,3,6)": "127 178 183 134 142 249 296 267 385 359 394 586 569 687",
    "(0,2,8)": "128 185 153 134 142 24a 2a7 278 359 394 49a 586 569 687 67a 6a9",
    "(2,0,6)": "126 165 158 184 142 243 235 256 347 378 385 487",
    "(0,0,12)": "128 18a 1a3 134 142 24c 2c7 278 3a5 35b 3b4 4bc 5a9 596 56b 697 67c 6cb 798 89a",
}
PAPER = {
    "(4,0,0)": (0.769, 0.86), "(2,2,2)": (0.807, 0.862), "(0,4,4)": (0.896, 0.943), "(1,3,3)": (0.822, 0.865),
    "(0,3,6)": (0.863, 0.939), "(0,2,8)": (0.82, 0.937), "(2,0,6)": (0.745, 0.856), "(0,0,12)": (0.761, 0.926),
    "sphere": (0.768, 0.849), "padded tetrahedron": (0.715, 0.812), "ellipsoid": (0.767, 0.825),
    "12 nodes, 36 curves (as G1)": (0.769, 0.811), "16 nodes, 40 curves (as G2)": (0.757, 0.82),
}  # fmt: skip


def spread(triangles, count):
    """Unit vectors (count, 3) for the vertices of a sphere triangulation, no triangle too thin.

    Barycentric around the first triangle, lifted to the sphere; then each vertex climbs to a larger smallest
    determinant of its triangles.
    """
    places = np.zeros((count, 3))
    angles = -2 * np.pi * np.arange(3) / 3
    places[triangles[0]] = 4 * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    around = [sorted({int(w) for t in triangles if v in t for w in t} - {v}) for v in range(count)]
    for _ in range(500):
        for v in set(range(count)) - set(triangles[0].tolist()):
            places[v] = places[around[v]].mean(axis=0)
    square = (places**2).sum(axis=1, keepdims=True)
    places = np.concatenate([2 * places[:, :2], 1 - square], axis=1) / (1 + square)
    fans = [np.array([t for t in triangles if v in t]) for v in range(count)]
    step = 0.2
    while step > 1e-3:
        for v in range(count):
            for direction in np.concatenate([np.eye(3), -np.eye(3)]):
                old = places[v].copy()
                before = np.linalg.det(places[fans[v]]).min()
                places[v] = (old + step * direction) / np.linalg.norm(old + step * direction)
                if np.linalg.det(places[fans[v]]).min() <= before:
                    places[v] = old
        step *= 0.93
    return places


def cone(words):
    """points, hexes: a parallelepiped per triangle around vertex 0."""
    triangles = np.array([[int(c, 16) - 1 for c in word] for word in words.split()])
    count = triangles.max() + 1
    unit = spread(triangles, count)
    points, index, hexes = [np.zeros(3), *unit], {}, []

    def point(*corners):
        key = tuple(sorted(corners))
        if key not in index:
            index[key] = len(points)
            points.append(unit[list(key)].sum(axis=0))
        return index[key]

    for a, b, c in triangles:
        hexes.append([0, a + 1, point(a, b), b + 1, c + 1, point(c, a), point(a, b, c), point(b, c)])
    return np.array(points), np.array(hexes)


def write(path, points, hexes):
    import meshio

    meshio.write(path, meshio.Mesh(points, [("hexahedron", hexes)]), file_format="vtk42", binary=True)


def meshes():
    """(name, points, hexes, layers to pad) of every row."""
    for name, words in NODES.items():
        yield name, *cone(words), 0
    cube = grid(4)
    yield "padded cube", *cube, 1
    yield "padded tetrahedron", *refined(*cone(NODES["(4,0,0)"])), 1
    yield "padded prism", *refined(*cone("134 145 153 243 254 235")), 1
    ball = cube[0] / np.maximum(np.linalg.norm(cube[0], axis=1, keepdims=True), 1)
    yield "sphere", ball * 1.0, cube[1], 1
    yield "ellipsoid", ball * [2.0, 1.0, 1.0], cube[1], 1
    yield "12 nodes, 36 curves (as G1)", *swept_hexagon(), 0
    yield "16 nodes, 40 curves (as G2)", *blocks_u(), 0


def decompose(program, mesh, output, extra):
    """What the program says, as text, and the smallest scaled Jacobian and sheets at its end."""
    command = [program, "decompose", str(mesh), "-o", str(output), "--free-boundary", *extra]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    found = re.search(r"after (\d+) sheets: (\d+) hexes, smallest scaled Jacobian ([\d.-]+)", done.stdout)
    if done.returncode != 0 or not found:
        raise SystemExit(f"{' '.join(command)} ended with {done.returncode}: {done.stderr or done.stdout}")
    nodes = re.findall(r"nodes     (\d+)", done.stdout)
    return int(found[1]), float(found[3]), int(nodes[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="HEXFIELD")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--rows", nargs="+", metavar="NAME", help="only these rows")
    parser.add_argument("--check", action="store_true", help="fail when a row falls short of the paper")
    options = parser.parse_args()
    options.directory.mkdir(parents=True, exist_ok=True)
    print("| mesh | sheets | nodes left | before | paper | after | paper |\n|---|---|---|---|---|---|---|")
    short, rows = [], 0
    for number, (name, points, hexes, layers) in enumerate(meshes()):
        if options.rows and name not in options.rows:
            continue
        rows += 1
        file = options.directory / f"mesh{number}.vtk"
        write(file, points, hexes)
        padding = ["--pad", str(layers)]
        _, before, _ = decompose(options.program, file, options.directory / f"before{number}.vtk", [*padding, "--budget", "0"])
        sheets, after, nodes = decompose(options.program, file, options.directory / f"after{number}.vtk", padding)
        paper = PAPER.get(name, ("", ""))
        print(f"| {name} | {sheets} | {nodes} | {before:.3f} | {paper[0]} | {after:.3f} | {paper[1]} |", flush=True)
        if nodes > 0 or (name in PAPER and (before < paper[0] - 0.005 or after < paper[1] - 0.005)):
            short.append(name)
    if options.check and (short or rows == 0):
        sys.exit(f"short of the paper: {', '.join(short) or 'no such row'}")


if __name__ == "__main__":
    main()
