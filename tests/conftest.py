"""NumPy 2's type promotion throughout: bpy 4.5 needs NumPy 1, where a float32 scalar by a Python float is float64."""

import numpy as np

if np.lib.NumpyVersion(np.__version__) < "2.0.0":
    np._set_promotion_state("weak")
