#!/usr/bin/python3
"""Histogram of the scaled Jacobians of a hex mesh.

    quality_histogram.py HEX.vtk [--output histogram.png]

The value of a hex is the smallest of the scaled Jacobians at its 8 corners: 1 for a box, 0 or less for a hex that
is flat or inverted at a corner. Prints count, minimum, mean, percentiles and how many hexes are not positive.
"""

import argparse

import numpy as np

from hexfield_post import new_figure, read_mesh, scaled_jacobians


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", metavar="HEX.vtk")
    parser.add_argument("--output", default="histogram.png", metavar="PNG")
    arguments = parser.parse_args()

    points, cells, _ = read_mesh(arguments.mesh)
    if "hexahedron" not in cells:
        raise SystemExit(f"{arguments.mesh} holds no hexahedra")
    values = scaled_jacobians(points, cells["hexahedron"])
    low, median, high = np.percentile(values, [5, 50, 95])
    print(f"hexes {len(values)}, minimum {values.min():.4f}, mean {values.mean():.4f}, not positive {(values <= 0).sum()}")
    print(f"percentiles 5/50/95: {low:.4f} {median:.4f} {high:.4f}")

    figure, axes = new_figure(6, 3.5)
    axes.hist(values, bins=np.linspace(min(0.0, values.min()), 1, 51), color="#4477aa")
    axes.axvline(values.min(), color="#cc3311", linewidth=1, label=f"minimum {values.min():.3f}")
    axes.set_xlabel("scaled Jacobian (smallest of 8 corners)")
    axes.set_ylabel("hexes")
    axes.legend()
    figure.savefig(arguments.output, dpi=120, bbox_inches="tight")


if __name__ == "__main__":
    main()
