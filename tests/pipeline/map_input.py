#!/usr/bin/python3
"""map_input.py PROGRAM SCRATCH RANKS: a seamless map in a .hexex file enters the line at stage quantize.

Boxes and a prism with known numbers of hexes, numbers and rationals, charts turned and shifted; the options of the
quantizer; what is written; maps that are none are refused with the place named.
"""

import json
import math
import shutil
import sys
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import program
from box_mesh import box

PROGRAM, SCRATCH, RANKS = Path(sys.argv[1]), Path(sys.argv[2]).resolve(), int(sys.argv[3])


def hexex(points, tets, charts, walls=None, features=None):
    """Text of a .hexex file; charts: per tet four parameter triples of fractions."""
    def number(x):
        x = Fraction(x)
        return str(x.numerator) if x.denominator == 1 else f"{x.numerator}/{x.denominator}"
    lines = [str(len(points)), *(" ".join(repr(float(c)) for c in p) for p in points), str(len(tets))]
    for tet, corners in zip(tets, charts):
        lines.append(" ".join([*map(str, tet), *(number(c) for corner in corners for c in corner)]))
    if walls is not None:
        lines += [str(len(walls)), *(" ".join(map(str, w)) for w in walls)]
    if features is not None:
        lines.append(" ".join(str(len(f)) for f in features))
        lines += [" ".join(map(str, item)) for part in features for item in part]
    return "\n".join(lines) + "\n"


def box_map(size, scale, turned=True):
    """Points, tets, charts of a box mapped by a factor per axis; some tets in charts of their own."""
    mesh = box(*size, tags=False)
    points = [tuple(Fraction(c) for c in p) for p in mesh.points]
    tets = [v for _, v, _ in mesh.of_type(10)]
    charts = []
    for t, tet in enumerate(tets):
        corners = [tuple(c * s for c, s in zip(points[v], scale)) for v in tet]
        if turned and t % 3 == 1:  # a quarter-turn about w, and a shift
            corners = [(-q + t, p - 2, r + Fraction(1, 3)) for p, q, r in corners]
        charts.append(corners)
    return points, tets, charts


def prism_map(lengths, height):
    """Prism over a polygon with a singular line along its axis; lengths[i]: steps from the axis to the middle of side i."""
    n, cell = len(lengths), box(1, 1, 1, tags=False)
    points, index, tets, charts = [], {}, [], []

    def direction(s):
        return math.cos(2 * math.pi * (s % n) / n), math.sin(2 * math.pi * (s % n) / n)

    def vertex(s, corner):
        u, v, w = corner
        key = ("axis", w) if u == v == 0 else (s % n if v == 0 else (s + 1) % n, w) if u == 0 or v == 0 else ("corner", s, w)
        if key not in index:
            index[key] = len(points)
            (ax, ay), (bx, by) = direction(s), direction(s + 1)
            points.append((u * ax + v * bx, u * ay + v * by, w))
        return index[key]

    for s in range(n):
        scale = (lengths[s], lengths[(s + 1) % n], height)
        for _, tet, _ in cell.of_type(10):
            corners = [tuple(int(c) for c in cell.points[v]) for v in tet]
            tets.append(tuple(vertex(s, c) for c in corners))
            charts.append([tuple(Fraction(c * f) for c, f in zip(corner, scale)) for corner in corners])
    return points, tets, charts


def run_map(name, text, *options, ranks=None):
    file = SCRATCH / f"{name}.hexex"
    file.write_text(text)
    out = SCRATCH / name
    done = program.run(PROGRAM, ranks or RANKS, ["run", file, "--from", "quantize", "-o", out, "--check", *options],
                       timeout=200)
    report = json.loads((out / "report.json").read_text()) if (out / "report.json").exists() else {}
    return done, report, out


def check(name, holds, what):
    return [] if holds else [f"{name}: {what}"]


def boxes():
    """1.9 x 3.2 x 0.4 per hex wanted once, so l = (2, 3, 1): the least sum of squares with every arc at least 1."""
    size, scale = (2, 2, 1), (Fraction(19, 20), Fraction(8, 5), Fraction(2, 5))
    wanted = float(Fraction(19, 10) * Fraction(16, 5) * Fraction(2, 5))
    for quantizer in ("pump", "ilp"):
        name = f"box_{quantizer}"
        done, report, out = run_map(name, hexex(*box_map(size, scale), walls=[]), "--target-hexes", str(wanted),
                                    "--quantizer", quantizer)
        yield from check(name, done.code == 0, f"exit code {done.code}: {done.err[-1500:]}")
        if done.code != 0:
            continue
        q = report["quantization"]
        yield from check(name, q["kind"] == quantizer and q["hexes"] == 6 and report["hex"]["count"] == 6, q)
        objective = 4 * (0.1 ** 2 + 0.2 ** 2 + 0.6 ** 2)
        yield from check(name, abs(q["objective"] - objective) < 1e-9, f"objective {q['objective']}, not {objective}")
        yield from check(name, (q["nodes"], q["arcs"], q["patches"], q["blocks"], q["euler"]) == (8, 12, 6, 1, 1), q)
        yield from check(name, quantizer == "ilp" or q["sheets"] >= 1, q)
        yield from check(name, set(q["seconds"]) == {"exact", "complex", "integers"}, q["seconds"])
        for written in ("hex.vtk", "blocks.vtk", "tets.vtk", "singularities.vtk", "run.h5"):
            yield from check(name, (out / written).exists(), f"no {written}")
        against = program.run(PROGRAM, 1, ["check", out / "hex.vtk", "--against", out / "tets.vtk"])
        yield from check(name, against.code == 0, f"check --against: {against.out[-1500:]}")
        yield from check(name, program.run(PROGRAM, 1, ["check", out / "run.h5"]).code == 0, "check run.h5")
        again = program.run(PROGRAM, RANKS, ["run", SCRATCH / f"{name}.hexex", "--from", "quantize", "-o", out,
                                             "--target-hexes", str(wanted), "--quantizer", quantizer, "--resume"])
        stages = json.loads((out / "report.json").read_text())["stages"]
        yield from check(name, again.code == 0 and len(stages) == 5 and all(s["restored"] for s in stages), stages)
        later = json.loads((out / "report.json").read_text())["quantization"]
        yield from check(name, later == q, f"restored: {later}")


def prisms():
    """Known complexes and numbers of hexes; the same integers and blocks for any ranks, the same bytes for any threads."""
    for lengths, counts in (((3, 4, 5), (14, 25, 15, 3, 1)), ((3, 4, 5, 2, 6), (22, 41, 25, 5, 1))):
        height, n = 2, len(lengths)
        hexes = height * sum(lengths[i] * lengths[(i + 1) % n] for i in range(n))
        name = f"prism_{n}"
        text = hexex(*prism_map(lengths, height))
        done, report, out = run_map(name, text, "--target-hexes", str(hexes))
        yield from check(name, done.code == 0, f"exit code {done.code}: {done.err[-1500:]}")
        if done.code != 0:
            continue
        q = report["quantization"]
        yield from check(name, (q["nodes"], q["arcs"], q["patches"], q["blocks"], q["euler"]) == counts, q)
        yield from check(name, q["hexes"] == hexes == report["hex"]["count"] and q["objective"] < 1e-20, q)
        for ranks, threads in ((1, 1), (1, 2)):
            _, _, other = run_map(f"{name}_{ranks}_{threads}", text, "--target-hexes", str(hexes), "--threads", str(threads),
                                  ranks=ranks)
            same = (out / "blocks.vtk").read_bytes() == (other / "blocks.vtk").read_bytes()
            yield from check(name, same, f"other blocks or integers on {RANKS} ranks than on {ranks}, {threads} threads")
            same = (out / "hex.vtk").read_bytes() == (other / "hex.vtk").read_bytes()
            yield from check(name, same or RANKS > 1, f"other hexes with {threads} threads")


def layers():
    done, report, _ = run_map("layers", hexex(*box_map((1, 1, 1), (1, 1, 1))), "--target-hexes", "1", "--min-layers", "3")
    yield from check("layers", done.code == 0 and report["hex"]["count"] == 27, f"{done.code} {report.get('hex')}")


def maps_for_others():
    text = hexex(*box_map((1, 1, 1), (2, 4, 2)))
    for stage, file in (("quantize", "seamless.hexex"), ("igm", "igm.hexex")):
        done, report, out = run_map(f"to_{stage}", text, "--target-hexes", "32", "--to", stage)
        yield from check(stage, done.code == 0 and (out / file).exists(), f"exit code {done.code}, no {file}")
        if done.code != 0:
            continue
        # What is written enters again and gives the same integers; an integer-grid map is its own quantization.
        hexes = report["quantization"]["hexes"]
        wanted = hexes if stage == "igm" else 32
        again = program.run(PROGRAM, RANKS, ["run", out / file, "-o", SCRATCH / f"again_{stage}", "--target-hexes", str(wanted)])
        q = json.loads((SCRATCH / f"again_{stage}" / "report.json").read_text())["quantization"]
        yield from check(stage, again.code == 0 and q["hexes"] == hexes, q)
        yield from check(stage, stage == "quantize" or q["objective"] < 1e-20, q)
    numbers = (SCRATCH / "to_igm" / "igm.hexex").read_text().split("\n")
    corners = [float(x) for line in numbers[10:10 + 6] for x in line.split()[4:]]
    yield from check("igm", len(corners) == 72 and all(x == round(x) for x in corners), "corners of the box off the lattice")


def stops():
    text = hexex(*prism_map((3, 4, 5), 2))
    done, report, out = run_map("stops", text, "--target-hexes", "94", "--to", "igm", "--time-limit", "0.000001")
    yield from check("stops", done.code == 9 and not (out / "igm.hexex").exists(), f"exit code {done.code}")
    line = ["run", SCRATCH / "stops.hexex", "--from", "quantize", "-o", out, "--target-hexes", "94", "--to", "igm", "--resume"]
    done = program.run(PROGRAM, RANKS, line)
    stages = [(s["name"], s["restored"]) for s in json.loads((out / "report.json").read_text())["stages"]]
    yield from check("stops", done.code == 0 and stages == [("map", True), ("quantize", False), ("igm", False)], stages)
    yield from check("stops", (out / "igm.hexex").exists(), "no map after --resume")


def refusals():
    good = box_map((2, 2, 2), (1, 1, 1), turned=False)

    def spoilt(name, change, code, words):
        points, tets, charts = (list(part) for part in good)
        charts = [list(c) for c in charts]
        change(points, tets, charts)
        done, report, out = run_map(name, hexex(points, tets, charts))
        yield from check(name, done.code == code, f"exit code {done.code}, not {code}: {done.err[-1500:]}")
        verdict = report.get("verdict", {"text": done.err})
        for word in words:
            yield from check(name, word in verdict["text"], f"'{word}' is not in {verdict['text']}")
        yield from check(name, code == 3 or not (out / "hex.vtk").exists(), "hexes")
        yield from check(name, code == 3 or (out / "why.vtk").exists(), "no why.vtk")

    def invert(points, tets, charts):
        centre = next(v for v, p in enumerate(points) if p == (1, 1, 1))
        t = next(t for t, tet in enumerate(tets) if centre in tet)
        for s, tet in enumerate(tets):
            for k, v in enumerate(tet):
                if v == centre:
                    charts[s][k] = (Fraction(29, 10), Fraction(1), Fraction(1))
        assert t >= 0

    def tear(points, tets, charts):
        k = tets[5].index(max(tets[5]))
        charts[5][k] = tuple(c + Fraction(1, 50) for c in charts[5][k])

    yield from spoilt("inverted", invert, 5, ["inverted", "("])
    yield from spoilt("torn", tear, 6, ["transition"])
    yield from spoilt("flat", lambda points, tets, charts: points.__setitem__(0, points[1]), 3, [])


def usage():
    text = hexex(*box_map((1, 1, 1), (1, 1, 1)))
    file = SCRATCH / "usage.hexex"
    file.write_text(text)
    out = SCRATCH / "usage"
    config = SCRATCH / "quantizer.toml"
    config.write_text('quantizer = "best"\n')
    for name, options, code, words in (
        ("from_field", ["--from", "field"], 2, ["seamless map", "quantize"]),
        ("to_repair", ["--to", "repair"], 2, ["seamless map", "quantize"]),
        ("no_such", ["--quantizer", "best"], 2, ["pump or ilp or rounding"]),
        ("no_layers", ["--min-layers", "0"], 2, ["at least", "from 1"]),
        ("config", ["--config", config], 3, ["pump or ilp or rounding", "line 1"]),
    ):
        done = program.run(PROGRAM, RANKS, ["run", file, "-o", out, *options])
        yield from check(name, done.code == code, f"exit code {done.code}, not {code}")
        yield from check(name, any(w in done.err for w in words), done.err)
        yield from check(name, not out.exists(), "something was written")
    config.write_text('quantizer = "ilp"\ntarget_hexes = 8\n')
    done = program.run(PROGRAM, RANKS, ["run", file, "-o", out, "--config", config])
    q = json.loads((out / "report.json").read_text())["quantization"]
    yield from check("config", done.code == 0 and q["kind"] == "ilp" and q["hexes"] == 8, q)


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    wrong = [str(w) for group in (boxes(), prisms(), layers(), maps_for_others(), stops(), refusals(), usage()) for w in group]
    print("\n".join(wrong))
    print(f"{len(wrong)} wrong on {RANKS} ranks")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
