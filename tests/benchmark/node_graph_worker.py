"""Inside Blender: render random graphs by Cycles and by Pivot, and compare them.

node_graph_worker.py < JOB: the JSON that node_graphs.py writes. Appends a line of JSON to its file of results for each
graph, so that nothing is lost where Blender crashes.
"""

from __future__ import annotations

import json
import random
import sys
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parent))
import node_graph_scene
from blender_render import render_picture
from node_graph_maker import Maker

DEEPEST = 6
ATTEMPTS = 20
TOLERANCE = 0.02
FLOOR = 1e-3
ASIDE_PX = 0.01
STEADY = 0.97  # the least share of its pixels that a graph keeps when all are sampled aside

Picture = NDArray[np.float32]


def render(engine: str, aside_px: float = 0.0) -> Picture:
    """(height, width, 3) radiance at the pixels' centres or aside, one sample each."""
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.camera.data.shift_x = scene.camera.data.shift_y = aside_px / node_graph_scene.SIZE_PX
    if engine == "CYCLES":
        settings: Any = scene.cycles
        settings.device = "CPU"
        settings.samples, settings.max_bounces = 1, 0  # the first sample is at the centre
        settings.use_adaptive_sampling = settings.use_denoising = False
    else:
        scene.pivot.samples, scene.pivot.max_bounces = 1, 0
        scene.render.filter_size = 0.01
    return render_picture()


def agreement(cycles: Picture, other: Picture) -> float:
    """The share of the pixels whose channels all agree."""
    with np.errstate(invalid="ignore"):
        close = np.abs(other - cycles) <= np.maximum(TOLERANCE * np.abs(cycles), FLOOR)
    same = close | (cycles == other) | (np.isnan(cycles) & np.isnan(other))
    return float(same.all(axis=-1).mean())


def make(job: dict[str, Any], graph: dict[str, Any]) -> tuple[Maker, Picture, int]:
    """Draw a graph until Cycles shows a picture of it that is not constant and steady; the attempts it took.

    A node alone may be constant.
    """
    for attempt in range(ATTEMPTS):
        rng = random.Random(f"{job['seed']} {graph['index']} {attempt}")
        tree, emission = node_graph_scene.build(rng)
        maker = Maker(tree, rng, job["allowed"])
        if graph["kind"]:
            maker.single(emission.inputs["Color"], graph["kind"], graph["variant"])
        else:
            maker.feed(emission.inputs["Color"], rng.randint(1, DEEPEST))
        cycles = render("CYCLES")
        finite = np.isfinite(cycles).all(axis=-1)
        varies = finite.any() and np.ptp(cycles[finite], axis=0).max() > 10 * FLOOR
        if finite.any() and (varies or graph["kind"]) and agreement(cycles, render("CYCLES", ASIDE_PX)) >= STEADY:
            return maker, cycles, attempt + 1
    raise RuntimeError(f"no graph of {graph['kind'] or job['allowed']} shows a steady picture that varies")


def compare(job: dict[str, Any], graph: dict[str, Any]) -> dict[str, Any]:
    """A row of the results; a graph of a kind this Blender lacks has no agreement."""
    if graph["kind"] and not hasattr(bpy.types, f"ShaderNode{graph['kind']}"):
        return graph
    try:
        maker, cycles, attempts = make(job, graph)
    except RuntimeError as error:
        return graph | {"fault": str(error)}
    row = graph | {"kinds": sorted(maker.kinds), "settings": list(maker.settings.values()), "attempts": attempts}
    row["constant"] = bool(np.ptp(cycles, axis=(0, 1)).max() <= FLOOR)
    other = np.full_like(cycles, np.inf)
    try:
        other = render(job["peer"], -ASIDE_PX if job["peer"] == "CYCLES" else 0.0)
    except RuntimeError as error:
        row["fault"] = str(error).strip()
    row["agreement"] = agreement(cycles, other)
    if row["agreement"] >= job["least"]:
        return row
    if job["keep"]:
        stem = f"{graph['index']:04}" + (f"_{graph['kind']}" if graph["kind"] else "")
        file = Path(job["keep"]) / stem
        np.savez(file.with_suffix(".npz"), cycles=cycles, other=other)
        bpy.ops.wm.save_as_mainfile(filepath=str(file.with_suffix(".blend")), copy=True)
    return row | {"culprit": culprit(maker, job)}


def culprit(maker: Maker, job: dict[str, Any]) -> str:
    """The first node, inputs before what they feed, whose own output fails where it colours the plane; "" for none."""
    emission = next(node for node in maker.tree.nodes if node.type == "EMISSION")
    first = emission.inputs["Color"].links[0].from_socket
    ordered: dict[Any, Any] = {}  # the output to look at, by node

    def visit(output: Any) -> None:
        if output.node not in ordered:
            for socket in output.node.inputs:
                for link in socket.links:
                    visit(link.from_socket)
            ordered[output.node] = output

    visit(first)
    for node, output in ordered.items():
        maker.tree.links.new(output, emission.inputs["Color"])
        cycles = render("CYCLES")
        if agreement(cycles, render("CYCLES", ASIDE_PX)) < STEADY:
            continue
        try:
            fails = agreement(cycles, render(job["peer"])) < job["least"]
        except RuntimeError:
            fails = True
        if fails:
            return maker.settings.get(node.name, node.bl_idname.removeprefix("ShaderNode"))
    return ""


def main() -> None:
    job = json.load(sys.stdin)
    for addon in ("cycles", "pivot"):
        if addon_utils.enable(addon) is None:
            raise RuntimeError(f"the addon {addon} does not enable")
    for graph in job["graphs"]:
        row = compare(job, graph)
        with Path(job["results"]).open("a") as file:
            file.write(json.dumps(row) + "\n")


if __name__ == "__main__":
    main()
