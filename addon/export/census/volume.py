"""Volume objects."""

from __future__ import annotations

from .table import Table

VOLUME = {
    "Volume": Table(
        used="""
        filepath is_sequence frame_start frame_duration frame_offset sequence_mode grids materials animation_data
        """,
        parts="render",
        # The viewport's, a packed file, which is reported as missing, and what motion blur takes.
        no_meaning="""
        display packed_file velocity_grid velocity_unit velocity_scale velocity_x_grid velocity_y_grid velocity_z_grid
        """,
    ),
    "VolumeRender": Table(
        used="space",
        # How finely Cycles keeps and steps through grids: Pivot keeps what the file has.
        no_meaning="precision step_size clipping",
    ),
}
