"""What the house tests read: the C++ files of the tree, their includes and their functions."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def cpp_files(*folders):
    """All .hpp and .cpp files under the folders (relative to the root), in one order."""
    found = []
    for folder in folders:
        found += [p for p in (ROOT / folder).rglob("*") if p.suffix in (".hpp", ".cpp")]
    return sorted(found)


def name(path):
    return str(path.relative_to(ROOT))


def without_comments(text):
    """The code with comments, string and character literals blanked; line numbers stay."""
    pattern = r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])\''
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.S)


def functions(text):
    """(first line, number of lines) of every function body; a lambda counts towards its function."""
    code = without_comments(text)
    code = re.sub(r"^[ \t]*#[^\n]*(?:\\\n[^\n]*)*", lambda m: re.sub(r"[^\n]", " ", m.group(0)), code, flags=re.M)
    result, stack = [], []
    head_start = 0
    for match in re.finditer(r"[{};]", code):
        if match.group(0) == "{":
            head = code[head_start:match.start()]
            inside = any(is_function for _, is_function in stack)
            stack.append((match.start() - len(head.lstrip()) + 0, not inside and is_function_head(head)))
        elif match.group(0) == "}" and stack:
            start, is_function = stack.pop()
            if is_function:
                first = code.count("\n", 0, start) + 1
                result.append((first, code.count("\n", 0, match.start()) + 2 - first))
        head_start = match.end()
    return result


def is_function_head(head):
    """True for `... name(...) [const] [noexcept] [-> T] [: members]` before a brace."""
    head = head.strip()
    if "(" not in head or re.match(r"(namespace|enum|struct|class|union)\b", head):
        return False
    before = re.sub(r"\([^()]*\)", "()", head)
    return not re.search(r"(^|\s)(if|for|while|switch|catch|do)\s*\(", before) and not re.search(r"=\s*$", head)


def finish(violations, what):
    """Ends the test: prints the violations, or one line that says what holds."""
    if violations:
        print("\n".join(violations))
        raise SystemExit(f"{len(violations)} violations: {what}")
    print(f"ok: {what}")
