"""Make the Blender extension: the addon's folder with pivot_core as a wheel that carries its libraries, zipped.

package.py ADDON PIVOT_CORE OUT   writes OUT/pivot-VERSION.zip
"""

import shutil
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path

METADATA = "Metadata-Version: 2.1\nName: pivot-core\nVersion: {version}\nLicense: GPL-3.0-or-later\n"
WHEEL = "Wheel-Version: 1.0\nGenerator: pivot\nRoot-Is-Purelib: false\nTag: {tag}\n"


def make_wheel(pivot_core: Path, version: str, out: Path) -> Path:
    """A manylinux wheel of the built package, Embree and TBB inside it."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    content = out / "content"
    shutil.copytree(pivot_core, content / "pivot_core", ignore=shutil.ignore_patterns("__pycache__"))
    info = content / f"pivot_core-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(METADATA.format(version=version))
    platform = sysconfig.get_platform().replace("-", "_")
    (info / "WHEEL").write_text(WHEEL.format(tag=f"{python}-{python}-{platform}"))
    subprocess.run([sys.executable, "-m", "wheel", "pack", content, "-d", out], check=True)
    (plain,) = out.glob("*.whl")
    subprocess.run([sys.executable, "-m", "auditwheel", "repair", plain, "-w", out / "repaired"], check=True)
    (wheel,) = (out / "repaired").glob("*.whl")
    return wheel


def main(addon: Path, pivot_core: Path, out: Path) -> None:
    shutil.rmtree(out, ignore_errors=True)
    manifest = (addon / "blender_manifest.toml").read_text()
    version = tomllib.loads(manifest)["version"]
    extension = out / "pivot"
    shutil.copytree(addon, extension, ignore=shutil.ignore_patterns("__pycache__"))
    (extension / "wheels").mkdir()
    wheel = shutil.copy(make_wheel(pivot_core, version, out), extension / "wheels")
    top, table, rest = manifest.partition("\n[")  # wheels is a top-level key: it stands before the first table
    wheels = f'\nwheels = ["./wheels/{Path(wheel).name}"]\n'
    (extension / "blender_manifest.toml").write_text(top.rstrip("\n") + wheels + table + rest)
    print(shutil.make_archive(str(out / f"pivot-{version}"), "zip", extension))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:4]))
