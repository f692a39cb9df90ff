"""Every oracle case, in float64 and float32, against its tolerance.

PIVOT_ORACLES=FILE runs another file of the same format. The formulas are dicts FORMULAS in oracle_formulas_*.py beside
this file: name -> fn(inputs, dtype) -> {output: value}, `inputs` already cast to `dtype`.

Errors follow the file's own metric: vectors by |a - b|; ABSOLUTE outputs by |a - b|; areas of two_cap_area by |a - b|
over the smaller cap's area; all else relative to the expected value, or absolute where that is 0.

Tolerances: `tol64` and `tol32`, a number or one per output, and then just these outputs are compared. A case without is
compared in all outputs: float64 within `ref_err`, float32 within the larger of `ref_err` and FLOAT32_RELATIVE, the
bound the project states for float32.

Rounding the inputs to float32 can by itself move a result by more than `tol32`: no code sees the bits that are gone. So
a float32 result passes within tolerance of the expected value, or of the float64 result for the same rounded inputs.
"""

import importlib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

HERE = Path(__file__).parent
ABSOLUTE = {"cos_psi", "mean_cosine", "cdf"}
FLOAT32_RELATIVE = 1e-4

Formula = Callable[[dict[str, Any], type], dict[str, Any]]


def load_formulas() -> dict[str, Formula]:
    formulas: dict[str, Formula] = {}
    for file in sorted(HERE.glob("oracle_formulas_*.py")):
        module = importlib.import_module(f"{__package__}.{file.stem}" if __package__ else file.stem)
        assert not formulas.keys() & module.FORMULAS.keys(), f"{file.name} repeats a formula"
        formulas |= module.FORMULAS
    return formulas


FORMULAS = load_formulas()
CASES = json.loads(Path(os.environ.get("PIVOT_ORACLES", HERE / "oracles.json")).read_text())["cases"]


def cast(value: Any, dtype: type) -> Any:
    """Numbers and nested lists of numbers as arrays of `dtype`; names stay."""
    return value if isinstance(value, str) else np.asarray(value, dtype)


def error(case: dict[str, Any], output: str, actual: Any, expected: Any) -> float:
    expected = np.asarray(expected, np.float64)
    actual = np.asarray(actual, np.float64)
    assert actual.shape == expected.shape, f"{output}: shape {actual.shape}, expected {expected.shape}"
    difference = float(np.linalg.norm(actual - expected))
    if case["formula"] == "two_cap_area":
        return difference / case["expected"]["smaller_cap_area"]
    if expected.ndim or output in ABSOLUTE or case["formula"] == "ortho_corner" or expected == 0:
        return difference
    return difference / abs(float(expected))


def tolerances(case: dict[str, Any], dtype: type) -> dict[str, float]:
    """Of every output that is compared: those with a tolerance, or all where the case gives none."""
    given = case.get("tol32" if dtype is np.float32 else "tol64")
    if isinstance(given, dict):
        return given
    if given is None:
        given = max(case["ref_err"], FLOAT32_RELATIVE) if dtype is np.float32 else case["ref_err"]
    return dict.fromkeys(case["expected"], given)


def evaluate(case: dict[str, Any], rounding: type, dtype: type) -> dict[str, np.ndarray]:
    """The case's outputs for its inputs rounded to `rounding`, computed in `dtype`."""
    inputs = {name: cast(cast(value, rounding), dtype) for name, value in case["inputs"].items()}
    outputs = {name: np.asarray(value) for name, value in FORMULAS[case["formula"]](inputs, dtype).items()}
    for name, value in outputs.items():
        assert value.dtype in (dtype, np.bool_), f"{name} is {value.dtype}"
    return outputs


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_oracle(case: dict[str, Any], dtype: type) -> None:
    assert case["formula"] in FORMULAS, f"no implementation of {case['formula']}"
    outputs = evaluate(case, dtype, dtype)
    for name, tolerance in tolerances(case, dtype).items():
        value, expected = outputs[name], case["expected"][name]
        if error(case, name, value, expected) <= tolerance:
            continue
        message = f"{name}: {value}, expected {expected}"
        assert dtype is np.float32, message
        of_rounded = evaluate(case, np.float32, np.float64)[name]
        assert error(case, name, value, of_rounded) <= tolerance, f"{message}, {of_rounded} of the rounded inputs"
