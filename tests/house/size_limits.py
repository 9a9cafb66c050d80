#!/usr/bin/python3
"""No file over 600 lines, no function over 80."""

from sources import cpp_files, finish, functions, name

MAX_FILE, MAX_FUNCTION = 600, 80


def violations():
    for path in cpp_files("src", "include", "apps", "tests"):
        text = path.read_text()
        lines = text.count("\n")
        if lines > MAX_FILE:
            yield f"{name(path)}: {lines} lines"
        for first, length in functions(text):
            if length > MAX_FUNCTION:
                yield f"{name(path)}:{first}: a function of {length} lines"


def check_the_counter():
    body = "  x();\n" * 5
    text = f"namespace a {{\nint f(int a) {{\n{body}  if (a) {{ y(); }}\n}}\nstruct S {{\n  S() : m_(1) {{\n{body}  }}\n}};\n}}\n"
    assert functions(text) == [(2, 8), (11, 7)], functions(text)


if __name__ == "__main__":
    check_the_counter()
    finish(list(violations()), f"files of at most {MAX_FILE} lines, functions of at most {MAX_FUNCTION}")
