#!/usr/bin/python3
"""The library does not print: callers listen through Control, the log and the values they get."""

import re

from sources import cpp_files, finish, name, without_comments

PRINTS = re.compile(
    r"std::(cout|cerr|clog)\b|(?<![\w:])(std::)?(f?printf|f?puts|putchar|perror)\s*\(|fmt::print\b|PetscPrintf\b|#\s*include\s*<iostream>"
)


def violations():
    for path in cpp_files("src", "include"):
        for number, line in enumerate(without_comments(path.read_text()).splitlines(), 1):
            if PRINTS.search(line):
                yield f"{name(path)}:{number}: {line.strip()}"


if __name__ == "__main__":
    assert PRINTS.search("  printf(1);") and not PRINTS.search("snprintf(a, b)")
    finish(list(violations()), "no printing in the library")
