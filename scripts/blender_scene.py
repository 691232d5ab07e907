"""Sets up a scene in Blender: grids of `vegard volume`, one or one a frame, before a sky, seen by vegard's camera.

blender -b --python scripts/blender_scene.py -- CAMERA.toml OUT.blend GRID.vdb [GRID.vdb ...] [key=value ...]

CAMERA.toml: a scene, or the camera.toml of `vegard calibrate`. The world's unit is the grid's (km): x east, y
north, z up, the camera at the origin. Where the grids have a vector grid `velocity`, it blurs them.

keys: sky (an equirectangular picture of `vegard render`, azimuth sky_azimuth_deg in its middle), plate (a photograph,
shown behind in the camera's view), grid (color: as the scene's sensor sees it; or emission_5577 ... in rayleighs),
strength, step_km (of the march), frames_per_second, samples; render=OUT.exr or OUT.png: the first frame, at once.
"""
import math
import os
import re
import sys
import tomllib

import bpy
import mathutils


def fail(message):
    print("blender_scene.py: " + message, file=sys.stderr)
    sys.exit(2)


def read_arguments():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    options = dict(sky="", sky_azimuth_deg=0.0, plate="", grid="color", strength=1.0, step_km=1.0,
                   frames_per_second=24, samples=16, render="")
    files = []
    for word in words:
        key, equals, value = word.partition("=")
        if not equals:
            files.append(word)
        elif key not in options:
            fail(f"there is no key '{key}'; there are: {', '.join(options)}")
        else:
            try:
                options[key] = type(options[key])(value)
            except ValueError:
                fail(f"'{value}' is no number for {key}")
    if len(files) < 3:
        fail("CAMERA.toml OUT.blend GRID.vdb ... are missing")
    for name in [files[0], *files[2:], options["sky"], options["plate"]]:
        if name and not os.path.isfile(name):
            fail(f"there is no file '{name}'")
    return files[0], files[1], files[2:], options


def read_camera(path):
    """The table [camera], by the defaults of docs/parameters.md."""
    with open(path, "rb") as file:
        try:
            camera = tomllib.load(file).get("camera", {})
        except tomllib.TOMLDecodeError as error:
            fail(f"{path}: {error}")
    read = dict(width=720, height=480, model="pinhole", hfov_deg=60.0, azimuth_deg=0.0, elevation_deg=30.0,
                roll_deg=0.0, focal_px=300.0, principal_x_px=0.0, principal_y_px=0.0)
    for key in read:
        read[key] = camera.get(key, read[key])
    if read["model"] not in ("pinhole", "equidistant", "equirectangular"):
        fail(f"{path}: Blender has no lens of the model \"{read['model']}\": pinhole, equidistant or equirectangular")
    if camera.get("mirrored", False):
        fail(f"{path}: Blender has no mirrored cameras: mirrored = false, and turn the picture round afterwards")
    if camera.get("aspect", 1.0) != 1.0:
        fail(f"{path}: aspect is {camera['aspect']}, and only square pixels are set up: aspect = 1")
    if read["model"] != "pinhole" and (read["principal_x_px"] or read["principal_y_px"]):
        fail(f"{path}: Blender shifts pinholes alone: principal_x_px = 0 and principal_y_px = 0")
    if read["model"] == "equidistant" and read["width"] != read["height"]:
        fail(f"{path}: Blender stretches a fisheye to {read['width']} x {read['height']} pixels: width = height")
    if any(camera.get(key, 0.0) for key in ("k1", "k2", "k3", "p1", "p2")):
        print("blender_scene.py: the lens's distortion is left out", file=sys.stderr)
    return read


def set_up_camera(scene, camera):
    data = bpy.data.cameras.new("camera")
    data.clip_start, data.clip_end = 1e-3, 1e6
    width, height = camera["width"], camera["height"]
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    data.sensor_fit = "HORIZONTAL"
    if camera["model"] == "pinhole":
        data.angle_x = math.radians(camera["hfov_deg"])
        data.shift_x, data.shift_y = -camera["principal_x_px"] / width, camera["principal_y_px"] / width
    else:
        data.type = "PANO"
        if camera["model"] == "equirectangular":
            data.cycles.panorama_type = "EQUIRECTANGULAR"
        else:
            data.cycles.panorama_type = "FISHEYE_EQUIDISTANT"
            # Blender's circle fills the square; vegard has an angle of 1 rad at focal_px.
            data.cycles.fisheye_fov = width / camera["focal_px"]
    seen = bpy.data.objects.new("camera", data)
    # A camera of Blender's looks down its own z axis; a turn about x lifts it to the horizon in the north and above.
    turn = mathutils.Matrix.Rotation
    seen.matrix_world = (turn(-math.radians(camera["azimuth_deg"]), 4, "Z") @
                         turn(math.radians(90.0 + camera["elevation_deg"]), 4, "X") @
                         turn(math.radians(camera["roll_deg"]), 4, "Z"))
    scene.collection.objects.link(seen)
    scene.camera = seen
    return data


def check_sequence(grids):
    """The number of the first file. Blender finds the others by counting up the digits before ".vdb"."""
    folder, name = os.path.split(os.path.abspath(grids[0]))
    parts = re.fullmatch(r"(.*?)([0-9]+)([^0-9]*)", name)
    if not parts:
        fail(f"the grids of a sequence are numbered, light_0001.vdb, light_0002.vdb ..., and '{grids[0]}' is not")
    before, digits, after = parts.groups()
    for i, grid in enumerate(grids):
        wanted = f"{before}{int(digits) + i:0{len(digits)}}{after}"
        if os.path.abspath(grid) != os.path.join(folder, wanted):
            fail(f"the grids of a sequence are numbered one after the other: after '{grids[0]}' Blender reads "
                 f"'{wanted}' in the same folder, not '{grid}'")
    return int(digits)


def set_up_light(scene, grids, options):
    volume = bpy.data.volumes.new("light")
    volume.filepath = os.path.abspath(grids[0])
    volume.grids.load()
    names = [grid.name for grid in volume.grids]
    if options["grid"] not in names:
        fail(f"{grids[0]} has no grid '{options['grid']}'; there are: {', '.join(names)}")
    if len(grids) > 1:
        first = check_sequence(grids)
        volume.is_sequence = True
        volume.frame_start, volume.frame_duration = 1, len(grids)
        volume.frame_offset = first - 1
        volume.sequence_mode = "CLIP"
        scene.frame_start, scene.frame_end = 1, len(grids)
    volume.render.space = "WORLD"
    volume.render.step_size = options["step_km"]
    if "velocity" in names:
        volume.velocity_grid, volume.velocity_unit = "velocity", "SECOND"
        scene.render.use_motion_blur = True
    scene.collection.objects.link(bpy.data.objects.new("light", volume))
    material = bpy.data.materials.new("light")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output, emission = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeEmission")
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = options["grid"]
    emission.inputs["Strength"].default_value = options["strength"]
    if options["grid"] == "color":
        links.new(attribute.outputs["Color"], emission.inputs["Color"])
    else:
        strength = nodes.new("ShaderNodeMath")
        strength.operation = "MULTIPLY"
        strength.inputs[1].default_value = 0.1 * options["strength"]  # rayleighs of 1 photon cm^-3 s^-1 over a km
        links.new(attribute.outputs["Fac"], strength.inputs[0])
        links.new(strength.outputs[0], emission.inputs["Strength"])
    links.new(emission.outputs[0], output.inputs["Volume"])
    volume.materials.append(material)


def set_up_sky(scene, options):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    background = nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    scene.world = world
    if not options["sky"]:
        return
    picture, mapping = nodes.new("ShaderNodeTexEnvironment"), nodes.new("ShaderNodeMapping")
    place = nodes.new("ShaderNodeTexCoord")
    picture.image = bpy.data.images.load(os.path.abspath(options["sky"]))
    # Blender has +x in the picture's middle, and vegard the azimuth that its camera looks to.
    mapping.vector_type = "POINT"
    mapping.inputs["Rotation"].default_value[2] = math.radians(options["sky_azimuth_deg"] - 90.0)
    links.new(place.outputs["Generated"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], picture.inputs["Vector"])
    links.new(picture.outputs["Color"], background.inputs["Color"])


def main():
    camera_file, out, grids, options = read_arguments()
    camera = read_camera(camera_file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.fps = options["frames_per_second"]
    scene.cycles.device = "CPU"
    scene.cycles.samples = options["samples"]
    scene.cycles.max_bounces = 0
    scene.cycles.volume_max_steps = 65536
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    data = set_up_camera(scene, camera)
    set_up_light(scene, grids, options)
    set_up_sky(scene, options)
    if options["plate"]:
        data.show_background_images = True
        data.background_images.new().image = bpy.data.images.load(os.path.abspath(options["plate"]))
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(out))
    if options["render"]:
        settings = scene.render.image_settings
        settings.file_format = "OPEN_EXR" if options["render"].endswith(".exr") else "PNG"
        settings.color_depth = "32" if options["render"].endswith(".exr") else "8"
        scene.frame_set(1)
        scene.render.filepath = os.path.abspath(options["render"])
        bpy.ops.render.render(write_still=True)


try:
    main()
except SystemExit:
    raise
except Exception as error:  # else Blender ends with 0
    fail(str(error))
