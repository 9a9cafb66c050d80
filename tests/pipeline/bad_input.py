#!/usr/bin/python3
"""bad_input.py PROGRAM SCRATCH RANKS: every kind of bad input ends with its exit code and one sentence.

Each case spoils a small good mesh, command line, configuration or checkpoint, and names the exit code and words of the
sentence. After it no result may lie in the output directory, and one that was there before must be as it was.
"""

import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import program
from box_mesh import TetFile, box

PROGRAM, SCRATCH, RANKS = Path(sys.argv[1]), Path(sys.argv[2]).resolve(), int(sys.argv[3])


def spoiled(change):
    mesh = box(2, 2, 1)
    change(mesh)
    return mesh.text().encode()


def with_tets(change):
    def change_mesh(mesh):
        others = [c for c in mesh.cells if c[0] != 10]
        mesh.cells = others + change([c for c in mesh.cells if c[0] == 10])
    return spoiled(change_mesh)


def set_point(v, point):
    return spoiled(lambda mesh: mesh.points.__setitem__(v, point))


def extra_cell(cell):
    def change(mesh):
        mesh.cells = sorted(mesh.cells + [cell], key=lambda c: c[0])
    return spoiled(change)


def hanging():
    """A second box beside the first whose vertices lie inside the edges and faces of the first."""
    coarse, fine = box(1, 1, 1, tags=False), box(2, 2, 2, tags=False, origin=(1.0, 0.0, 0.0), edge=0.5)
    points = coarse.points + fine.points
    shift = len(coarse.points)
    same = {p: v for v, p in enumerate(coarse.points)}
    index = {shift + v: same.get(p, shift + v) for v, p in enumerate(fine.points)}
    cells = coarse.cells + [(t, tuple(index[shift + v] for v in vs), colour) for t, vs, colour in fine.cells]
    return TetFile(points, cells).text().encode()


def touching():
    """Two boxes that share one edge only."""
    first, second = box(1, 1, 1, tags=False), box(1, 1, 1, tags=False, origin=(1.0, 1.0, 0.0))
    same = {p: v for v, p in enumerate(first.points)}
    points, index = list(first.points), []
    for p in second.points:
        index.append(same.get(p, len(points)))
        if p not in same:
            points.append(p)
    cells = first.cells + [(t, tuple(index[v] for v in vs), colour) for t, vs, colour in second.cells]
    return TetFile(points, cells).text().encode()


GOOD = box(2, 2, 1).text().encode()
FLAT = (0.0, 0.0, 0.0)
MESHES = [  # name, bytes of the file (None: there is no file), words of the sentence
    ("missing", None, []),
    ("empty", b"", []),
    ("garbage", bytes((37 * i * i + 11 * i) % 256 for i in range(5000)), []),
    ("half", GOOD[: len(GOOD) // 2], []),
    ("cut_in_points", GOOD[:200], []),
    ("only_header", GOOD[:100], []),
    ("too_many_points", GOOD.replace(b"POINTS 18", b"POINTS 19"), []),
    ("too_few_points", GOOD.replace(b"POINTS 18", b"POINTS 17"), []),
    ("huge_count", GOOD.replace(b"POINTS 18", b"POINTS 99999999999999999999"), []),
    ("negative_count", GOOD.replace(b"POINTS 18", b"POINTS -18"), []),
    ("nan", set_point(4, ("nan", "0", "0")), ["4"]),
    ("infinite", set_point(4, ("inf", "0", "0")), ["4"]),
    ("huge_coordinate", set_point(4, (1e200, 0, 0)), ["4"]),
    ("id_too_large", with_tets(lambda tets: tets[:-1] + [(10, (0, 1, 3, 77), 1)]), ["83"]),
    ("id_negative", with_tets(lambda tets: tets[:-1] + [(10, (0, 1, 3, -1), 1)]), ["83"]),
    ("inverted", with_tets(lambda tets: [(10, tets[0][1][1::-1] + tets[0][1][2:], 1)] + tets[1:]), ["("]),
    ("vertex_twice", with_tets(lambda tets: [(10, (0, 1, 1, 9), 1)] + tets[1:]), []),
    ("flat", set_point(0, (1.0, 1.0, 0.0)), ["("]),
    ("doubled", with_tets(lambda tets: tets + [tets[3]]), ["("]),
    ("face_in_three", spoiled(lambda mesh: (mesh.points.append((0.2, 0.5, 3.0)), mesh.cells.append(
        (10, (0, 1, 4, 18), 1)))), []),
    ("hanging", hanging(), []),
    ("touching_in_an_edge", touching(), ["("]),
    ("line_off", extra_cell((3, (0, 17), 9)), ["("]),
    ("triangle_off", extra_cell((5, (0, 2, 17), 9)), ["("]),
    ("no_tets", with_tets(lambda tets: []), []),
    ("a_directory", "directory", []),
]


def files_of(directory):
    return {p.name: p.read_bytes() for p in sorted(directory.rglob("*")) if p.is_file()} if directory.exists() else {}


def expect(name, arguments, code, words, untouched, **settings):
    """Runs the case and returns what is wrong with its end."""
    before = files_of(untouched)
    done = program.run(PROGRAM, RANKS, arguments, timeout=120, **settings)
    wrong = []
    if done.code != code:
        wrong.append(f"exit code {done.code} instead of {code}")
    sentences = done.sentences()
    if len(sentences) != 1 or not program.is_one_sentence(sentences[0]):
        wrong.append(f"not one sentence: {sentences} in {done.err[-2000:]}")
    wrong += [f"'{word}' is not in: {sentences}" for word in words if not any(word in s for s in sentences)]
    after = files_of(untouched)
    if {n: b for n, b in after.items() if n != "log.txt"} != {n: b for n, b in before.items() if n != "log.txt"}:
        wrong.append(f"the output changed: {sorted(before)} became {sorted(after)}")
    return [f"{name}: {w}" for w in wrong]


def mesh_cases():
    for name, content, words in MESHES:
        file = SCRATCH / f"{name}.vtk"
        if content == "directory":
            file.mkdir()
        elif content is not None:
            file.write_bytes(content)
        out = SCRATCH / f"{name}.out"
        yield expect(name, ["run", file, "-o", out], 3, [file.name, *words], out)


def other_formats(good):
    """The same kinds of damage to the other formats."""
    for ending in ("msh", "mesh"):
        whole_file = SCRATCH / f"whole.{ending}"
        done = program.run(PROGRAM, 1, ["convert", good, whole_file])
        if done.code != 0:
            yield [f"convert to {ending}: exit code {done.code}: {done.err}"]
            continue
        whole = whole_file.read_bytes()
        spoilt = {"empty": b"", "half": whole[: len(whole) // 2], "head_only": whole[:30],
                  "garbage": whole[:60] + bytes((37 * i * i + 11 * i) % 256 for i in range(3000))}
        for name, content in spoilt.items():
            file = SCRATCH / f"{name}.{ending}"
            file.write_bytes(content)
            out = SCRATCH / f"{name}.{ending}.out"
            yield expect(file.name, ["run", file, "-o", out], 3, [file.name], out)


def usage_cases(good):
    out = SCRATCH / "usage.out"
    cases = [
        ("unknown_option", ["run", good, "-o", out, "--tagret-hexes", "5"]),
        ("no_output", ["run", good]),
        ("no_command", []),
        ("unknown_command", ["mesh", good]),
        ("both_sizes", ["run", good, "-o", out, "--target-hexes", "5", "--edge-length", "1"]),
        ("bad_number", ["run", good, "-o", out, "--target-hexes", "many"]),
        ("negative", ["run", good, "-o", out, "--edge-length", "-1"]),
        ("bad_stage", ["run", good, "-o", out, "--to", "sow"]),
        ("bad_format", ["run", good, "-o", out, "--formats", "doc"]),
        ("from_after_to", ["run", good, "-o", out, "--from", "igm", "--to", "field"]),
        ("bad_set", ["run", good, "-o", out, "--set", "field"]),
    ]
    for name, arguments in cases:
        yield expect(name, arguments, 2, [], out)
    yield expect("set_typo", ["run", good, "-o", out, "--set", "feild.alignment_sweeps=3"], 2,
                 ["field.alignment_sweeps"], out)
    config = SCRATCH / "typo.toml"
    config.write_text("[field]\nalignment_sweep = 3\n")
    yield expect("config_typo", ["run", good, "-o", out, "--config", config], 3,
                 ["typo.toml", "line 2", "field.alignment_sweeps"], out)
    config = SCRATCH / "bad.toml"
    config.write_bytes(b"\x27\xe2\xa7>")
    yield expect("config_garbage", ["run", good, "-o", out, "--config", config], 3, ["bad.toml"], out)
    yield expect("config_missing", ["run", good, "-o", out, "--config", SCRATCH / "no.toml"], 3, ["no.toml"], out)


def output_cases(good):
    yield expect("output_is_a_file", ["run", good, "-o", good], 3, [good.name], SCRATCH / "none")
    yield expect("output_below_a_file", ["run", good, "-o", good / "out"], 3, [good.name], SCRATCH / "none")
    yield expect("output_unwritable", ["run", good, "-o", "/proc/hexfield-out"], 3, ["/proc/hexfield-out"], SCRATCH / "none")
    yield full_disk(good)


def full_disk(good):
    """A file system of a few pages in a mount namespace of its own, where the system allows that."""
    inside = SCRATCH / "full"
    inside.mkdir()
    for options in ("-rm", "-m"):
        alone = ["unshare", options, "sh", "-c", f'mount -t tmpfs -o size=12k none "{inside}" && exec "$@"', "sh"]
        if subprocess.run([*alone, "true"], capture_output=True).returncode == 0:
            break
    else:
        print("full disk: not tried, this system allows no mount namespaces")
        return []
    # The namespace ends with the run: what the program left is listed inside it.
    line = program.command(PROGRAM, RANKS, ["run", good, "-o", inside / "out", "--to", "field"])
    checkpoint = f"{inside}/out/run.h5"
    check_it = f'[ ! -e "{checkpoint}" ] || "{PROGRAM}" check "{checkpoint}" > /dev/null || echo torn >&2'
    list_it = f'"$@"; code=$?; ls -a "{inside}/out" >&2; {check_it}; exit $code'
    done = subprocess.run([*alone, "sh", "-c", list_it, "sh", *map(str, line)], capture_output=True, text=True, timeout=120)
    wrong = [] if done.returncode == 3 else [f"exit code {done.returncode} instead of 3"]
    if not any(s.startswith("hexfield: ") and "No space left" in s for s in done.stderr.splitlines()):
        wrong.append(f"no sentence on the full disk: {done.stderr}")
    if any(name in ("torn", "singularities.vtk") or name.endswith(".writing") for name in done.stderr.splitlines()):
        wrong.append(f"half-written files are left: {done.stderr}")
    return [f"full disk: {w}" for w in wrong]


def checkpoint_cases(good):
    out = SCRATCH / "made"
    done = program.run(PROGRAM, 1, ["run", good, "-o", out, "--to", "read"])
    if done.code != 0:
        yield [f"the good mesh: exit code {done.code}: {done.err}"]
        return
    whole = (out / "run.h5").read_bytes()
    other = box(3, 1, 1).write(SCRATCH / "other.vtk")
    resume = ["--resume", "--to", "read"]
    yield expect("other_mesh", ["run", other, "-o", out, *resume], 3, ["another mesh", "other.vtk"], out)
    yield expect("from_without", ["run", good, "-o", out, "--from", "seamless"], 3, ["field"], out)
    spoilt = {
        "torn": (whole[: len(whole) * 2 // 3], ["torn"]),
        "torn_in_head": (whole[:50], ["torn"]),
        "empty": (b"", ["empty"]),
        "flipped": (whole[:3000] + bytes([whole[3000] ^ 1]) + whole[3001:], ["damaged"]),
        "newer": (whole.replace(b"schema 1", b"schema 8", 1), ["newer"]),
        "foreign": (b"\x89HDF\r\n\x1a\n" + bytes(3000), ["not written by hexfield"]),
        "foreign_text": (b"hello\n", ["not written by hexfield"]),
    }
    for name, (content, words) in spoilt.items():
        (out / "run.h5").write_bytes(content)
        yield expect(f"checkpoint_{name}", ["run", good, "-o", out, *resume], 3, ["run.h5", *words], out)
        yield expect(f"check_{name}", ["check", out / "run.h5"], 3, ["run.h5"], out)


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    good = box(2, 2, 1).write(SCRATCH / "good.vtk")
    wrong, cases = [], 0
    for group in (mesh_cases(), other_formats(good), usage_cases(good), output_cases(good), checkpoint_cases(good)):
        for found in group:
            cases += 1
            wrong += found
            for line in found:
                print(line, flush=True)
    print(f"{cases} cases on {RANKS} ranks, {len(wrong)} wrong")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
