#!/usr/bin/python3
"""Every C++ file is as clang-format 16 writes it (exit status 77, skipped, where that is not installed)."""

import shutil
import subprocess

from sources import ROOT, cpp_files, finish, name


def violations(tool):
    for path in cpp_files("src", "include", "apps", "tests"):
        done = subprocess.run([tool, "--dry-run", "--Werror", str(path)], cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            first = done.stderr.splitlines()[0].split(": ")[0] if done.stderr else ""
            yield f"{name(path)}: not formatted, first at {first}"


if __name__ == "__main__":
    program = shutil.which("clang-format-16")
    if program is None:
        print("skipped: clang-format-16 is not installed")
        raise SystemExit(77)
    finish(list(violations(program)), "all files are formatted")
