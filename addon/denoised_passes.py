"""Light passes and light groups that sum to the picture without noise, as they did to the noisy one.

Each part is denoised by itself, and no denoiser leaves sums what they were; then the parts are scaled, pixel by pixel,
to what they are to sum to. Noise that is left in one so only moves light between the parts.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import numpy as np

from .denoise import Denoiser, Pixels

# Light by what reflected it, and the colours that it is stored without.
_DIRECT = {"DiffDir": "Diffuse Color", "GlossDir": "GlossCol", "TransDir": "TransCol"}
_INDIRECT = {"DiffInd": "Diffuse Color", "GlossInd": "GlossCol", "TransInd": "TransCol"}
_COLORS = _DIRECT | _INDIRECT
_OTHER_DIRECT, _OTHER_INDIRECT = ("Emit", "Env", "VolumeDir"), ("VolumeInd",)

Read = Callable[[str], Pixels]
Shared = Callable[[Mapping[str, Pixels], Pixels, Mapping[str, Pixels]], dict[str, Pixels]]


def denoised_passes(
    denoiser: Denoiser, mode: str, read: Read, wanted: Collection[str], groups: Collection[str]
) -> dict[str, Pixels]:
    """Combined without noise, (height, width, 4), and what is wanted of passes that sum to it, by the core's names.

    mode, read: as of Denoiser.denoised; read takes groups, passes of light groups, too. Raises DenoiserError.
    """
    guides = denoiser.guides(read)
    combined = denoiser.denoised(mode, read, guides)
    noisy, clean = read("Combined")[..., :3], combined[..., :3]
    passes = {"Combined": combined}

    def shared(parts: Mapping[str, Pixels], total: Pixels, colors: Mapping[str, Pixels]) -> dict[str, Pixels]:
        """What each part has of the total: of those with a colour nothing where that is black."""
        cleaned = {name: denoiser.light(part, guides) for name, part in parts.items()}
        for name in cleaned.keys() & colors.keys():
            cleaned[name] = np.where(colors[name] != 0, cleaned[name], 0)
        factor = _over(total, _sum(cleaned))
        return {name: part * factor for name, part in cleaned.items()}

    if "Indirect" in wanted:
        indirect = read("Indirect")
        direct = noisy - indirect
        if mode == "ALL":
            passes["Indirect"] = shared({"direct": direct, "Indirect": indirect}, clean, {})["Indirect"]
        else:
            passes["Indirect"] = clean - direct
    if not wanted.isdisjoint(_COLORS):
        passes |= _light_passes(mode, read, clean, shared)
    if groups:
        light = {group: read(group) for group in groups}
        light["of no group"] = np.maximum(noisy - _sum(light), 0)
        of_groups = shared(light, clean, {})
        passes |= {group: of_groups[group] for group in groups}
    return passes


def _light_passes(mode: str, read: Read, clean: Pixels, shared: Shared) -> dict[str, Pixels]:
    color_of = {name: read(name) for name in {*_COLORS.values()}}
    colors = {name: color_of[color] for name, color in _COLORS.items()}

    def light_of(names: Collection[str]) -> dict[str, Pixels]:
        return {name: read(name) * colors[name] if name in colors else read(name) for name in names}

    direct, indirect = light_of((*_DIRECT, *_OTHER_DIRECT)), light_of((*_INDIRECT, *_OTHER_INDIRECT))
    if mode == "ALL":
        light = shared(direct | indirect, clean, colors)
    else:
        light = direct | shared(indirect, clean - _sum(direct), colors)
    # What the denoiser smears over the edge of what reflects has no colour there that it could go by.
    lost = clean - _sum(light)
    light["Emit"] = light["Emit"] + np.where(np.abs(lost) > 1e-5 * np.abs(clean), lost, 0)
    return {name: _over(part, colors[name]) if name in colors else part for name, part in light.items()}


def _sum(parts: Mapping[str, Pixels]) -> Pixels:
    return sum(parts.values(), np.zeros_like(next(iter(parts.values()))))


def _over(numerator: Pixels, denominator: Pixels) -> Pixels:
    """0 where there is nothing to divide by."""
    return np.divide(numerator, denominator, out=np.zeros_like(numerator), where=denominator != 0)
