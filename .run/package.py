"""Make what an artist installs, as zips: the extension for Blender 4.2 and later, the addon for Debian's Blender 3.4.

package.py ROOT PIVOT_CORE OUT PYTHON...   PYTHON is "3.11"; PIVOT_CORE, the folder, holds a build for each

The extension carries pivot_core as a wheel for each Python, with its libraries inside; the addon as a folder.
"""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

METADATA = "Metadata-Version: 2.1\nName: pivot-core\nVersion: {version}\nLicense: GPL-3.0-or-later\n"
WHEEL = "Wheel-Version: 1.0\nGenerator: pivot\nRoot-Is-Purelib: false\nTag: {tag}-{tag}-linux_x86_64\n"
BLENDERS = {"3.11": "Blender 4.2 to 5.0", "3.13": "Blender 5.1 to 5.3 and Debian 13's 4.3"}
# What manifest and file say when only one Python was at hand. Of another Python's Blender, Blender itself says so.
ONLY = {"3.11": 'blender_version_max = "5.1.0"', "3.13": 'blender_version_min = "4.3.0"'}
# Whose code is inside: by Debian's packages, which bring each licence.
CODE_OF = {
    "Embree": "libembree-dev",
    "oneTBB": "libtbb-dev",
    "GLM": "libglm-dev",
    "xsimd": "libxsimd-dev",
}
LIBRARIES = re.compile(r"lib(embree|tbb)")
THEIR_NAMES = re.compile(r"rtc[A-Z]|_Z.*3tbb|TBB_")


def tool(*arguments: str | Path) -> str:
    done = subprocess.run(arguments, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{Path(arguments[0]).name} failed: {' '.join(map(str, arguments))}")
    return done.stdout


def tree(source: Path, target: Path, *left_out: str) -> None:
    shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__", *left_out))


def name_apart(content: Path) -> None:
    """Give Embree's and TBB's functions names of their own in an unpacked wheel.

    A Blender that links another version of either has its functions in the process already, and the loader would let
    them answer the calls of ours: Debian 13's, with Embree 4, renders an empty scene then.
    """
    binaries, libraries = list(content.glob("pivot_core/*.so")), list(content.glob("pivot_core.libs/*"))
    unknown = [library.name for library in libraries if not LIBRARIES.match(library.name)]
    if unknown:
        sys.exit(f"no licence is packed for {', '.join(unknown)}: add its package to CODE_OF in .run/package.py")
    names = set()
    for library in libraries:
        symbols = tool("nm", "-D", "--defined-only", "-f", "posix", library).splitlines()
        names |= {line.split(maxsplit=1)[0].partition("@")[0] for line in symbols}
    renamed = content.parents[1] / "renamed.txt"
    renamed.write_text("".join(f"{name} pivot_{name}\n" for name in sorted(names) if THEIR_NAMES.match(name)))
    for binary in (*binaries, *libraries):
        tool("patchelf", "--rename-dynamic-symbols", renamed, binary)


def make_wheel(pivot_core: Path, version: str, python: str, out: Path) -> Path:
    """A manylinux wheel of what a render needs, Embree and TBB inside it; it stays unpacked in out/unpacked/ too."""
    tag = "cp" + python.replace(".", "")
    content = out / "plain"
    (content / "pivot_core").mkdir(parents=True)
    suffix = f".cpython-{tag[2:]}-x86_64-linux-gnu.so"
    for module in (pivot_core / f"_cpu{suffix}", *pivot_core.glob(f"_core_*{suffix}")):
        shutil.copy(module, content / "pivot_core")
    shutil.copy(pivot_core / "__init__.py", content / "pivot_core")
    info = content / f"pivot_core-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(METADATA.format(version=version))
    (info / "WHEEL").write_text(WHEEL.format(tag=tag))
    tool(sys.executable, "-m", "wheel", "pack", content, "-d", out)
    (plain,) = out.glob("*.whl")
    tool(sys.executable, "-m", "auditwheel", "repair", "--strip", plain, "-w", out / "repaired")
    (repaired,) = (out / "repaired").glob("*.whl")
    tool(sys.executable, "-m", "wheel", "unpack", repaired, "-d", out / "unpacked")
    (unpacked,) = (out / "unpacked").iterdir()
    name_apart(unpacked)
    tool(sys.executable, "-m", "wheel", "pack", unpacked, "-d", out / "repaired")
    return repaired


def add_licences(root: Path, folder: Path) -> None:
    shutil.copy(root / "LICENSE", folder)
    (folder / "licenses").mkdir()
    for name, package in CODE_OF.items():
        shutil.copy(f"/usr/share/doc/{package}/copyright", folder / f"licenses/{name}.txt")
    (pybind11,) = Path(sys.prefix).glob("lib/python*/site-packages/pybind11-*.dist-info/**/LICENSE")
    shutil.copy(pybind11, folder / "licenses/pybind11.txt")


def extension_manifest(manifest: str, wheels: list[Path], pythons: list[str]) -> str:
    names = ", ".join(f'"./wheels/{wheel.name}"' for wheel in wheels)
    if len(pythons) == 1:
        line = ONLY[pythons[0]]
        manifest = re.sub(rf"^{line.split()[0]} = .*\n", "", manifest, flags=re.MULTILINE) + line + "\n"
    return f"{manifest}wheels = [{names}]\n"


def main(root: Path, pivot_core: Path, out: Path, pythons: list[str]) -> None:
    shutil.rmtree(out, ignore_errors=True)
    manifest = (root / "addon/blender_manifest.toml").read_text()
    version = tomllib.loads(manifest)["version"]
    wheels = [make_wheel(pivot_core, version, python, out / python) for python in pythons]

    extension = out / "extension"
    tree(root / "addon", extension)
    add_licences(root, extension)
    (extension / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel, extension / "wheels")
    (extension / "blender_manifest.toml").write_text(extension_manifest(manifest, wheels, pythons))
    only = f"-python{pythons[0]}-only" if len(pythons) == 1 else ""
    made = shutil.make_archive(str(out / f"pivot-{version}{only}"), "zip", extension)
    print(f"Wrote {made}: for {', '.join(BLENDERS[python] for python in pythons)}")

    if "3.11" in pythons:
        addon = out / "addon/pivot"
        tree(root / "addon", addon, "blender_manifest.toml")
        add_licences(root, addon)
        (unpacked,) = (out / "3.11/unpacked").iterdir()
        for folder in ("pivot_core", "pivot_core.libs"):
            tree(unpacked / folder, addon / folder)
        made = shutil.make_archive(str(out / f"pivot-{version}-blender3.4"), "zip", addon.parent)
        print(f"Wrote {made}: for Debian 12's Blender 3.4")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:4]), sys.argv[4:])
