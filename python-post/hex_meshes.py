#!/usr/bin/python3
"""Hex meshes with singular nodes, of other origin than hexfield: swept, mapped and multi-block.

    hex_meshes.py DIRECTORY [NAME...]

Writes NAME.vtk (hexes with features) and NAME.tets.vtk (the same shape and features as tets, to check against) for every
mesh of `meshes()`, and prints their numbers of hexes, singular nodes and singular curves.
"""

import argparse
from collections import defaultdict
from pathlib import Path

import numpy as np

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
SIDES = np.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])
EDGES = np.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])


def welded(points, cells):
    """The vertices at equal places made one."""
    keys, index = np.unique(np.round(points, 9), axis=0, return_inverse=True)
    return keys, index.reshape(-1)[cells]


def voxels(cells):
    """Unit cubes at integer places."""
    points = (np.array(sorted(cells))[:, None, :] + CORNERS[None]).reshape(-1, 3).astype(float)
    return welded(points, np.arange(len(points)).reshape(-1, 8))


def grid(n):
    """n^3 cubes in [-1, 1]^3."""
    points, hexes = voxels({(x, y, z) for x in range(n) for y in range(n) for z in range(n)})
    return points * 2 / n - 1, hexes


def sweep(points, quads, stations):
    """Quads (k, 2) carried along maps from (k, 2) to (k, 3)."""
    layers = [np.asarray(station(points), float) for station in stations]
    count = len(points)
    hexes = [np.concatenate([quads + s * count, quads + (s + 1) * count], axis=1) for s in range(len(layers) - 1)]
    return np.concatenate(layers), np.concatenate(hexes)


def split_triangles(points, triangles):
    """Three quads in each triangle, two dimensions or three."""
    middle = lambda *v: points[list(v)].mean(axis=0)  # noqa: E731
    corners = []
    for a, b, c in triangles:
        for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
            corners += [points[p], middle(p, q), middle(a, b, c), middle(r, p)]
    return welded(np.array(corners), np.arange(len(corners)).reshape(-1, 4))


def split_tets(points, tets):
    """Four hexes in each tet."""
    middle = lambda *v: points[list(v)].mean(axis=0)  # noqa: E731
    corners = []
    for t in tets:
        a, b, c, d = t if np.linalg.det(points[t[1:]] - points[t[0]]) > 0 else (t[0], t[2], t[1], t[3])
        for p, q, r, s in ((a, b, c, d), (b, a, d, c), (c, d, a, b), (d, c, b, a)):
            corners += [points[p], middle(p, q), middle(p, q, r), middle(p, r)]
            corners += [middle(p, s), middle(p, q, s), middle(p, q, r, s), middle(p, r, s)]
    return welded(np.array(corners), np.arange(len(corners)).reshape(-1, 8))


def boundary_quads(hexes):
    """(k, 4), counter-clockwise seen from outside."""
    quads = hexes[:, SIDES].reshape(-1, 4)
    _, index, count = np.unique(np.sort(quads, axis=1), axis=0, return_inverse=True, return_counts=True)
    return quads[count[index.reshape(-1)] == 1]


def padded(points, hexes, depth=0.4):
    """One layer of hexes along the boundary; the surface stays."""
    quads = boundary_quads(hexes)
    skin = np.unique(quads)
    twin = np.full(len(points), -1)
    twin[skin] = len(points) + np.arange(len(skin))
    total, count = np.zeros_like(points), np.zeros(len(points))
    for k in range(8):
        np.add.at(total, hexes[:, k], points[hexes].mean(axis=1))
        np.add.at(count, hexes[:, k], 1)
    inner = points.copy()
    inner[skin] += depth * (total[skin] / count[skin, None] - points[skin])
    return np.concatenate([inner, points[skin]]), np.concatenate([hexes, np.concatenate([quads, twin[quads]], axis=1)])


def refined(points, hexes):
    """Every hex in eight."""
    steps = np.array([(x, y, z) for x in (0, 0.5, 1) for y in (0, 0.5, 1) for z in (0, 0.5, 1)])
    weights = np.prod(np.where(CORNERS[None] == 1, steps[:, None], 1 - steps[:, None]), axis=2)  # (27, 8)
    fine = np.einsum("sk,hkx->hsx", weights, points[hexes])
    local = np.array([[9 * (i + a) + 3 * (j + b) + (k + c) for a, b, c in CORNERS]
                      for i, j, k in CORNERS])
    cells = (27 * np.arange(len(hexes))[:, None, None] + local[None]).reshape(-1, 8)
    return welded(fine.reshape(-1, 3), cells)


def singular_graph(hexes):
    """Numbers of nodes and curves."""
    edges, index, valence = np.unique(np.sort(hexes[:, EDGES].reshape(-1, 2), axis=1), axis=0, return_inverse=True,
                                      return_counts=True)
    quads = boundary_quads(hexes)
    rim = {tuple(sorted((int(q[k]), int(q[(k + 1) % 4])))) for q in quads for k in range(4)}
    skin = set(np.unique(quads).tolist())
    singular = [tuple(map(int, e)) for e, k in zip(edges, valence) if k != 4 and tuple(map(int, e)) not in rim]
    at = defaultdict(list)
    for k, (a, b) in enumerate(singular):
        at[a].append(k)
        at[b].append(k)
    parent = list(range(len(singular)))

    def find(k):
        while parent[k] != k:
            k = parent[k]
        return k

    for v, around in at.items():
        if len(around) == 2 and v not in skin:
            parent[find(around[0])] = find(around[1])
    nodes = sum(len(around) > 2 and v not in skin for v, around in at.items())
    return nodes, len({find(k) for k in range(len(singular))})


class Features:
    """Sharp edges of the boundary as lines, their ends as points, the surfaces between them, each in a colour."""

    def __init__(self, points, hexes, degrees=40):
        self.quads = boundary_quads(hexes)
        x = points[self.quads]
        normal = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        at = defaultdict(list)
        for q, quad in enumerate(self.quads):
            for k in range(4):
                at[tuple(sorted((int(quad[k]), int(quad[(k + 1) % 4]))))].append(q)
        flat = np.cos(np.radians(degrees))
        smooth = {e: qs for e, qs in at.items() if len(qs) == 2 and normal[qs[0]] @ normal[qs[1]] > flat}
        self.lines = np.array(sorted(set(at) - set(smooth)), int).reshape(-1, 2)
        self.quad_colours = self.components(len(self.quads), smooth.values())
        around = defaultdict(list)
        for k, line in enumerate(self.lines):
            for v in line:
                around[int(v)].append(k)
        straight = {}
        for v, lines in around.items():
            if len(lines) != 2:
                continue
            d = [points[self.lines[k].sum() - v] - points[v] for k in lines]
            if -(d[0] @ d[1]) > flat * np.linalg.norm(d[0]) * np.linalg.norm(d[1]):
                straight[v] = lines
        self.line_colours = self.components(len(self.lines), straight.values())
        self.points = np.array(sorted(set(around) - set(straight)), int)

    @staticmethod
    def components(count, pairs):
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import connected_components

        pairs = np.array(list(pairs), int).reshape(-1, 2)
        graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
        return connected_components(graph, directed=False)[1] + 1


def write(path, points, blocks):
    """blocks: [(VTK type, vertices (k, n), colours (k,))]"""
    blocks = [b for b in blocks if len(b[1])]
    count = sum(len(b[1]) for b in blocks)
    with open(path, "w") as out:
        out.write("# vtk DataFile Version 2.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n")
        np.savetxt(out, points, fmt="%.17g")
        out.write(f"CELLS {count} {sum(b[1].size + len(b[1]) for b in blocks)}\n")
        for _, cells, _ in blocks:
            np.savetxt(out, np.column_stack([np.full(len(cells), cells.shape[1]), cells]), fmt="%d")
        out.write(f"CELL_TYPES {count}\n")
        for kind, cells, _ in blocks:
            np.savetxt(out, np.full(len(cells), kind), fmt="%d")
        out.write(f"CELL_DATA {count}\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n")
        for _, _, colours in blocks:
            np.savetxt(out, colours, fmt="%d")


def write_hexes(path, points, hexes, features):
    write(path, points, [(1, features.points[:, None], np.arange(len(features.points)) + 1),
                         (3, features.lines, features.line_colours), (9, features.quads, features.quad_colours),
                         (12, hexes, np.ones(len(hexes), int))])


def triangles_of(quads):
    """Two triangles per quad, cut from its lowest vertex."""
    first = quads.argmin(axis=1)
    q = np.take_along_axis(quads, (first[:, None] + np.arange(4)) % 4, axis=1)
    return np.stack([q[:, [0, 1, 2]], q[:, [0, 2, 3]]], axis=1).reshape(-1, 3)


def write_tets(path, points, hexes, features):
    """Twelve tets around the middle of each hex."""
    middles = len(points) + np.arange(len(hexes))
    triangles = triangles_of(hexes[:, SIDES].reshape(-1, 4))
    # Sides are seen from outside: the middle is behind them.
    tets = np.column_stack([np.repeat(middles, 12), triangles])
    write(path, np.concatenate([points, points[hexes].mean(axis=1)]),
          [(1, features.points[:, None], np.arange(len(features.points)) + 1), (3, features.lines, features.line_colours),
           (5, triangles_of(features.quads), np.repeat(features.quad_colours, 2)), (10, tets, np.ones(len(tets), int))])


def scaled_jacobians(points, hexes):
    """Smallest of each hex."""
    corners = np.array([[0, 1, 3, 4], [1, 2, 0, 5], [2, 3, 1, 6], [3, 0, 2, 7], [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2],
                        [7, 6, 4, 3]])
    x = points[hexes[:, corners]]
    e = x[:, :, 1:] - x[:, :, :1]
    return np.linalg.det(e / np.linalg.norm(e, axis=3, keepdims=True)).min(axis=1)


# ---- the meshes


def swept_gear(teeth=8):
    """A ring with teeth, two hexes high: swept from quads, with twist."""
    cells = []
    step = 2 * np.pi / (3 * teeth)
    for k in range(3 * teeth):
        for r in range(3 if k % 3 == 0 else 2):
            cells.append([(1 + 0.4 * (r + dr), (k + dk) * step) for dr, dk in ((0, 0), (1, 0), (1, 1), (0, 1))])
    flat = np.array([(r * np.cos(a), r * np.sin(a)) for cell in cells for r, a in cell])
    points, quads = welded(flat, np.arange(len(flat)).reshape(-1, 4))

    def station(z, turn):
        turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        return lambda p: np.column_stack([p @ turned.T, np.full(len(p), z)])

    return refined(*padded(*sweep(points, quads, [station(0.5 * s, 0.08 * s) for s in range(4)])))


def swept_triangulation():
    """A triangulated hexagon with valences 3 to 7 inside, along a bent path."""
    ring = [(np.cos(k * np.pi / 3), np.sin(k * np.pi / 3)) for k in range(6)]
    points = np.array([*ring, (0.1, 0.0), (0.5, 0.2), (-0.3, 0.4)])
    from scipy.spatial import Delaunay

    triangles = Delaunay(points).simplices
    area = np.linalg.det(points[triangles][:, 1:] - points[triangles][:, :1])
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    flat, quads = split_triangles(points, triangles)

    def station(angle):
        return lambda p: np.column_stack([(3 + p[:, 0]) * np.cos(angle), (3 + p[:, 0]) * np.sin(angle), p[:, 1]])

    # The path turns against the clock seen from above, so the cross-section is seen from behind.
    points, hexes = sweep(flat, quads, [station(a) for a in -0.2 * np.arange(7)])
    return padded(points, hexes)


def swept_hexagon():
    """A prism with twelve corners, crossed by six curves of valence 3: 12 nodes and 36 curves."""
    points = np.array([(0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1), (0, 2.4), (0, -2.4)], float)
    flat, quads = split_triangles(points, [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (1, 5, 2), (3, 6, 4)])
    stations = [lambda p, z=z: np.column_stack([p, np.full(len(p), z)]) for z in np.arange(3) * 0.8]
    return padded(*sweep(flat, quads, stations))


def blocks_frame():
    """A square frame: 16 nodes and 40 curves."""
    return refined(*padded(*voxels({(x, y, z) for x in range(3) for y in range(3) for z in range(2) if (x, y) != (1, 1)})))


def blocks_u():
    """A prism over the letter U: 16 nodes and 40 curves."""
    return padded(*voxels({(x, y, z) for x in range(6) for y in range(4) for z in range(2) if x not in (2, 3) or y < 2}))


def mapped_ball(n=4):
    """A padded cube on a ball: eight nodes."""
    points, hexes = grid(n)
    size = np.abs(points).max(axis=1, keepdims=True)
    length = np.maximum(np.linalg.norm(points, axis=1, keepdims=True), 1e-12)
    points = points * (1 - size + size * size / length)
    return padded(points, hexes)


def mapped_twisted_bar():
    """A bar of square section with a hole, twisted by half a right angle."""
    points, hexes = voxels({(x, y, z) for x in range(3) for y in range(3) for z in range(6) if (x, y) != (1, 1)})
    x, y, z = (points - [1.5, 1.5, 0]).T
    angle = np.pi / 4 * z / 6
    places = np.column_stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), 2 * z])
    return refined(*padded(places, hexes))


def blocks_sponge():
    """A cube of 3 x 3 x 3 blocks without its middle column in each direction."""
    cells = {(x, y, z) for x in range(3) for y in range(3) for z in range(3) if [x, y, z].count(1) < 2}
    return refined(*padded(*voxels(cells)))


def blocks_lattice(n=3):
    """A scaffold of bars: blocks at all places with at most one odd coordinate."""
    size = range(2 * n - 1)
    cells = {(x, y, z) for x in size for y in size for z in size if sum(c % 2 for c in (x, y, z)) <= 1}
    return refined(*padded(*voxels(cells)))


def blocks_random(count=60, seed=4):
    """Blocks put together at random, without edges or vertices where they only touch, as long as padding is valid."""
    random = np.random.default_rng(seed)
    cells = {(0, 0, 0)}
    while len(cells) < count:
        base = sorted(cells)[random.integers(len(cells))]
        step = [0, 0, 0]
        step[random.integers(3)] = random.choice([-1, 1])
        new = tuple(int(b + s) for b, s in zip(base, step))
        if new not in cells and manifold_with(cells, new):
            if scaled_jacobians(*padded(*voxels(cells | {new}), depth=0.25)).min() > 0.05:
                cells.add(new)
    return refined(*padded(*voxels(cells), depth=0.25))


def manifold_with(cells, new):
    """Whether blocks and air at each corner of the new block hang together through faces."""
    cells = cells | {new}
    for corner in CORNERS:
        around = [tuple(int(v) for v in np.array(new) + corner - c) for c in CORNERS]
        for inside in (True, False):
            todo = [c for c in around if (c in cells) == inside]
            seen, stack = set(todo[:1]), todo[:1]
            while stack:
                c = stack.pop()
                for o in todo:
                    if o not in seen and sum(abs(a - b) for a, b in zip(c, o)) == 1:
                        seen.add(o)
                        stack.append(o)
            if len(seen) != len(todo):
                return False
    return True


def split_lattice(n=2):
    """The tets of a body-centred lattice, each in four hexes: vertices with 14 edges of valences 4 and 6."""
    points, tets = [], []
    index = {}

    def vertex(*p):
        if p not in index:
            index[p] = len(points)
            points.append(p)
        return index[p]

    for x in range(n):
        for y in range(n):
            for z in range(n):
                for axis in range(3):
                    if (x, y, z)[axis] + 1 >= n:
                        continue
                    a = np.array((2 * x + 1, 2 * y + 1, 2 * z + 1))
                    step = 2 * np.eye(3, dtype=int)[axis]
                    u, v = np.delete(np.eye(3, dtype=int), axis, axis=0)
                    middle = a + step // 2
                    ring = [middle + s * u + t * v for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
                    for k in range(4):
                        tets.append([vertex(*map(int, p)) for p in (a, a + step, ring[k], ring[(k + 1) % 4])])
    return split_tets(np.array(points, float), np.array(tets))


def meshes():
    builders = (swept_gear, swept_triangulation, swept_hexagon, mapped_ball, mapped_twisted_bar, blocks_frame, blocks_u,
                blocks_sponge, blocks_lattice, blocks_random, split_lattice)
    return {build.__name__: build for build in builders}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    options.directory.mkdir(parents=True, exist_ok=True)
    for name, build in meshes().items():
        if options.names and name not in options.names:
            continue
        points, hexes = build()
        features = Features(points, hexes)
        write_hexes(options.directory / f"{name}.vtk", points, hexes, features)
        write_tets(options.directory / f"{name}.tets.vtk", points, hexes, features)
        nodes, curves = singular_graph(hexes)
        print(f"{name}: {len(hexes)} hexes, {nodes} nodes, {curves} curves, smallest scaled Jacobian "
              f"{scaled_jacobians(points, hexes).min():.3f}")


if __name__ == "__main__":
    main()
