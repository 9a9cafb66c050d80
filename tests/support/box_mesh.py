"""Small tagged tet meshes for tests at program level, as lists that a test can spoil before it writes them."""

import itertools


class TetFile:
    """Points, cells (VTK type, vertices, colour) of a legacy VTK file."""

    def __init__(self, points, cells):
        self.points = points
        self.cells = cells

    def of_type(self, vtk_type):
        return [c for c in self.cells if c[0] == vtk_type]

    def text(self):
        size = sum(len(v) + 1 for _, v, _ in self.cells)
        lines = ["# vtk DataFile Version 2.0", "test mesh", "ASCII", "DATASET UNSTRUCTURED_GRID"]
        lines += [f"POINTS {len(self.points)} double"]
        lines += [" ".join(p if isinstance(p, str) else repr(float(p)) for p in point) for point in self.points]
        lines += [f"CELLS {len(self.cells)} {size}"]
        lines += [" ".join(map(str, [len(v), *v])) for _, v, _ in self.cells]
        lines += [f"CELL_TYPES {len(self.cells)}", *(str(t) for t, _, _ in self.cells)]
        lines += [f"CELL_DATA {len(self.cells)}", "SCALARS CellEntityIds int 1", "LOOKUP_TABLE default"]
        lines += [str(colour) for _, _, colour in self.cells]
        return "\n".join(lines) + "\n"

    def write(self, file):
        file.write_text(self.text())
        return file


def box(nx, ny, nz, tags=True, origin=(0.0, 0.0, 0.0), edge=1.0):
    """Box of unit cells, six tets each; its corners, edges and sides are tagged with a colour of their own."""
    size = (nx, ny, nz)

    def index(i, j, k):
        return (k * (ny + 1) + j) * (nx + 1) + i

    grid = [(i, j, k) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    orders = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]
    tets = []
    for k, j, i in itertools.product(range(nz), range(ny), range(nx)):
        for p, order in enumerate(orders):
            corner = [i, j, k]
            tet = [index(*corner)]
            for axis in order:
                corner[axis] += 1
                tet.append(index(*corner))
            if p >= 3:
                tet[2], tet[3] = tet[3], tet[2]
            tets.append(tuple(tet))

    def sides(v):
        return {(d, 0) for d in range(3) if grid[v][d] == 0} | {(d, 1) for d in range(3) if grid[v][d] == size[d]}

    triangles = {}
    lines = {}
    for tet in tets:
        for face in itertools.combinations(sorted(tet), 3):
            common = sides(face[0]) & sides(face[1]) & sides(face[2])
            if common:
                side = min(common)
                triangles[face] = 1 + 2 * side[0] + side[1]
    curves = {}
    for face in triangles:
        for line in itertools.combinations(face, 2):
            common = tuple(sorted(sides(line[0]) & sides(line[1])))
            if len(common) == 2:
                lines[line] = curves.setdefault(common, 10 + len(curves))
    corners = [v for v in range(len(grid)) if len(sides(v)) == 3]
    cells = [(1, (v,), 30 + n) for n, v in enumerate(corners)] if tags else []
    cells += [(3, line, colour) for line, colour in lines.items()] if tags else []
    cells += [(5, face, colour) for face, colour in triangles.items()] if tags else []
    cells += [(10, tet, 1) for tet in tets]
    points = [tuple(origin[d] + edge * p[d] for d in range(3)) for p in grid]
    return TetFile(points, cells)


def joined(*meshes):
    """Several meshes in one file, as components of their own."""
    points, cells = [], []
    for mesh in meshes:
        shift = len(points)
        points += mesh.points
        cells += [(t, tuple(v + shift for v in vertices), colour) for t, vertices, colour in mesh.cells]
    cells.sort(key=lambda cell: cell[0])
    return TetFile(points, cells)
