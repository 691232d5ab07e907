"""Renders one grid of an OpenVDB file with Cycles, as `vegard render` sees it: light only, one pinhole.

blender -b -t 2 --python scripts/blender_check.py -- FILE.vdb OUT.exr [key=value ...]

The world's unit is the grid's (km), x east, y north, z up, the camera at the origin. A pixel is sampled at its
middle. What is written are rayleighs, in linear 32-bit floats, without view transform and without denoising.

keys: grid, width, height, hfov_deg, azimuth_deg, elevation_deg, samples, step_km (of the march), subpixels (1:
the middle of a pixel; above: the whole pixel, at random), repeat (renders so often and keeps what was loaded),
rayleigh_per_unit, seed, log (1: Cycles tells its own times).

Of a grid in the frame of the Sun: sun_azimuth_deg, sun_elevation_deg, sun_distance (in the grid's units; 0: the
grid is in the observer's frame), position_angle_deg, latitude_deg, longitude_deg (of the middle of the disc), and
ball, the radius of a black ball in the middle.
"""
import math
import sys

import bpy
import mathutils

arguments = sys.argv[sys.argv.index("--") + 1:]
options = dict(grid="emission_5577", width=640, height=480, hfov_deg=60.0, azimuth_deg=0.0, elevation_deg=30.0,
               samples=1, step_km=0.5, subpixels=1, repeat=1, rayleigh_per_unit=0.1, seed=0, sun_azimuth_deg=0.0,
               sun_elevation_deg=45.0, sun_distance=0.0, position_angle_deg=0.0, latitude_deg=0.0,
               longitude_deg=0.0, ball=0.0)
for argument in arguments[2:]:
    key, value = argument.split("=", 1)
    options[key] = value if key == "grid" else type(options[key])(float(value))

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y = options["width"], options["height"]
scene.render.resolution_percentage = 100
scene.render.use_persistent_data = True  # what was loaded for one frame serves the next
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.exr_codec = "NONE"
scene.view_settings.view_transform = "Raw"
scene.cycles.device = "CPU"
scene.cycles.samples = options["samples"]
scene.cycles.seed = options["seed"]
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.filter_width = 0.01 if options["subpixels"] == 1 else 1.0
scene.cycles.max_bounces = 0
scene.cycles.volume_max_steps = 65536
world = bpy.data.worlds.new("dark")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (0, 0, 0, 1)
scene.world = world

volume = bpy.data.volumes.new("light")
volume.filepath = arguments[0]
volume.render.space = "WORLD"
volume.render.step_size = options["step_km"]
scene.collection.objects.link(bpy.data.objects.new("light", volume))
material = bpy.data.materials.new("light")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
output = nodes.new("ShaderNodeOutputMaterial")
emission = nodes.new("ShaderNodeEmission")
attribute = nodes.new("ShaderNodeAttribute")
strength = nodes.new("ShaderNodeMath")
strength.operation = "MULTIPLY"
attribute.attribute_name = options["grid"]
strength.inputs[1].default_value = options["rayleigh_per_unit"]
links.new(attribute.outputs["Fac"], strength.inputs[0])
links.new(strength.outputs[0], emission.inputs["Strength"])
links.new(emission.outputs[0], output.inputs["Volume"])
volume.materials.append(material)



def sun_from_enu():
    """Where the observer is in the Sun's frame, and the turn from east, north, up to it (sim/emit/sun/sun_frame.h)."""
    azimuth, elevation, angle, b, l = (math.radians(options[key]) for key in (
        "sun_azimuth_deg", "sun_elevation_deg", "position_angle_deg", "latitude_deg", "longitude_deg"))
    right = mathutils.Vector((math.cos(azimuth), -math.sin(azimuth), 0))
    up = mathutils.Vector((-math.sin(azimuth) * math.sin(elevation), -math.cos(azimuth) * math.sin(elevation),
                           math.cos(elevation)))
    near = mathutils.Vector((-math.sin(azimuth) * math.cos(elevation), -math.cos(azimuth) * math.cos(elevation),
                             -math.sin(elevation)))
    west = right * math.cos(angle) + up * math.sin(angle)
    upwards = up * math.cos(angle) - right * math.sin(angle)
    north = upwards * math.cos(b) + near * math.sin(b)
    meridian = near * math.cos(b) - upwards * math.sin(b)
    turn = mathutils.Matrix((meridian * math.cos(l) - west * math.sin(l), meridian * math.sin(l) + west * math.cos(l),
                             north))
    return turn @ near * options["sun_distance"], turn


camera = bpy.data.cameras.new("camera")
camera.sensor_fit = "HORIZONTAL"
camera.angle_x = math.radians(options["hfov_deg"])
camera.clip_start, camera.clip_end = 1e-3, 1e6
seen = bpy.data.objects.new("camera", camera)
# A camera of Blender's looks down its own z axis; a turn about x lifts it to the horizon in the north and above.
seen.matrix_world = (mathutils.Matrix.Rotation(-math.radians(options["azimuth_deg"]), 4, "Z") @
                     mathutils.Matrix.Rotation(math.radians(90.0 + options["elevation_deg"]), 4, "X"))
if options["sun_distance"] > 0:
    place, turn = sun_from_enu()
    seen.matrix_world = mathutils.Matrix.Translation(place) @ turn.to_4x4() @ seen.matrix_world
scene.collection.objects.link(seen)
scene.camera = seen
if options["ball"] > 0:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=1024, ring_count=512, radius=options["ball"])
    black = bpy.data.materials.new("black")
    black.use_nodes = True
    black.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0, 0, 0, 1)
    black.node_tree.nodes["Principled BSDF"].inputs["Specular"].default_value = 0
    bpy.context.object.data.materials.append(black)

for number in range(options["repeat"]):
    scene.frame_set(number + 1)
    scene.cycles.seed = options["seed"] + number
    scene.render.filepath = arguments[1]
    bpy.ops.render.render(write_still=True)
