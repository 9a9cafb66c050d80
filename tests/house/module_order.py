#!/usr/bin/python3
"""A module includes only what stands below it, in its sources, in its headers and in CMakeLists.txt."""

import re

from sources import ROOT, cpp_files, finish, name

# Which modules a module may use: the order of the house, from the ground up.
MAY_USE = {
    "base": [],
    "mesh": ["base"],
    "solve": ["base", "mesh"],
    "field": ["base", "mesh", "solve"],
    "repair": ["base", "mesh", "solve", "field"],
    "map": ["base", "mesh", "solve", "field"],
    "quantize": ["base", "mesh", "field", "map"],
    "hex": ["base", "mesh", "solve", "map"],
    "moments": ["base", "mesh", "solve", "field", "map"],
    "io": ["base", "mesh", "field", "map", "quantize", "hex"],
    "pipeline": ["base", "mesh", "solve", "field", "repair", "map", "quantize", "hex", "moments", "io"],
}


def module_of(path):
    match = re.match(r"(?:src|include/hexfield)/(\w+)/", name(path))
    return match.group(1) if match else None


def included_modules(path):
    """(line, module or None) of every quoted or hexfield include; None where it is no file of the tree."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
        if not match or (match.group(1) == "<" and not match.group(2).startswith("hexfield/")):
            continue
        places = [path.parent / match.group(2), ROOT / "include" / match.group(2), ROOT / "src" / match.group(2)]
        found = next((p.resolve() for p in places if p.is_file()), None)
        yield number, match.group(2), module_of(found) if found else None


def include_violations():
    violations = []
    for path in cpp_files("src", "include"):
        module = module_of(path)
        if module not in MAY_USE:
            violations.append(f"{name(path)}: '{module}' is no module of the house")
            continue
        for line, text, used in included_modules(path):
            if used is None:
                violations.append(f"{name(path)}:{line}: {text} is no file of the tree")
            elif used != module and used not in MAY_USE[module]:
                violations.append(f"{name(path)}:{line}: {module} must not use {used}")
    return violations


def cmake_violations():
    text = (ROOT / "CMakeLists.txt").read_text()
    violations = []
    for module, rest in re.findall(r"^hexfield_module\((\w+)([^)]*)\)", text, flags=re.M):
        words = re.match(r"\s*DEPS((?:\s+[a-z]+)+)", rest)
        for used in words.group(1).split() if words else []:
            if used not in MAY_USE.get(module, []):
                violations.append(f"CMakeLists.txt: {module} must not depend on {used}")
    return violations


if __name__ == "__main__":
    for upper, lower in MAY_USE.items():  # the table itself has no way back up
        assert all(list(MAY_USE).index(m) < list(MAY_USE).index(upper) for m in lower), upper
    finish(include_violations() + cmake_violations(), "modules include only what stands below them")
