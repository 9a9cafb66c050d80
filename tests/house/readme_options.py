#!/usr/bin/python3
"""readme_options.py HEXFIELD: README.md lists the options of `hexfield run` and the exit codes that the program has."""

import re
import subprocess
import sys

from sources import ROOT, finish

NOT_LISTED = {"--help"}


def readme_section(title):
    text = (ROOT / "README.md").read_text()
    return re.search(rf"^### {re.escape(title)}\n(.*?)(?=^##)", text, flags=re.M | re.S).group(1)


def option_violations(program):
    done = subprocess.run([program, "run", "--help"], capture_output=True, text=True)
    if done.returncode != 0:
        return [f"`hexfield run --help` ends with {done.returncode}"]
    offered = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", done.stdout)) - NOT_LISTED
    rows = [line.split("|")[1] for line in readme_section("Options of `hexfield run`").splitlines() if line.startswith("|")]
    listed = set(re.findall(r"--[a-z][a-z-]*", " ".join(rows)))
    listed = {option for option in listed if re.search(r"[a-z]", option[2:])}
    return [f"README lists {o}, the program has no such option" for o in sorted(listed - offered)] + [
        f"the program has {o}, README does not list it" for o in sorted(offered - listed)
    ]


def exit_code_violations():
    header = (ROOT / "include" / "hexfield" / "base" / "error.hpp").read_text()
    body = re.search(r"enum class ExitCode[^{]*\{(.*?)\}", header, flags=re.S).group(1)
    in_code = {int(n) for n in re.findall(r"=\s*(\d+)", body)}
    in_readme = {int(n) for n in re.findall(r"^\| (\d+) \|", readme_section("Exit codes"), flags=re.M)}
    return [f"exit code {n} stands in only one of README and ExitCode" for n in sorted(in_code ^ in_readme)]


if __name__ == "__main__":
    finish(option_violations(sys.argv[1]) + exit_code_violations(), "README lists the options and the exit codes")
