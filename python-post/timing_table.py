#!/usr/bin/python3
"""Table of seconds and memory per stage from the reports of one or more runs, and a scaling plot.

    timing_table.py RUN [RUN...] [--plot scaling.png]

RUN is an output directory of `hexfield run` or its report.json. The table is Markdown: one column per run, one
line per stage, with the peak memory of the largest process. The plot shows seconds per stage against the number
of processors used (ranks x threads), with the line of perfect scaling from the smallest run.
"""

import argparse

from hexfield_post import new_figure, read_report


def stage_names(reports):
    """Names of all stages in order of their first appearance."""
    return list(dict.fromkeys(stage["name"] for report in reports for stage in report["stages"]))


def stage(report, name):
    return next((s for s in report["stages"] if s["name"] == name), None)


def processors(report):
    return report["ranks"] * report["threads"]


def total_seconds(report):
    return sum(s["seconds"] for s in report["stages"])


def table(reports):
    """Lines of a Markdown table."""
    heads = [f"{r['input']['tets']} tets, {r['ranks']} x {r['threads']}" for r in reports]
    yield "| stage | " + " | ".join(heads) + " |"
    yield "|---|" + "---|" * len(reports)
    for name in stage_names(reports):
        cells = []
        for report in reports:
            found = stage(report, name)
            cells.append(f"{found['seconds']:.2f} s, {found['peak_rss_mb']:.0f} MB" if found else "-")
        yield f"| {name} | " + " | ".join(cells) + " |"
    yield "| all | " + " | ".join(f"{total_seconds(r):.2f} s" for r in reports) + " |"
    yield "| hexes | " + " | ".join(str(r.get("hex", {}).get("count", "-")) for r in reports) + " |"


def plot(reports, path):
    """Seconds per stage against processors, log-log."""
    reports = sorted(reports, key=processors)
    figure, axes = new_figure(7, 5)
    x = [processors(r) for r in reports]
    for name in stage_names(reports):
        points = [(processors(r), stage(r, name)["seconds"]) for r in reports if stage(r, name)]
        axes.loglog(*zip(*points), marker="o", label=name)
    totals = [total_seconds(r) for r in reports]
    axes.loglog(x, totals, "k", marker="s", label="all")
    axes.loglog(x, [totals[0] * x[0] / p for p in x], "k:", label="perfect")
    axes.set_xlabel("ranks x threads")
    axes.set_ylabel("seconds")
    axes.set_xticks(sorted(set(x)), [str(p) for p in sorted(set(x))])
    axes.legend(fontsize="small")
    figure.savefig(path, dpi=120, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--plot", metavar="PNG", help="write the scaling plot here")
    arguments = parser.parse_args()
    reports = [read_report(run) for run in arguments.runs]
    print("\n".join(table(reports)))
    if arguments.plot:
        plot(reports, arguments.plot)


if __name__ == "__main__":
    main()
