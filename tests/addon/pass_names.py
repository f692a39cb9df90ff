"""Passes by the names that they had before Blender 5.0, and light passes times their colours."""

from __future__ import annotations

import numpy as np

Passes = dict[str, np.ndarray]  # (height, width, channels)

LIGHT = {
    f"{kind}{part}": f"{kind}Col" for kind in ("Diff", "Gloss", "Trans") for part in ("Dir", "Ind")
}  # and what it is to be multiplied by
_OLD = {
    "Diffuse Direct": "DiffDir",
    "Diffuse Indirect": "DiffInd",
    "Diffuse Color": "DiffCol",
    "Glossy Direct": "GlossDir",
    "Glossy Indirect": "GlossInd",
    "Glossy Color": "GlossCol",
    "Transmission Direct": "TransDir",
    "Transmission Indirect": "TransInd",
    "Transmission Color": "TransCol",
    "Emission": "Emit",
    "Environment": "Env",
    "Ambient Occlusion": "AO",
    "Object Index": "IndexOB",
    "Material Index": "IndexMA",
}


def with_old_names(passes: Passes) -> Passes:
    return {_OLD.get(name, name): values for name, values in passes.items()}


def colored(passes: Passes, name: str) -> np.ndarray:
    """Light times its colour: alone it has no meaning where a pixel sees little of what reflects it."""
    return passes[name] * passes[LIGHT[name]] if name in LIGHT else passes[name]
