"""Principled Hair and Hair BSDF as the core's lobes of a hair: core/bsdf/lobes/hair.h and strand.h."""

from __future__ import annotations

import math

from .lobe import Lobe
from .nodes import Owner, Socket, colour, is_linked, number
from .program import Program, Value
from .surface import Surface

# 1/radius of absorption, by concentration. [Cycles 4.5 closure/bsdf_hair_principled.h]
_EUMELANIN = (0.506, 0.841, 1.653)
_PHEOMELANIN = (0.343, 0.733, 1.924)


def principled_hair(feed: Socket, owner: Owner) -> Surface:
    """As Cycles has it after Chiang, whichever model is chosen. [Cycles 4.5 svm/closure.h]"""
    node, program = feed.node, owner.program
    if getattr(node, "model", "CHIANG") != "CHIANG":
        owner.warn(node, "Huang's model is not supported, it is shown as Chiang's")
    random = number(feed.input("Random"), owner) if is_linked(feed.input("Random")) else _random(program)
    uneven = 1.0 + 2.0 * (random - 0.5) * number(feed.input("Random Roughness"), owner).clamped()
    along = number(feed.input("Roughness"), owner) * uneven
    around = number(feed.input("Radial Roughness"), owner) * uneven
    primary = 1.0 - number(feed.input("Coat"), owner).clamped()
    clamped = along.at_least(0.001).at_most(1.0)
    shape = (
        ("absorption", _absorption(feed, owner, around, random).widened()),
        ("variance", _variance(clamped)),
        ("primary_variance", _variance((primary * clamped).at_least(0.001).at_most(1.0))),
        ("scale", _scale(around.at_least(0.001).at_most(1.0))),
        ("tilt_rad", number(feed.input("Offset"), owner)),
        ("ior", number(feed.input("IOR"), owner).at_least(1.0)),
    )
    lobe = Lobe("hair", (("color", program.colour((1, 1, 1))),), shape)
    return Surface.of(program, lobes=(lobe,), tangent=program.op("strand_tangent"))


def hair(feed: Socket, owner: Owner) -> Surface:
    """Hair BSDF, along the hair or along what is linked to its Tangent. [Cycles 4.5 svm/closure.h]

    On a mesh without a Tangent it lies along an edge of each triangle, and no Offset counts.
    """
    program, along = owner.program, feed.input("Tangent")
    is_told, tilt = is_linked(along), 0.0 - number(feed.input("Offset"), owner)
    shape = (
        ("transmits", program.number(float(feed.node.component == "Transmission"))),
        ("roughness_along", number(feed.input("RoughnessU"), owner).clamped()),
        ("roughness_around", number(feed.input("RoughnessV"), owner).clamped()),
        ("tilt_rad", tilt if is_told else tilt * program.op("is_strand")[0]),
    )
    lobe = Lobe("strand", (("color", colour(feed.input("Color"), owner).at_least(0.0).widened()),), shape)
    tangent = colour(along, owner) if is_told else program.op("hair_tangent")
    return Surface.of(program, lobes=(lobe,), tangent=tangent)


def _random(program: Program) -> Value:
    """Of each strand."""
    return program.op("attribute", settings=[program.attribute_id("strand:random"), 0.0])[0]


def _absorption(feed: Socket, owner: Owner, around: Value, random: Value) -> Value:
    program = owner.program
    if feed.node.parametrization == "ABSORPTION":
        return colour(feed.input("Absorption Coefficient"), owner).at_least(0.0)
    if feed.node.parametrization == "COLOR":
        return _absorption_of_color(colour(feed.input("Color"), owner), around)
    uneven = 1.0 + 2.0 * (random - 0.5) * number(feed.input("Random Color"), owner).clamped()
    melanin = (number(feed.input("Melanin"), owner) * uneven).clamped()
    concentration = 0.0 - _logarithm((1.0 - melanin).at_least(1e-4))
    redness = number(feed.input("Melanin Redness"), owner).clamped()
    pigments = (1.0 - redness) * program.colour(_EUMELANIN) + redness * program.colour(_PHEOMELANIN)
    return concentration * pigments + _absorption_of_color(colour(feed.input("Tint"), owner), around)


def _absorption_of_color(color: Value, around: Value) -> Value:
    """What makes much hair look so, about. [Chiang16 (9)]"""
    by_roughness = 5.969 + around * (-0.215 + around * (2.532 + around * (-10.73 + around * (5.574 + around * 0.245))))
    root = _logarithm(color.at_least(1e-5)) / by_roughness
    return root * root


def _logarithm(value: Value) -> Value:
    return value.program.each("math_logarithm", value, math.e)


def _variance(roughness: Value) -> Value:
    """[Chiang16 (7)]"""
    root = 0.726 * roughness + 0.812 * _power(roughness, 2) + 3.7 * _power(roughness, 20)
    return root * root


def _scale(roughness: Value) -> Value:
    """[Chiang16 (8)]"""
    unscaled = 0.265 * roughness + 1.194 * _power(roughness, 2) + 5.372 * _power(roughness, 22)
    return unscaled * math.sqrt(math.pi / 8)


def _power(value: Value, exponent: int) -> Value:
    return value.program.each("math_power", value, float(exponent))
