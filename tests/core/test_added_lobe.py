"""A lobe is added by a file of its own and a row of the list in core/bsdf/lobe.h: so added_lobe.h is, in a copy of it;
then added_lobe.cpp evaluates and samples a surface that has it beside its base."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pivot_core
import pytest

from tests.core.chi_squared import chi_squared_p, expected_share

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
COLOR, EXPONENT = np.array([0.6, 0.3, 0.1]), 6.0
VIEWS_RAD = (0.0, 0.5, 0.9)
UP = np.array([0.0, 0.0, 1.0])
RINGS, AZIMUTHS = np.linspace(0, 1, 13), 12  # of the upper hemisphere
ANSWER = np.dtype(
    [("eval_base", "f4", 3), ("eval", "f4", 3), ("pdf_omega", "f4"), ("albedo", "f4"), ("sample", "f4", 3)]
)

Array = npt.NDArray[np.float64]


def compile_command(source: str) -> list[str]:
    """The compiler and flags with which the build that is loaded compiles a file, without file names."""
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        if entry["file"] == str(ROOT / source) and f"-march=x86-64-{pivot_core.arch}" in words:
            return words[: words.index("-o")]
    raise LookupError(f"{BUILD} does not compile {source} for {pivot_core.arch}")


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Compiled with the build's flags and warnings as errors, linked with the build's core: of its files only
    surface.cpp, which reads the list, is compiled anew."""
    overlay = tmp_path_factory.mktemp("overlay")
    lobes = overlay / "core/bsdf/lobes"
    lobes.mkdir(parents=True)
    (lobes / "added_lobe.h").write_text((ROOT / "tests/core/added_lobe.h").read_text())
    kinds = (ROOT / "core/bsdf/lobe.h").read_text()
    first_lobe = '#include "core/bsdf/lobes/'
    kinds = kinds.replace(first_lobe, f'{first_lobe}added_lobe.h"\n{first_lobe}', 1)
    kinds, rows = re.subn(r"(using LobeKinds =\s+std::tuple<[^;]*)>;", r"\1, Minnaert<T>>;", kinds)
    assert rows == 1
    (lobes.parent / "lobe.h").write_text(kinds)

    compiler, *flags = compile_command("core/bsdf/surface.cpp")
    sources = [ROOT / "tests/core/added_lobe.cpp", ROOT / "core/bsdf/surface.cpp"]
    made, library = overlay / "added_lobe", BUILD / f"libpivot_{pivot_core.arch}.a"
    command = [compiler, f"-I{overlay}", *flags, "-Werror", *sources, library, "-ltbb", "-o", made]
    ran = subprocess.run(command, cwd=BUILD, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return made


def direction(theta: float) -> Array:
    return np.array([np.sin(theta), 0.0, np.cos(theta)])


def answers(program: Path, theta: float, wi: Array, u: Array) -> npt.NDArray[np.void]:
    """Of light from wi (n, 3), and of samples by u (n, 3) where those are: (n,), by floats and by batches alike."""
    queries = np.concatenate([np.broadcast_to(direction(theta), wi.shape), wi, u], 1).astype(np.float32)
    ran = subprocess.run(
        [program, *map(str, (*COLOR, EXPONENT))], input=queries.tobytes(), capture_output=True, check=True
    )
    by_float, by_batch = np.frombuffer(ran.stdout, ANSWER).reshape(2, len(wi))
    for name in ANSWER.names or ():
        np.testing.assert_allclose(by_batch[name], by_float[name], rtol=1e-4, atol=1e-5)
    return by_float


def seen(program: Path, theta: float, wi: Array) -> npt.NDArray[np.void]:
    """The same for directions (..., 3) alone."""
    flat = wi.reshape(-1, 3)
    return answers(program, theta, flat, np.zeros_like(flat)).reshape(wi.shape[:-1])


@pytest.mark.parametrize("theta", VIEWS_RAD)
def test_it_is_evaluated_beside_the_base(program: Path, theta: float) -> None:
    """By [Minnaert41]'s formula, on the side that it reflects to and on the other."""
    wi = np.random.default_rng(1).normal(size=(1000, 3))
    wi /= np.linalg.norm(wi, axis=1, keepdims=True)
    found = seen(program, theta, wi)
    cos_i, cos_o = np.maximum(wi[:, 2:], 0), np.cos(theta)
    lobe = COLOR * (EXPONENT + 1) / (2 * np.pi) * (cos_i * cos_o) ** (EXPONENT - 1) * cos_i
    assert found["eval_base"].max() > 0.05 < lobe.max()
    np.testing.assert_allclose(found["eval"], found["eval_base"] + lobe, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("theta", VIEWS_RAD)
def test_samples_follow_the_density(program: Path, theta: float) -> None:
    u = np.random.default_rng(2).random((200_000, 3))
    samples = answers(program, theta, np.broadcast_to(UP, u.shape), u)["sample"].astype(float)
    p = chi_squared_p(samples, lambda wi: seen(program, theta, wi)["pdf_omega"].astype(float), UP, RINGS, AZIMUTHS)
    assert p > 1e-4


@pytest.mark.parametrize("theta", VIEWS_RAD)
def test_its_albedo_is_its_integral(program: Path, theta: float) -> None:
    def lobe(wi: Array) -> Array:
        found = seen(program, theta, wi)
        return (found["eval"].astype(float) - found["eval_base"]).mean(-1)

    says = seen(program, theta, UP[None])["albedo"]
    np.testing.assert_allclose(says, expected_share(lobe, UP, RINGS, AZIMUTHS).sum(), rtol=1e-3)
