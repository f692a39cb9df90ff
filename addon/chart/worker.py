"""In a background Blender of its own: chart one .blend.

worker.py -- ADDON BLEND LADDER FOLDER   writes FOLDER/chart.png and FOLDER/rows.json; pictures are kept in FOLDER too

Prints "[done/all] what" as it goes.
"""

from __future__ import annotations

import importlib
import os
import sys
import traceback
from pathlib import Path

import bpy


def main(package: str, blend: Path, ladder_name: str, folder: Path) -> None:
    """package: the addon's, enabled."""

    def module(name: str) -> object:
        return importlib.import_module(f"{package}.{name}")

    bpy.ops.wm.open_mainfile(filepath=str(blend))
    measure, plot, ladder = module("chart.measure"), module("chart.plot"), module("chart.ladder")
    chosen = ladder.LADDERS[ladder_name]
    rows = measure.measure(blend, chosen, folder, lambda line: print(line, flush=True))
    plot.draw_chart(module("core").load(), rows, folder / "chart.png", *plot.titles(blend.stem, chosen))
    (folder / "rows.json").write_text(measure.rows_to_json(rows))


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1 :]
    status = 0
    try:
        # isort: split
        import addon_utils

        if addon_utils.enable(arguments[0]) is None:
            raise RuntimeError(f"the addon {arguments[0]} does not enable")
        main(arguments[0], Path(arguments[1]), arguments[2], Path(arguments[3]))
    except Exception as error:
        traceback.print_exc()
        print(f"Error: {error}", flush=True)
        status = 1
    sys.stdout.flush()
    os._exit(status)  # some Blenders crash at exit while classes are registered
