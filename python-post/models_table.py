#!/usr/bin/python3
"""Markdown table of a batch of models.

    models_table.py RESULTS.csv [RESULTS.csv...]

Each CSV has a header and one line per model with (at least) the columns model, rc, judge, seconds, hexes, sj_min,
sj_mean, peak_mb and text; a model that stands in several files is listed once, from the last of them. Prints the
table and a line of totals.
"""

import argparse
import csv

COLUMNS = ["model", "rc", "judge", "hexes", "sj_min", "sj_mean", "seconds", "peak_mb", "text"]


def read(paths):
    """{model: row} in alphabetical order."""
    rows = {}
    for path in paths:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                missing = [c for c in COLUMNS if c not in row]
                if missing:
                    raise SystemExit(f"{path} has no column {missing[0]}")
                rows[row["model"]] = row
    return dict(sorted(rows.items()))


def shorten(column, value):
    """A cell: numbers with few digits, text without bars."""
    try:
        digits = {"sj_min": 3, "sj_mean": 3, "seconds": 1, "peak_mb": 0}[column]
        return f"{float(value):.{digits}f}"
    except (KeyError, ValueError):
        return value.replace("|", "/").replace("\n", " ")


def table(rows):
    """Lines of a Markdown table."""
    yield "| " + " | ".join(COLUMNS) + " |"
    yield "|---" * len(COLUMNS) + "|"
    for row in rows.values():
        yield "| " + " | ".join(shorten(c, row[c]) for c in COLUMNS) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", metavar="RESULTS.csv")
    rows = read(parser.parse_args().results)
    print("\n".join(table(rows)))
    valid = sum(row["judge"] == "VALID" for row in rows.values())
    codes = {}
    for row in rows.values():
        codes[row["rc"]] = codes.get(row["rc"], 0) + 1
    print(f"\n{len(rows)} models, {valid} valid; exit codes " + ", ".join(f"{c}: {n}" for c, n in sorted(codes.items())))


if __name__ == "__main__":
    main()
