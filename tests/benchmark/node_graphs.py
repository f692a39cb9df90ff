"""Random graphs of shader nodes, in Cycles and in Pivot: the share of them that look the same.

    ./run python -m tests.benchmark.node_graphs --blender blender /PATH/OF/A/PYTHON/WITH/bpy
    ./run python -m tests.benchmark.node_graphs --single --only-nodes TexNoise Math

--single tries each node alone, with --count random settings of it.

A graph colours an Emission shader of a plane, sampled once at each pixel's centre, 64 x 64: neither renderer has noise.
It passes when 90 % of its pixels are within 2 % of Cycles (or 0.001). Graphs whose picture is constant, not finite or
not steady (one that sampling a hundredth of a pixel aside changes) are drawn again; a node alone may be constant. The
same seed draws the same graphs in the same Blender. --keep saves what fails: a .blend file, and a PNG of Cycles'
picture and the other's. A failing graph's culprit is the first of its nodes, inputs before what they feed, whose own
output fails where it colours the plane.
"""

from __future__ import annotations

import argparse
import collections
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import bpy  # noqa: F401  (the addon's modules need it)

# isort: split
import numpy as np
from pivot.chart.pixels import to_bytes, write_png

from tests.addon.blender_host import Host, environment, find_host
from tests.benchmark import node_graph_kinds as kinds

WORKER = Path(__file__).with_name("node_graph_worker.py")
LEAST_AGREEMENT = 0.9
KINDS = kinds.SOURCES + kinds.TEXTURES + kinds.OPERATIONS

Row = dict[str, Any]


def render(host: Host, graphs: list[Row], arguments: argparse.Namespace) -> list[Row]:
    """Every graph's row, of as few processes as crashes allow."""
    rows: list[Row] = []
    with tempfile.TemporaryDirectory(prefix="node_graphs_") as folder:
        results = Path(folder) / "results.json"
        results.touch()
        keep = arguments.keep / str(host) if arguments.keep else None
        if keep:
            keep.mkdir(parents=True, exist_ok=True)
        job = {"seed": arguments.seed, "allowed": arguments.only_nodes, "peer": arguments.peer}
        job |= {"results": str(results), "keep": str(keep) if keep else None, "least": LEAST_AGREEMENT}
        while len(rows) < len(graphs):
            done = subprocess.run(
                [*host.command, str(WORKER)],
                input=json.dumps(job | {"graphs": graphs[len(rows) :]}),
                env=environment(Path(folder)),
                capture_output=True,
                text=True,
            )
            rows = [json.loads(line) for line in results.read_text().splitlines()]
            if len(rows) < len(graphs):
                tail = (done.stdout + done.stderr).strip().splitlines()[-1:]
                crashed = graphs[len(rows)] | {"fault": f"exit status {done.returncode}: {' '.join(tail)}"}
                with results.open("a") as file:
                    file.write(json.dumps(crashed) + "\n")
                rows.append(crashed)
        if keep:
            write_pictures(keep)
    return rows


def write_pictures(folder: Path) -> None:
    """A PNG of each pair of pictures, Cycles' to the left, darker where that shows more than 1."""
    for file in folder.glob("*.npz"):
        with np.load(file) as pair:
            both = np.nan_to_num(np.hstack([pair["cycles"], pair["other"]]))
            brightest = np.percentile(np.nan_to_num(pair["cycles"]), 99)
        write_png(file.with_suffix(".png"), to_bytes(np.kron(both / max(brightest, 1.0), np.ones((4, 4, 1)))))
        file.unlink()


def passes(row: Row) -> bool:
    return row.get("agreement", 0.0) >= LEAST_AGREEMENT


def describe(row: Row) -> str:
    found = row["fault"] if "fault" in row else f"{row['agreement']:6.1%}"
    lines = row.get("settings", [str(row["kind"])])
    blamed = f"\n{'':13}culprit: {row['culprit']}" if row.get("culprit", lines[0]) != lines[0] else ""
    return f"{row['index']:4} {found}  {'; '.join(lines)}{blamed}"


def print_share(label: str, rows: list[Row]) -> None:
    passed = sum(map(passes, rows))
    print(f"{label:28} {passed:4} of {len(rows):4} pass, {passed / max(len(rows), 1):6.1%}")


def print_table(rows: list[Row], is_single: bool) -> None:
    """Failing graphs, totals, and the share that fails of each kind's, the worst first."""
    for row in rows:
        if not passes(row):
            print(describe(row))
    by_kind: dict[str, list[Row]] = collections.defaultdict(list)
    for row in rows:
        for kind in [row["kind"]] if is_single else row.get("kinds", ()):
            by_kind[kind].append(row)
    culprits = collections.Counter(row["culprit"].split()[0] for row in rows if row.get("culprit"))
    print(f"\n{'kind':20} {'graphs':>6} {'fail':>6} {'culprit':>8}")
    for kind in culprits:
        by_kind[kind] += []  # a node alone may fail for one that its inputs come from
    failing = {kind: sum(not passes(row) for row in found) / max(len(found), 1) for kind, found in by_kind.items()}
    for kind, share in sorted(failing.items(), key=lambda item: (-item[1], item[0])):
        print(f"{kind:20} {len(by_kind[kind]):6} {share:6.0%} {culprits[kind]:8}")
    print_share("graphs", rows)
    print_share("of them constant", [row for row in rows if row.get("constant")])
    print(f"attempts a graph: {np.mean([row.get('attempts', 1) for row in rows]):.2f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Blenders, and Pythons with bpy")
    parser.add_argument("--count", type=int, help="graphs, 200 unless given; with --single settings of a node, 12")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--single", action="store_true", help="each node kind alone")
    parser.add_argument("--only-nodes", nargs="+", default=KINDS, choices=KINDS, metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--keep", type=Path, metavar="FOLDER")
    parser.add_argument("--peer", default="PIVOT", choices=("PIVOT", "CYCLES"), help="CYCLES: how steady graphs are")
    arguments = parser.parse_args()
    for blender in arguments.blender:
        host = find_host(blender)
        if host is None:
            print(f"skipped: {blender}, which is no Blender and has no bpy")
            continue
        count = arguments.count or (12 if arguments.single else 200)
        drawn: list[tuple[str | None, int]] = [(None, 0)] * count
        if arguments.single:
            drawn = [(kind, variant) for kind in arguments.only_nodes for variant in range(count)]
        graphs = [{"index": i, "kind": kind, "variant": variant} for i, (kind, variant) in enumerate(drawn)]
        print(
            f"Blender {host}, {len(graphs)} graphs, seed {arguments.seed}, Cycles beside {arguments.peer}", flush=True
        )
        rows = [row for row in render(host, graphs, arguments) if "agreement" in row or "fault" in row]
        print_table(rows, arguments.single)


if __name__ == "__main__":
    main()
