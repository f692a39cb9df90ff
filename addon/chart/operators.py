"""The panel's button "Chart Speed vs Accuracy", and the one that takes over what the chart suggests."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty, FloatProperty, PointerProperty, StringProperty

from .errors import Row, cheapest_within
from .job import ChartJob
from .ladder import LADDERS
from .measure import rows_from_json, rows_to_json

_POLL_S = 0.5


class PivotChart(bpy.types.PropertyGroup):
    """Of the window manager, for it is not saved: the chart in the making, and what the last one measured."""

    progress: FloatProperty(name="Charting", min=0.0, max=100.0, default=-1.0, subtype="PERCENTAGE")
    doing: StringProperty()
    rows: StringProperty()  # JSON
    scene: StringProperty()  # that was charted

    @property
    def is_running(self) -> bool:
        return bool(self.doing)

    def suggestion(self, scene: bpy.types.Scene) -> Row | None:
        """The cheapest setting that meets the scene's error budget in its last chart."""
        if not self.rows or self.scene != scene.name:
            return None
        return cheapest_within(rows_from_json(self.rows), scene.pivot.error_budget)


def describe(row: Row) -> str:
    what = row.rung.label if "%" in row.rung.label else f"{row.rung.samples} samples"
    return f"{row.rung.method}, {what}: {row.error_percent:.2g} % error"


def open_image(context: bpy.types.Context, path: str) -> bpy.types.Image:
    """Load the picture, packed, and show it in the Image Editor if one is open."""
    image = bpy.data.images.load(path)
    image.name = "Speed vs Accuracy"
    image.pack()
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                area.spaces.active.image = image
                return image
    return image


class PIVOT_OT_chart(bpy.types.Operator):
    """Render this scene small by every method, in the background, and chart each one's time against its error"""

    bl_idname = "pivot.chart"
    bl_label = "Chart Speed vs Accuracy"

    ladder: EnumProperty(
        name="Ladder",
        items=[(name, name.title(), "") for name in LADDERS],
        default="PANEL",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return not context.window_manager.pivot_chart.is_running

    def execute(self, context: bpy.types.Context) -> set[str]:
        """From a script: to the end."""
        self._start(context)
        self._job.wait()
        return self._finish(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self._start(context)
        self._timer = context.window_manager.event_timer_add(_POLL_S, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        chart = context.window_manager.pivot_chart
        if event.type == "ESC" or not chart.is_running:  # the panel's Cancel empties `doing`
            self.cancel(context)
            self.report({"INFO"}, "Pivot: charting was cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if self._job.done():
            context.window_manager.event_timer_remove(self._timer)
            return self._finish(context)
        share, chart.doing = self._job.progress()
        chart.progress = 100 * share
        _redraw(context)
        return {"PASS_THROUGH"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Also called when Blender quits."""
        context.window_manager.event_timer_remove(self._timer)
        self._job.cancel()
        self._end(context)

    def _start(self, context: bpy.types.Context) -> None:
        self._job = ChartJob(self.ladder)
        chart = context.window_manager.pivot_chart
        chart.progress, chart.doing = 0.0, "starting"

    def _end(self, context: bpy.types.Context) -> None:
        context.window_manager.pivot_chart.doing = ""
        _redraw(context)

    def _finish(self, context: bpy.types.Context) -> set[str]:
        self._end(context)
        try:
            rows = self._job.rows()
        except RuntimeError as error:
            self.report({"ERROR"}, f"Pivot: the chart failed: {error}")
            return {"CANCELLED"}
        chart = context.window_manager.pivot_chart
        chart.rows, chart.scene = rows_to_json(rows), context.scene.name
        open_image(context, str(self._job.chart))
        return {"FINISHED"}


class PIVOT_OT_chart_cancel(bpy.types.Operator):
    """Stop charting"""

    bl_idname = "pivot.chart_cancel"
    bl_label = "Cancel"

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.window_manager.pivot_chart.doing = ""
        return {"FINISHED"}


class PIVOT_OT_chart_apply(bpy.types.Operator):
    """Take over the charted setting that is the cheapest within the error budget"""

    bl_idname = "pivot.chart_apply"
    bl_label = "Apply"
    bl_options = frozenset({"REGISTER", "UNDO"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.window_manager.pivot_chart.suggestion(context.scene) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        row = context.window_manager.pivot_chart.suggestion(context.scene)
        if row is None:
            return {"CANCELLED"}
        pivot = context.scene.pivot
        pivot.samples = row.rung.samples
        for name, value in row.rung.settings.items():
            setattr(pivot, name, value)
        return {"FINISHED"}


def draw(layout: Any, context: bpy.types.Context) -> None:
    """The panel's lines."""
    chart = context.window_manager.pivot_chart
    if chart.is_running:
        row = layout.row()
        row.label(text=f"{chart.progress:.0f} %  {chart.doing}", icon="TIME")
        row.operator("pivot.chart_cancel", icon="X")
        return
    layout.operator("pivot.chart", icon="GRAPH")
    if not chart.rows or chart.scene != context.scene.name:
        return
    suggestion = chart.suggestion(context.scene)
    lines = layout.column(align=True)
    budget = f"{context.scene.pivot.error_budget:.2g} %"
    if suggestion is None:
        lines.label(text=f"No setting charted meets {budget}", icon="INFO")
    else:
        lines.label(text=f"Direct light, for {budget} or less:", icon="INFO")
        lines.label(text=describe(suggestion))
        lines.operator("pivot.chart_apply")


def _redraw(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "PROPERTIES":
                area.tag_redraw()


_CLASSES = (PivotChart, PIVOT_OT_chart, PIVOT_OT_chart_cancel, PIVOT_OT_chart_apply)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.pivot_chart = PointerProperty(type=PivotChart)


def unregister() -> None:
    del bpy.types.WindowManager.pivot_chart
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
