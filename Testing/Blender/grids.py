# SPDX-License-Identifier: BSD-3-Clause
"""In Blender: prints as JSON what it finds in a volume: blender -b --python grids.py -- CLOUDS.vdb."""
import json
import sys

import bpy

bpy.ops.object.volume_import(filepath=sys.argv[-1])
volume = bpy.context.object
grids = volume.data.grids
assert grids.load(), grids.error_message
print("FOUND", json.dumps({"grids": {grid.name: grid.data_type for grid in grids}, "box": [list(corner) for corner in volume.bound_box]}))
