#!/usr/bin/python3
"""meshio, and Gmsh where it is installed, read what the writers write: points, cells, colours, names.

Usage: external_readers_test.py PROGRAM_THAT_WRITES_THE_SAMPLES (exit status 77, skipped, without meshio)."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import meshio
    import numpy as np
except ImportError:
    print("skipped: meshio is not installed")
    raise SystemExit(77)
try:
    import gmsh
except ImportError:
    gmsh = None

TETS = {"vertex": [5, 7], "line": [3, 3, 9], "triangle": [2, 2, 11, 11], "tetra": 6 * [1] + 6 * [4]}
HEXES = {"vertex": [5], "line": [3, 3], "quad": [8, 1], "hexahedron": [2, 6]}
NAMES = {
    "tets": {"long edge": (3, 1), "out": (11, 2), "in & <back>": (2, 2), "steel": (1, 3), "air": (4, 3)},
    "hexes": {"tip": (5, 0), "inlet": (8, 2), "steel": (2, 3)},
}
COLOURS = {".vtk": "CellEntityIds", ".vtu": "CellEntityIds", ".msh": "gmsh:physical", ".mesh": "medit:ref"}


def cells_of(mesh):
    """cell type -> vertices of all blocks of it"""
    found = {}
    for block in mesh.cells:
        found.setdefault(block.type, []).append(block.data)
    return {kind: np.concatenate(parts) for kind, parts in found.items()}


class ExternalReaders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        subprocess.run([PROGRAM, str(cls.folder)], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def volumes(self, mesh):
        p = mesh.points
        cells = cells_of(mesh)
        corners = cells["tetra"] if "tetra" in cells else cells["hexahedron"][:, [0, 1, 3, 4]]
        edges = p[corners[:, 1:]] - p[corners[:, :1]]
        return np.linalg.det(edges)

    def check_file(self, path):
        expected = TETS if path.name.startswith("tets") else HEXES
        mesh = meshio.read(path)
        cells = cells_of(mesh)
        with_points = path.suffix not in (".mesh", ".inp")
        for kind, colours in expected.items():
            if kind == "vertex" and not with_points:
                continue
            self.assertEqual(len(cells[kind]), len(colours), kind)
            if path.suffix in COLOURS:
                got = np.concatenate(
                    [d for b, d in zip(mesh.cells, mesh.cell_data[COLOURS[path.suffix]]) if b.type == kind]
                )
                self.assertEqual(sorted(got.ravel().tolist()), sorted(colours), kind)
        self.assertEqual(len(mesh.points), 12)
        self.assertTrue((self.volumes(mesh) > 0).all())
        if path.suffix in (".msh", ".vtu"):
            names = {name: tuple(np.ravel(value).tolist()) for name, value in mesh.field_data.items()}
            self.assertEqual(names, NAMES[path.name.split("_")[0]])

    def test_meshio_reads_every_file(self):
        for path in sorted(self.folder.iterdir()):
            with self.subTest(path.name):
                self.check_file(path)

    def test_abaqus_sets_have_the_names(self):
        sets = meshio.read(self.folder / "hexes_ascii.inp")
        self.assertEqual(set(sets.cell_sets), {"CURVE3", "SURFACE1", "inlet", "steel", "VOLUME6"})
        self.assertEqual(list(sets.point_sets), ["tip"])
        text = (self.folder / "tets_ascii.inp").read_text()
        self.assertIn("ELSET=in____back_", text)

    @unittest.skipIf(gmsh is None, "gmsh is not installed")
    def test_gmsh_reads_its_own_formats(self):
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        for path in sorted(self.folder.glob("*.msh")):
            with self.subTest(path.name):
                gmsh.clear()
                gmsh.open(str(path))
                sample = path.name.split("_")[0]
                groups = {gmsh.model.getPhysicalName(d, t): (t, d) for d, t in gmsh.model.getPhysicalGroups()}
                groups.pop("", None)
                self.assertEqual(groups, NAMES[sample])
                _, tags, _ = gmsh.model.mesh.getElements(dim=3)
                self.assertEqual(sum(len(t) for t in tags), 12 if sample == "tets" else 2)
                self.assertEqual(len(gmsh.model.mesh.getNodes()[0]), 12)
        gmsh.finalize()


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
