"""Light passes and light groups that sum to the picture without noise, as they did to the noisy one.

Each part is denoised by itself, and no denoiser leaves sums what they were; then the parts are scaled, pixel by pixel,
to what they are to sum to. Noise that is left in one so only moves light between the parts.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import numpy as np

from .denoise import Denoised, Denoiser, Pixels

# Light by what reflected it, and the colours that it is stored without.
_DIRECT = {"DiffDir": "Diffuse Color", "GlossDir": "GlossCol", "TransDir": "TransCol"}
_INDIRECT = {"DiffInd": "Diffuse Color", "GlossInd": "GlossCol", "TransInd": "TransCol"}
_COLORS = _DIRECT | _INDIRECT
_OTHER_DIRECT, _OTHER_INDIRECT = ("Emit", "Env", "VolumeDir"), ("VolumeInd",)

Read = Callable[[str], Pixels]
Parts = Mapping[str, Pixels]


def denoised_passes(
    denoiser: Denoiser, mode: str, read: Read, wanted: Collection[str], groups: Collection[str]
) -> dict[str, Pixels]:
    """Combined without noise, (height, width, 4), and what is wanted of passes that sum to it, by the core's names.

    mode, read: as of Denoiser.denoised; read takes groups, passes of light groups, too. Raises DenoiserError.
    """
    guides = denoiser.guides(read)
    picture = denoiser.denoised(mode, read, guides)
    noisy, clean = read("Combined")[..., :3], picture.combined[..., :3]
    passes = {"Combined": picture.combined, "Indirect": picture.indirect}

    def shared(total: Pixels, parts: Parts, colors: Parts, kept: Pixels | float = 0.0) -> dict[str, Pixels]:
        """What each part has of the total: of those with a colour nothing where that is black. kept: how much of a part
        is to be as it is, noise and all."""
        mixed = dict(parts)
        if not np.all(kept == 1):
            for name, part in parts.items():
                mixed[name] = kept * part + (1 - kept) * denoiser.light(part, guides)
        for name in mixed.keys() & colors.keys():
            mixed[name] = np.where(colors[name] != 0, mixed[name], 0)
        factor = _over(total, _sum(mixed))
        return {name: part * factor for name, part in mixed.items()}

    if not wanted.isdisjoint(_COLORS):
        passes |= _light_passes(read, picture, shared)
    if groups:
        light = {group: read(group) for group in groups}
        light["of no group"] = np.maximum(noisy - _sum(light), 0)
        of_groups = shared(clean, light, {})
        passes |= {group: of_groups[group] for group in groups}
    return passes


def _light_passes(read: Read, picture: Denoised, shared: Callable[..., dict[str, Pixels]]) -> dict[str, Pixels]:
    color_of = {name: read(name) for name in {*_COLORS.values()}}
    colors = {name: color_of[color] for name, color in _COLORS.items()}

    def light_of(names: Collection[str]) -> dict[str, Pixels]:
        return {name: read(name) * colors[name] if name in colors else read(name) for name in names}

    clean = picture.combined[..., :3]
    direct, indirect = light_of((*_DIRECT, *_OTHER_DIRECT)), light_of((*_INDIRECT, *_OTHER_INDIRECT))
    light = shared(picture.indirect, indirect, colors)
    light |= shared(clean - picture.indirect, direct, colors, picture.direct_kept)
    # What the denoiser smears over the edge of what reflects has no colour there that it could go by.
    lost = clean - _sum(light)
    light["Emit"] = light["Emit"] + np.where(np.abs(lost) > 1e-5 * np.abs(clean), lost, 0)
    return {name: _over(part, colors[name]) if name in colors else part for name, part in light.items()}


def _sum(parts: Parts) -> Pixels:
    return sum(parts.values(), np.zeros_like(next(iter(parts.values()))))


def _over(numerator: Pixels, denominator: Pixels) -> Pixels:
    """0 where there is nothing to divide by."""
    return np.divide(numerator, denominator, out=np.zeros_like(numerator), where=denominator != 0)
