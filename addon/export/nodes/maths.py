"""Nodes that reckon with numbers and vectors."""

from __future__ import annotations

from ..program import Value
from .row import Node, Row


def _math(node: Node) -> Value:
    op = f"math_{node.node.operation.lower()}"
    value = node.op(op, *(node.number(index) for index in range(node.program.input_count(op))))
    return value.clamped() if node.node.use_clamp else value


def _vector_math(node: Node) -> Value:
    operation = node.node.operation
    op = f"vector_{operation.lower()}"
    if op not in node.program.ops:  # it is that of Math on each part
        op = "math_fract" if operation == "FRACTION" else f"math_{operation.lower()}"
        return node.program.each(op, *(node.vector(index) for index in range(node.program.input_count(op))))
    if operation in {"SCALE", "REFRACT"}:
        vectors = [node.vector(index) for index in range(1 if operation == "SCALE" else 2)]
        return node.op(op, *vectors, node.number("Scale"))
    return node.op(op, *(node.vector(index) for index in range(node.program.input_count(op) // 3)))


def _clamp(node: Node) -> Value:
    op = f"clamp_{node.node.clamp_type.lower()}"
    return node.op(op, *(node.number(name) for name in ("Value", "Min", "Max")))


def _map_range(node: Node) -> Value:
    kind = node.node.interpolation_type.lower()
    program = node.program
    if node.node.data_type == "FLOAT_VECTOR":
        names = ("Vector", "From_Min_FLOAT3", "From_Max_FLOAT3", "To_Min_FLOAT3", "To_Max_FLOAT3")
        op, inputs = f"map_range_vector_{kind}", [node.vector(name) for name in names]
        steps = node.vector("Steps_FLOAT3") if kind == "stepped" else program.number(0)
    else:
        names = ("Value", "From Min", "From Max", "To Min", "To Max")
        op, inputs = f"map_range_{kind}", [node.number(name) for name in names]
        steps = node.number("Steps") if kind == "stepped" else program.number(0)
    mapped = program.each(op, *inputs, steps)
    return program.each("clamp_range", mapped, *inputs[3:]) if node.node.clamp else mapped


Matrix = tuple[Value, Value, Value]  # by row


def _rows(matrix: Value) -> Matrix:
    return matrix[0:3], matrix[3:6], matrix[6:9]


def _transposed(rows: Matrix) -> Matrix:
    x, y, z = (rows[0].program.joined(*(row[i] for row in rows)) for i in range(3))
    return x, y, z


def _transformed(vector: Value, rows: Matrix, offset: Value) -> Value:
    return vector.program.op("transform", vector, *rows, offset)


def _vector_rotate(node: Node) -> Value:
    kind, program = node.node.rotation_type, node.program
    if kind == "EULER_XYZ":
        rows = _rows(node.op("euler_rotation", node.vector("Rotation")))
    else:
        axes = {"X_AXIS": (1, 0, 0), "Y_AXIS": (0, 1, 0), "Z_AXIS": (0, 0, 1)}
        axis = program.colour(axes[kind]) if kind in axes else node.vector("Axis")
        rows = _rows(node.op("axis_rotation", axis, node.number("Angle")))
    if node.node.invert:
        rows = _transposed(rows)
    center, none = node.vector("Center"), program.colour((0, 0, 0))
    return _transformed(node.vector("Vector"), rows, center - _transformed(center, rows, none))


def _mapping(node: Node) -> Value:
    """A rotation that the scale and the location are made part of: one step where only the vector varies."""
    kind, vector, scale = node.node.vector_type, node.vector("Vector"), node.vector("Scale")
    none = node.program.colour((0, 0, 0))
    rows = _rows(node.op("euler_rotation", node.vector("Rotation")))
    if kind == "TEXTURE":
        x, y, z = (row * (1.0 / scale[i]) for i, row in enumerate(_transposed(rows)))
        return _transformed(vector, (x, y, z), 0.0 - _transformed(node.vector("Location"), (x, y, z), none))
    if kind == "NORMAL":
        scale = 1.0 / scale
    x, y, z = (row * scale for row in rows)
    mapped = _transformed(vector, (x, y, z), node.vector("Location") if kind == "POINT" else none)
    return node.op("vector_normalize", mapped) if kind == "NORMAL" else mapped


def _normal(node: Node) -> Value:
    """The direction that its first output is set to, or the cosine to it."""
    direction = node.op("vector_normalize", node.program.colour(node.node.outputs[0].default_value))
    if node.output == "Normal":
        return direction
    return node.op("vector_dot_product", direction, node.op("vector_normalize", node.vector("Normal")))


ROWS: dict[str, Row] = {
    "MATH": _math,
    "VECT_MATH": _vector_math,
    "COMBXYZ": lambda node: node.program.joined(*(node.number(index) for index in range(3))),
    "SEPXYZ": lambda node: node.vector("Vector")[node.output_index],
    "CLAMP": _clamp,
    "MAP_RANGE": _map_range,
    "VECTOR_ROTATE": _vector_rotate,
    "MAPPING": _mapping,
    "NORMAL": _normal,
}
