"""Inside Blender as a module: scenes of indirect_scenes, indirect_plain and lobe_scenes.py by Cycles or Pivot.

indirect_blender.py < JOBS: does the jobs (see monte_carlo_worker.py).
"""

from __future__ import annotations

import indirect_plain as plain
import indirect_scenes as scenes
import lobe_scenes as lobes
import monte_carlo_renderers as renderers
import monte_carlo_worker as worker

if __name__ == "__main__":
    worker.main({"cycles": renderers.Cycles, "pivot": renderers.Pivot}, scenes.SCENES | plain.SCENES | lobes.SCENES)
