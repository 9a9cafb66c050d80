#!/usr/bin/python3
"""readme_commands.py BUILD_DIRECTORY SCRATCH_DIRECTORY [--long]: runs the command lines of README.md.

All ```sh blocks are run in order, as one shell session, in a scratch copy of the checkout whose build/release is the
given build. Lines that end with "# long" (they build or test everything once more) run with --long only, lines with
"# needs Slurm" never: tests/jobs runs that script.
"""

import argparse
import os
import re
import shutil
import subprocess
from pathlib import Path

from sources import ROOT

TOP = ["CMakeLists.txt", "CMakePresets.json", "CHANGELOG.md", "LICENSE", "README.md"]
TOP += ["src", "include", "apps", "tests", "cmake", "jobs", "python-post"]


def command_lines(text):
    """Every line of every ```sh block."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, flags=re.M | re.S):
        yield from (line for line in block.splitlines() if line.strip())


def wanted(line, long):
    if line.endswith("# needs Slurm"):
        return False
    if line.endswith("# long"):
        return long
    if line.startswith("gmsh ") and shutil.which("gmsh") is None:
        return False
    return True


def scratch_checkout(scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "build").mkdir(parents=True)
    for entry in TOP:
        (scratch / entry).symlink_to(ROOT / entry)
    if shutil.which("gmsh") is None:
        shutil.copy(ROOT / "tests" / "data" / "bracket.msh", scratch / "bracket.msh")


def environment(build, scratch, long):
    result = dict(os.environ, HOME=str(scratch))
    if not long:
        result["HEXFIELD_BUILD"] = str(build)
    return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("scratch", type=Path)
    parser.add_argument("--long", action="store_true")
    arguments = parser.parse_args()
    scratch_checkout(arguments.scratch)

    script = ["set -euxo pipefail"]
    for line in command_lines((ROOT / "README.md").read_text()):
        if not wanted(line, arguments.long):
            print(f"not run here: {line}", flush=True)
            continue
        script.append(line)
        if line.startswith("cmake --preset release") and not arguments.long:
            # The finished build stands in for the one that the next, long line of the README would make.
            script.append(f"rm -rf build/release && ln -s '{arguments.build}' build/release")
    done = subprocess.run(["bash", "-c", "\n".join(script)], cwd=arguments.scratch, stdin=subprocess.DEVNULL,
                          env=environment(arguments.build, arguments.scratch, arguments.long))
    raise SystemExit(done.returncode)


if __name__ == "__main__":
    main()
