"""The import order of the tree: addon -> pivot_core -> core, core's folders in one direction, Embree in its files."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

# A folder of core/ includes only itself and folders of earlier rows; folders of one row do not know each other.
CORE_ROWS = (
    ("math",),
    ("simd",),
    ("sampling",),
    ("distributions",),
    ("tables",),
    ("geometry",),
    ("bsdf", "media", "lights", "textures"),
    ("shaders",),
    ("shading",),
    ("scene",),
    ("film",),
    ("integrators",),
    ("render",),
)
ROW_OF = {folder: row for row, folders in enumerate(CORE_ROWS) for folder in folders}
CORE_PROPERTIES = {
    "added_lobe",
    "analytic_error",
    "energy",
    "identities",
    "mesh_lights",
    "negative_light",
    "oracles",
    "sample_weights",
    "samplers",
    "stability",
}
BLENDER_MODULES = {
    "bpy",
    "bpy_extras",
    "mathutils",
    "gpu",
    "gpu_extras",
    "addon_utils",
    "bl_operators",
    "bl_ui",
    "bl_math",
    "idprop",
    "freestyle",
}
ADDON_MAY_IMPORT = BLENDER_MODULES | {"numpy", "pivot_core"} | sys.stdlib_module_names

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
EMBREE = re.compile(r'\brtc[A-Z]\w*|\bRTC[A-Z]\w*|#[ \t]*include[ \t]*[<"]embree')
EMBREE_FILES = {
    f"core/scene/{name}"
    for name in (
        "embree.h",
        "embree_curves.cpp",
        "inner_rays.cpp",
        "instance_bvhs.cpp",
        "instance_bvhs.h",
        "mesh_bvhs.cpp",
        "ray_tracer.cpp",
    )
}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def cpp_files(folder: Path) -> Iterator[Path]:
    return (path for path in sorted(folder.rglob("*")) if path.suffix in {".h", ".cpp"})


def code_of(path: Path) -> str:
    return COMMENT.sub("", path.read_text())


def core_folder(path: str) -> str:
    """`core/lights/sphere.h` -> `lights`."""
    return Path(path).parts[1]


def core_violations(root: Path) -> Iterator[str]:
    for path in cpp_files(root / "core"):
        where = path.relative_to(root).as_posix()
        own = core_folder(where)
        if own not in ROW_OF:
            yield f"{where}: {own} has no place in the order"
            continue
        for quote, target in INCLUDE.findall(code_of(path)):
            if quote == "<":
                if target.startswith(("pybind11/", "Python.h", "core/", "bindings/")):
                    yield f"{where} includes <{target}>"
            elif not target.startswith("core/"):
                yield f'{where} includes "{target}", which is not below core/'
            elif core_folder(target) != own and ROW_OF.get(core_folder(target), len(CORE_ROWS)) >= ROW_OF[own]:
                yield f'{where} includes "{target}", which comes later'


def bindings_violations(root: Path) -> Iterator[str]:
    for path in cpp_files(root / "bindings"):
        for quote, target in INCLUDE.findall(code_of(path)):
            if quote == '"' and not target.startswith(("core/", "bindings/")):
                yield f'{path.relative_to(root).as_posix()} includes "{target}"'


def embree_violations(root: Path) -> Iterator[str]:
    for folder in ("core", "bindings"):
        for path in cpp_files(root / folder):
            where = path.relative_to(root).as_posix()
            if where not in EMBREE_FILES and EMBREE.search(code_of(path)):
                yield f"{where} sees Embree"


def imported_modules(path: Path) -> Iterator[str]:
    """Top-level names of the absolute imports of a Python file, wherever in it they stand."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            yield node.module.partition(".")[0]


def python_violations(root: Path) -> Iterator[str]:
    for path in sorted((root / "addon").rglob("*.py")):
        for module in imported_modules(path):
            if module not in ADDON_MAY_IMPORT:
                yield f"{path.relative_to(root).as_posix()} imports {module}"
    for folder in ("bindings", "lut"):
        for path in sorted((root / folder).rglob("*.py")):
            for module in imported_modules(path):
                if module in BLENDER_MODULES | {"pivot", "addon"}:
                    yield f"{path.relative_to(root).as_posix()} imports {module}"


def violations(root: Path) -> list[str]:
    checks = (core_violations, bindings_violations, embree_violations, python_violations)
    return [violation for check in checks for violation in check(root)]


def test_this_tree_keeps_the_order() -> None:
    assert any(cpp_files(ROOT / "core"))
    assert violations(ROOT) == []


def test_core_tests_are_named_after_what_they_test() -> None:
    """A file or folder of core/, or one of the properties that the README lists."""
    known = {path.stem for path in (ROOT / "core").rglob("*")} | CORE_PROPERTIES
    names = {re.sub("^test_|_linear$|_table$", "", path.stem) for path in ROOT.glob("tests/core/test_*.py")}
    assert names - known == set()


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        ("core/math/vector.h", '#include "core/bsdf/ggx.h"', 'core/math/vector.h includes "core/bsdf/ggx.h"'),
        ("core/lights/sun.h", '  #  include "core/media/fog.h"', 'core/lights/sun.h includes "core/media/fog.h"'),
        (
            "core/scene/scene.h",
            '#include "core/render/session.h"',
            'core/scene/scene.h includes "core/render/session.h"',
        ),
        ("core/film/film.h", '#include "film.h"', 'core/film/film.h includes "film.h"'),
        ("core/film/film.h", "#include <pybind11/pybind11.h>", "core/film/film.h includes <pybind11/pybind11.h>"),
        ("core/film/film.cpp", '#include "bindings/register.h"', 'core/film/film.cpp includes "bindings/register.h"'),
        ("core/misc/odd.h", "", "core/misc/odd.h: misc has no place"),
        ("bindings/module.cpp", '#include "lut/fit.h"', 'bindings/module.cpp includes "lut/fit.h"'),
        (
            "core/integrators/path.cpp",
            "rtcOccluded1(s, c, r);",
            "core/integrators/path.cpp sees Embree",
        ),
        (
            "bindings/bind_scene.cpp",
            "#include <embree3/rtcore.h>",
            "bindings/bind_scene.cpp sees Embree",
        ),
        ("addon/engine.py", "def f():\n    import lut.fit", "addon/engine.py imports lut"),
        ("addon/engine.py", "from scipy import stats", "addon/engine.py imports scipy"),
        ("lut/fit.py", "import bpy", "lut/fit.py imports bpy"),
        (
            "bindings/pivot_core/__init__.py",
            "from pivot import engine",
            "bindings/pivot_core/__init__.py imports pivot",
        ),
    ],
)
def test_a_violation_is_found(tmp_path: Path, path: str, text: str, expected: str) -> None:
    sound = {
        "core/math/vector.h": "#include <cmath>",
        "core/scene/embree.h": '#include <embree3/rtcore.h>\n#include "core/math/vector.h"\n// "core/render/session.h"',
        "core/render/session.cpp": '#include "core/scene/embree.h"',
        "addon/export/mesh.py": "import bpy\nimport numpy as np\nimport pivot_core\nfrom . import scene",
    }
    for name, content in sound.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content)
    assert violations(tmp_path) == []
    (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / path).write_text(text)
    found = violations(tmp_path)
    assert len(found) == 1
    assert found[0].startswith(expected)
