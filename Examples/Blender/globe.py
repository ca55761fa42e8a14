# SPDX-License-Identifier: BSD-3-Clause
"""A globe of clouds in Blender's Cycles: blender -b --factory-startup --python globe.py -- CLOUDS.vdb PICTURE.png [WIDTH SAMPLES]."""
import math
import sys

import bpy

volume, picture, width, samples = (sys.argv[sys.argv.index("--") + 1:] + ["480", "32"])[:4]
scene = bpy.context.scene
for name in ("Cube", "Light", "Camera"):
    bpy.data.objects.remove(bpy.data.objects[name])

bpy.ops.object.volume_import(filepath=volume)
clouds = bpy.context.object
clouds.scale = (1e-6,) * 3  # a unit is 1000 km
clouds.data.render.clipping = 0  # extinctions in 1/m are small numbers, which would count as empty

fog = bpy.data.materials.new("Clouds")
fog.use_nodes = True
nodes = fog.node_tree.nodes
nodes.clear()
scatter = nodes.new("ShaderNodeVolumePrincipled")
scatter.inputs["Color"].default_value = (1, 1, 1, 1)
scatter.inputs["Density"].default_value = 1  # of the file; opacity keeps to the object whatever its scale
scatter.inputs["Anisotropy"].default_value = 0.2
fog.node_tree.links.new(scatter.outputs["Volume"], nodes.new("ShaderNodeOutputMaterial").inputs["Volume"])
clouds.data.materials.append(fog)

bpy.ops.mesh.primitive_uv_sphere_add(radius=6.371, segments=128, ring_count=64)
bpy.ops.object.shade_smooth()
sea = bpy.data.materials.new("Sea")
sea.use_nodes = True
sea.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.01, 0.03, 0.08, 1)
bpy.context.object.data.materials.append(sea)

bpy.ops.object.light_add(type="SUN", rotation=(math.radians(60), 0, math.radians(60)))
bpy.context.object.data.energy = 6
bpy.ops.object.camera_add(location=(26, 5, 10))
scene.camera = bpy.context.object
scene.camera.constraints.new("TRACK_TO").target = clouds
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)

scene.render.engine = "CYCLES"
scene.cycles.samples = int(samples)
scene.cycles.volume_bounces = 4  # none by default, which leaves clouds dark
scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
scene.render.resolution_x, scene.render.resolution_y = int(width), int(width) * 3 // 4
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
