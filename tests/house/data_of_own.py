#!/usr/bin/python3
"""Every bundled mesh has its geometry beside it, and that file names the command that made it."""

from sources import ROOT, finish


def violations():
    data = ROOT / "tests" / "data"
    for mesh in sorted(data.glob("*.msh")) + sorted(data.glob("*.vtk")):
        geometry = mesh.with_suffix(".geo")
        if not geometry.is_file():
            yield f"{mesh.name}: no {geometry.name} beside it"
        elif f"-o {mesh.name}" not in geometry.read_text():
            yield f"{geometry.name}: does not name the command that makes {mesh.name}"


if __name__ == "__main__":
    finish(list(violations()), "bundled meshes stand beside their geometry")
