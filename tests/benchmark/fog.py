"""Monte Carlo efficiency of Pivot and Cycles in fog: single scattering and two bounces, Blender's pixel filter in both.

./run python tests/benchmark/fog.py [--blender PYTHON ...] [--scenes NAME ...]

320 x 180; nothing clamped, no filter glossy, no adaptive sampling, no denoiser; monte_carlo_pictures.py says what is
measured, and how. What Cycles does by default, and what is tried of it:

- Where along the ray light scatters (a material's and the world's Sampling): Multiple Importance by default; also tried
  are Equiangular and Distance. A sun is sampled by distance in each.
- Fog whose shader reads nothing that varies is known to be homogeneous, and is integrated in closed form: neither Step
  Rate nor Step Size matters. In 4.5 a varying one is marched through, biased, in steps of a tenth of the object's
  extent (0.1 m in the world) times the Step Rates; 5.0 and later track null collisions, unbiased, or march if Biased
  (scene.cycles.volume_biased) is set. Both are tried with the default Step Rate of 1.
- Volume Bounces is 0, one scattering; here it is Max Bounces, which counts what surfaces scatter too.
- The light tree is on; where there are several lights, off is tried too. Path guiding is off.

All are tried with one seed, the best two are measured with all. All are held against one reference, of the newest
Blender's unbiased tracking by Multiple Importance: what marching is off by is part of its error. The means of Pivot's
and Cycles' references are to agree within 1 %, or the line is flagged. References are kept in build/fog and used
again; --seeds 0 makes those alone. Writes fog.csv there, and for each scene a PNG of both renderers' pictures and
references.
"""

from __future__ import annotations

import argparse
import hashlib
import itertools
import sys
from pathlib import Path

import fog_scenes as scenes
import fog_smoke
import indirect_table
import monte_carlo_table as table
from monte_carlo_filters import FILTERS
from monte_carlo_find import find_blenders, has_pivot
from monte_carlo_measure import measure
from monte_carlo_pictures import Gallery, Renderer

OUTPUT = Path(__file__).resolve().parents[2] / "build" / "fog"
WORKER = "fog_blender.py"
SAMPLINGS = {"MIS": "MULTIPLE_IMPORTANCE", "equiangular": "EQUIANGULAR", "distance": "DISTANCE"}
UNBIASED = (5, 0)  # the first Blender that tracks null collisions
BUILDERS = tuple(Path(module.__file__ or "") for module in (scenes, scenes.parts, fog_smoke))


def pivot_renderers(blender: str, scene: scenes.FogScene) -> list[Renderer]:
    settings = {"max_bounces": scene.bounces} | FILTERS["BLACKMAN_HARRIS"]["pivot"]
    return [
        Renderer("pivot", "pivot", blender, WORKER, settings),
        Renderer("pivot MIS", "pivot", blender, WORKER, settings | {"light_sampling": "MIS"}),
    ]


def cycles_renderers(blenders: dict[str, str], scene: scenes.FogScene) -> list[Renderer]:
    """The first, of the newest Blender, makes the reference."""
    bounces = {f"{kind}_bounces": scene.bounces for kind in ("max", "diffuse", "glossy", "transmission", "volume")}
    found = []
    newest_first = sorted(blenders.items(), key=lambda item: version_of(item[1]), reverse=True)
    for (python, version), (sampling, value) in itertools.product(newest_first, SAMPLINGS.items()):
        for tree, biased in itertools.product(
            (True, False) if scene.several_lights else (True,),
            (False, True) if version_of(version) >= UNBIASED else (None,),
        ):
            label = f"cycles {version} {sampling}{' biased' if biased else ''}{'' if tree else ' no tree'}"
            settings = bounces | {"use_light_tree": tree, "volume_sampling": value}
            if biased is not None:
                settings["volume_biased"] = biased
            found.append(Renderer(label, "cycles", python, WORKER, settings))
    return found


def version_of(version: str) -> tuple[int, ...]:
    return tuple(map(int, version.split(".")))


def scene_key(scene: str) -> str:
    return hashlib.sha256(b"".join(file.read_bytes() for file in BUILDERS)).hexdigest()[:8]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=list(scenes.SCENES))
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--reference-samples", type=int, default=512)
    parser.add_argument("--only", nargs="+", help="measure these renderers; of others, the last pictures")
    arguments = parser.parse_args()
    fog_smoke.write(scenes.SMOKE)
    gallery = Gallery(OUTPUT, scene_key, dict.fromkeys(("pivot", "cycles"), arguments.reference_samples))
    blenders = find_blenders(arguments.blender)
    with_pivot = has_pivot(arguments.blender[0])
    rows, renderers = [], {}
    for name in arguments.scenes:
        scene = scenes.SCENES[name]
        ours = pivot_renderers(arguments.blender[0], scene) if with_pivot else []
        theirs = cycles_renderers(blenders, scene)
        renderers[name] = ours + theirs
        found = measure(gallery, renderers[name], name, arguments)
        rows += found
        if found:
            indirect_table.write_sheet(gallery, renderers[name], found, "cycles", OUTPUT, (scenes.WIDTH, scenes.HEIGHT))
    if not rows:
        return
    table.write_csv(OUTPUT / "fog.csv", rows)
    indirect_table.print_ratios(gallery, renderers, rows, "cycles")
    if with_pivot:
        print_joint(rows)


def print_joint(rows: list[table.Row]) -> None:
    """How much less noise joint sampling leaves than MIS, in Pivot, of equal samples."""
    print(f"\n{'':28}{'relMSE of MIS over joint sampling':>34}")
    for scene, found in table.by_scene(rows).items():
        if "pivot" in found and "pivot MIS" in found:
            print(f"{scene:28}{found['pivot MIS']['relMSE'] / found['pivot']['relMSE']:34.2f}")


if __name__ == "__main__":
    main()
