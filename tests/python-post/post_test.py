#!/usr/bin/python3
"""The scripts of python-post on small made-up runs: what they print, and that the pictures are pictures."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

POST = Path(__file__).resolve().parents[2] / "python-post"
sys.path.insert(0, str(POST))
sys.dont_write_bytecode = True

import numpy as np  # noqa: E402
from hexfield_post import boundary_quads, read_mesh, scaled_jacobians  # noqa: E402

UNIT_CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)


def grid(n):
    """points and hexes of n x n x n cells."""
    number = lambda i, j, k: (k * (n + 1) + j) * (n + 1) + i
    points = np.array([[i, j, k] for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)], float)
    offsets = UNIT_CUBE.astype(int)
    hexes = [
        [number(i + a, j + b, k + c) for a, b, c in offsets] for k in range(n) for j in range(n) for i in range(n)
    ]
    return points, np.array(hexes)


def write_vtk(path, points, cells, array="CellEntityIds"):
    """Legacy VTK 2.0 in the layout of the program; cells: list of (type, nodes, colour)."""
    lines = ["# vtk DataFile Version 2.0", "made by a test", "ASCII", "DATASET UNSTRUCTURED_GRID"]
    lines += [f"POINTS {len(points)} double"] + [" ".join(map(str, p)) for p in points]
    lines += [f"CELLS {len(cells)} {sum(len(nodes) + 1 for _, nodes, _ in cells)}"]
    lines += [" ".join(map(str, [len(nodes), *nodes])) for _, nodes, _ in cells]
    lines += [f"CELL_TYPES {len(cells)}"] + [str(kind) for kind, _, _ in cells]
    lines += [f"CELL_DATA {len(cells)}", f"SCALARS {array} int 1", "LOOKUP_TABLE default"]
    lines += [str(colour) for _, _, colour in cells]
    path.write_text("\n".join(lines) + "\n")


def report(ranks, seconds):
    stages = [{"name": "field", "seconds": seconds, "peak_rss_mb": 120, "iterations": 7}]
    stages += [{"name": "seamless", "seconds": 2 * seconds, "peak_rss_mb": 240, "iterations": 9}]
    return {"input": {"tets": 1000}, "ranks": ranks, "threads": 1, "stages": stages, "hex": {"count": 512}}


class Post(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name) / "with a space"
        self.path.mkdir()

    def tearDown(self):
        self.folder.cleanup()

    def run_script(self, name, *arguments):
        command = [sys.executable, str(POST / name), *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def assert_picture(self, path, min_colours):
        import matplotlib.image

        pixels = (matplotlib.image.imread(path)[:, :, :3] * 255).astype(int).reshape(-1, 3)
        self.assertGreater(len(np.unique(pixels, axis=0)), min_colours)

    def write_grid(self, n=3):
        points, hexes = grid(n)
        cells = [(1, [0], 1), (3, [0, 1], 2)] + [(9, q, 3) for q in boundary_quads(hexes)[0]]
        write_vtk(self.path / "hex.vtk", points, cells + [(12, h, 1) for h in hexes])
        write_vtk(self.path / "singularities.vtk", points, [(3, [0, len(points) - 1], -1), (3, [1, 2], 1)], "code")

    def test_scaled_jacobians_of_a_cube_a_shear_and_an_inverted_hex(self):
        hexes = np.arange(8)[None, :]
        self.assertAlmostEqual(scaled_jacobians(UNIT_CUBE, hexes)[0], 1)
        shear = UNIT_CUBE + UNIT_CUBE[:, [1]] * [1, 0, 0]
        self.assertAlmostEqual(scaled_jacobians(shear, hexes)[0], np.sqrt(0.5))
        self.assertAlmostEqual(scaled_jacobians(UNIT_CUBE * [1, 1, -1], hexes)[0], -1)

    def test_boundary_quads_of_a_grid_look_outwards(self):
        points, hexes = grid(2)
        quads, owner = boundary_quads(hexes)
        self.assertEqual(len(quads), 24)
        corners = points[quads]
        normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        outwards = corners.mean(axis=1) - points[hexes[owner]].mean(axis=1)
        self.assertTrue((np.einsum("ij,ij->i", normal, outwards) > 0).all())

    def test_cell_arrays_are_read_by_name(self):
        self.write_grid()
        points, cells, codes = read_mesh(self.path / "singularities.vtk", "code")
        self.assertEqual(codes["line"].tolist(), [-1, 1])
        self.assertEqual(read_mesh(self.path / "singularities.vtk", "boundary")[2], {})
        _, cells, colours = read_mesh(self.path / "hex.vtk")
        self.assertEqual([colours[kind][0] for kind in ("vertex", "line", "quad", "hexahedron")], [1, 2, 3, 1])

    def test_timing_table(self):
        for ranks in (1, 2):
            folder = self.path / f"np{ranks}"
            folder.mkdir()
            (folder / "report.json").write_text(json.dumps(report(ranks, 4.0 / ranks)))
        out = self.run_script("timing_table.py", "np1", "np2/report.json", "--plot", "scaling.png")
        self.assertIn("| seamless | 8.00 s, 240 MB | 4.00 s, 240 MB |", out)
        self.assertIn("| all | 12.00 s | 6.00 s |", out)
        self.assert_picture(self.path / "scaling.png", 10)

    def test_quality_histogram(self):
        self.write_grid()
        out = self.run_script("quality_histogram.py", "hex.vtk", "--output", "histogram.png")
        self.assertIn("hexes 27, minimum 1.0000, mean 1.0000, not positive 0", out)
        self.assert_picture(self.path / "histogram.png", 3)

    def test_render(self):
        self.write_grid()
        self.run_script("render.py", "hex.vtk", "--singularities", "singularities.vtk", "--cut", "x=0.5")
        self.assert_picture(self.path / "hex.png", 20)

    def test_models_table(self):
        head = "model,rc,judge,seconds,hexes,sj_min,sj_mean,peak_mb,text\n"
        (self.path / "a.csv").write_text(head + "cube,0,VALID,3.14,512,0.98765,0.999,80.2,complete\nblob,5,,9,,,,90,no map\n")
        (self.path / "b.csv").write_text(head + "blob,4,,8,,,,90,edge | 7\n")
        out = self.run_script("models_table.py", "a.csv", "b.csv")
        self.assertIn("| cube | 0 | VALID | 512 | 0.988 | 0.999 | 3.1 | 80 | complete |", out)
        self.assertIn("| blob | 4 |", out)
        self.assertIn("edge / 7", out)
        self.assertIn("2 models, 1 valid; exit codes 0: 1, 4: 1", out)


if __name__ == "__main__":
    unittest.main()
