"""The mapping that texture nodes have of their own, which only files and scripts set.

Cycles knows no limits of it. [Cycles 4.5 scene/shader_nodes.cpp]
"""

from __future__ import annotations

import bpy
import mathutils
import numpy as np

from ..program import Value


def mapped(vector: Value, mapping: bpy.types.TexMapping) -> Value:
    matrix = _matrix(mapping)
    if not np.array_equal(matrix, np.eye(4)):
        program = vector.program
        rows = [
            sum((vector[i] * float(row[i]) for i in range(3)), start=program.number(float(row[3])))
            for row in matrix[:3]
        ]
        vector = program.joined(*rows)
    return vector.program.op("vector_normalize", vector) if mapping.vector_type == "NORMAL" else vector


def _matrix(mapping: bpy.types.TexMapping) -> np.ndarray:
    """(4, 4)"""
    kind = mapping.vector_type
    scale = np.array(mapping.scale, float)
    if kind in {"TEXTURE", "NORMAL"}:
        scale = np.where(np.abs(scale) < 1e-5, np.copysign(1e-5, scale), scale)
    turn = np.array(mathutils.Euler(mapping.rotation).to_matrix()) @ np.diag(scale)
    matrix = np.eye(4)
    matrix[:3, :3] = np.linalg.inv(turn).T if kind == "NORMAL" else turn
    if kind in {"TEXTURE", "POINT"}:
        matrix[:3, 3] = mapping.translation
    if kind == "TEXTURE":
        matrix = np.linalg.inv(matrix)
    choice = np.zeros((4, 4))
    choice[3, 3] = 1
    for row, axis in enumerate((mapping.mapping_x, mapping.mapping_y, mapping.mapping_z)):
        if axis != "NONE":
            choice[row, "XYZ".index(axis)] = 1
    return matrix @ choice
