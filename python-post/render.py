#!/usr/bin/python3
"""Picture of a hex mesh, cut open, with its singular edges.

    render.py HEX.vtk [--singularities SINGULARITIES.vtk] [--output hex.png] [--cut x=0.5] [--view 30,-60]

Draws the boundary quads by depth, without a display or a graphics card. --cut removes the hexes whose centre lies
beyond that fraction of the bounding box on an axis and shows the inside in the colours of its scaled Jacobians.
Singular edges: red for code -1 (a hex too few around: three, or one at a convex edge of the boundary), blue for +1
(five, or three at a concave edge), violet for the rest; thick inside, thin on the boundary.
"""

import argparse
import re

import numpy as np

from hexfield_post import boundary_quads, new_figure, read_mesh, scaled_jacobians

LIGHT = np.array([0.35, -0.45, 0.82])
OUTSIDE_COLOUR = np.array([0.80, 0.84, 0.88])


def view_matrix(elevation, azimuth):
    """Rows: right, up, towards the viewer; degrees."""
    e, a = np.radians([elevation, azimuth])
    right = np.array([-np.sin(a), np.cos(a), 0])
    towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    return np.array([right, np.cross(towards, right), towards])


def keep_by_cut(points, hexes, cut):
    """Mask of the hexes before the cut 'axis=fraction' (all when there is none)."""
    if not cut:
        return np.ones(len(hexes), bool)
    match = re.fullmatch(r"([xyz])=([0-9.]+)", cut)
    if not match:
        raise SystemExit(f"--cut wants an axis and a fraction, such as x=0.5, not {cut}")
    axis = "xyz".index(match.group(1))
    low, high = points[:, axis].min(), points[:, axis].max()
    return points[hexes].mean(axis=1)[:, axis] <= low + float(match.group(2)) * (high - low)


def visible_quads(points, hexes, kept, view):
    """(corners (k, 4, 3), RGB (k, 3)) of the faces of the kept hexes that look at the viewer, far ones first."""
    import matplotlib

    everything = {tuple(q) for q in np.sort(boundary_quads(hexes)[0], axis=1).tolist()}
    quads, owner = boundary_quads(hexes[kept])
    corners = points[quads]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    front = normal @ view[2] > 0
    corners, normal, quads, owner = corners[front], normal[front], quads[front], owner[front]
    colour = np.tile(OUTSIDE_COLOUR, (len(quads), 1))
    inside = np.array([tuple(q) not in everything for q in np.sort(quads, axis=1).tolist()], bool)
    quality = scaled_jacobians(points, hexes[kept])[owner[inside]]
    colour[inside] = matplotlib.colormaps["viridis"](np.clip(quality, 0, 1))[:, :3]
    shade = np.where(inside, 1, 0.55 + 0.45 * np.clip(normal @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1))
    order = np.argsort((corners.mean(axis=1) @ view[2]))
    return corners[order], (colour * shade[:, None])[order]


def singular_lines(path):
    """(segments (k, 2, 3), colours, widths) of the file of singular edges; those on the boundary are thin."""
    points, cells, codes = read_mesh(path, "code")
    lines = cells.get("line", np.zeros((0, 2), int))
    on_boundary = read_mesh(path, "boundary")[2].get("line", np.zeros(len(lines), int))
    names = {-1: "#cc3311", 1: "#0077bb"}
    colours = [names.get(int(code), "#aa3377") for code in codes.get("line", np.zeros(len(lines), int))]
    return points[lines], colours, np.where(on_boundary != 0, 1.2, 3.0)


def draw(arguments):
    from matplotlib.collections import LineCollection, PolyCollection

    points, cells, _ = read_mesh(arguments.mesh)
    if "hexahedron" not in cells:
        raise SystemExit(f"{arguments.mesh} holds no hexahedra")
    hexes = cells["hexahedron"]
    view = view_matrix(*map(float, arguments.view.split(",")))
    corners, colours = visible_quads(points, hexes, keep_by_cut(points, hexes, arguments.cut), view)
    figure, axes = new_figure(8, 6)
    width = 0.6 if len(corners) < 5000 else 0.25
    axes.add_collection(PolyCollection(corners @ view[:2].T, facecolors=colours, edgecolors="#333333", linewidths=width))
    if arguments.singularities:
        segments, names, widths = singular_lines(arguments.singularities)
        axes.add_collection(LineCollection(segments @ view[:2].T, colors=names, linewidths=widths))
    flat = points @ view[:2].T
    margin = 0.03 * np.ptp(flat, axis=0).max()
    axes.set_xlim(flat[:, 0].min() - margin, flat[:, 0].max() + margin)
    axes.set_ylim(flat[:, 1].min() - margin, flat[:, 1].max() + margin)
    axes.set_aspect("equal")
    axes.axis("off")
    figure.savefig(arguments.output, dpi=120, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", metavar="HEX.vtk")
    parser.add_argument("--singularities", metavar="VTK", help="singularities.vtk of the same run")
    parser.add_argument("--output", default="hex.png", metavar="PNG")
    parser.add_argument("--cut", help="axis=fraction of the bounding box, such as x=0.5")
    parser.add_argument("--view", default="25,-55", help="elevation and azimuth in degrees (default 25,-55)")
    draw(parser.parse_args())


if __name__ == "__main__":
    main()
