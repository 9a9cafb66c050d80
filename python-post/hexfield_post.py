"""What the scripts of this folder share: meshes, corner scaled Jacobians, boundary faces, reports."""

import json
from pathlib import Path

import numpy as np

# Corner c of a hex (VTK order) and its three neighbours, so ordered that a unit cube has determinant +1.
HEX_CORNERS = np.array(
    [[0, 1, 3, 4], [1, 2, 0, 5], [2, 3, 1, 6], [3, 0, 2, 7], [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2], [7, 6, 4, 3]]
)
# Faces of a hex, counter-clockwise seen from outside.
HEX_FACES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])


def read_mesh(path, array=None):
    """points (n, 3), {cell type: (k, nodes)}, {cell type: (k,) numbers} of a mesh file.

    Cell types by meshio's names: vertex, line, triangle, quad, tetra, hexahedron. The numbers are those of the cell
    array of that name (default: the first of the file, the colours); empty when there is none.
    """
    import meshio

    mesh = meshio.read(path)
    names = [name for name in mesh.cell_data if array in (None, name)]
    cells, numbers = {}, {}
    for index, block in enumerate(mesh.cells):
        cells.setdefault(block.type, []).append(block.data)
        if names:
            values = np.asarray(mesh.cell_data[names[0]][index]).reshape(len(block.data), -1)
            numbers.setdefault(block.type, []).append(values[:, 0])
    return (
        np.asarray(mesh.points, float),
        {kind: np.concatenate(blocks) for kind, blocks in cells.items()},
        {kind: np.concatenate(blocks) for kind, blocks in numbers.items()},
    )


def scaled_jacobians(points, hexes):
    """Smallest of the 8 corner scaled Jacobians of each hex, in [-1, 1]."""
    corners = points[hexes[:, HEX_CORNERS]]
    edges = corners[:, :, 1:] - corners[:, :, :1]
    edges /= np.maximum(np.linalg.norm(edges, axis=3, keepdims=True), 1e-300)
    return np.linalg.det(edges).min(axis=1)


def boundary_quads(hexes):
    """(quads, owner): faces that belong to one hex only, and the row of that hex."""
    faces = hexes[:, HEX_FACES].reshape(-1, 4)
    _, inverse, count = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)
    single = count[inverse.reshape(-1)] == 1
    return faces[single], np.repeat(np.arange(len(hexes)), 6)[single]


def read_report(path):
    """The report of a run; `path` is report.json or the output directory that holds it."""
    path = Path(path)
    return json.loads((path / "report.json" if path.is_dir() else path).read_text())


def new_figure(width, height):
    """A matplotlib figure and axes that need no display."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=(width, height))
