#!/usr/bin/python3
"""Every C++ file is as clang-format 16 writes it (exit status 77, skipped, where that is not installed)."""

import re
import shutil
import subprocess

from sources import ROOT, cpp_files, finish


def violations(tool):
    """The first badly formatted line of each file."""
    files = [str(path.relative_to(ROOT)) for path in cpp_files("src", "include", "apps", "tests")]
    done = subprocess.run([tool, "--dry-run", "--Werror", *files], cwd=ROOT, capture_output=True, text=True)
    found = re.findall(r"^(\S+?):(\d+):\d+: error", done.stderr, flags=re.M)
    if done.returncode != 0 and not found:
        return [done.stderr.strip() or f"{tool} ends with {done.returncode}"]
    first = {}
    for file, line in found:
        first.setdefault(file, line)
    return [f"{file}:{line}: not formatted" for file, line in first.items()]


if __name__ == "__main__":
    program = shutil.which("clang-format-16")
    if program is None:
        print("skipped: clang-format-16 is not installed")
        raise SystemExit(77)
    finish(violations(program), "all files are formatted")
