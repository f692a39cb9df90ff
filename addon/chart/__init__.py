"""Speed charted against accuracy: a scene at a ladder of settings, for `./run chart` and for the panel's operator.

ladder: the settings. renderers, measure: pictures, their CPU seconds and errors, each kept once it is there.
canvas, pixels, plot: the chart. worker: all of it in a Blender of its own. job, operators: started from Blender's
interface.
"""
