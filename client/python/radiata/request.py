"""Requests from plain Python values, with the words of the command line: plane="oblique", scale="per-glyph"."""

from google.protobuf import json_format

from .camera import camera_from_json
from .v1 import camera_pb2, colour_pb2, frame_pb2, quality_pb2, scene_pb2


def enum_value(enum, prefix, word):
    """The value of an enum for a word such as "ray-query"; None and "auto" leave the choice to the server."""
    if word is None or word == "auto":
        return 0
    name = prefix + word.upper().replace("-", "_")
    if name not in enum.keys() or enum.Value(name) == 0:
        words = ", ".join(key[len(prefix):].lower().replace("_", "-") for key in enum.keys() if enum.Value(key) != 0)
        raise ValueError(f"'{word}' is not one of {words}")
    return enum.Value(name)


def set_vector(vector, values):
    """Fills a Vec3 from three numbers."""
    vector.x, vector.y, vector.z = (float(v) for v in values)


def set_fields(message, fields, where):
    """Sets what a dict with the contract's field names (nested dicts, enum values by name) says; raises ValueError for others."""
    try:
        json_format.ParseDict(fields, message)
    except json_format.ParseError as error:
        raise ValueError(f"{where}: {error}") from None


def as_camera(camera):
    """A Camera message from a message or from a dict of the camera format."""
    return camera if isinstance(camera, camera_pb2.Camera) else camera_from_json(camera)


def voxel_selection(plane=None, position_mm=None, normal=None, slab_mm=None, volume=False):
    """Which voxels get a glyph: a slice, with slab_mm a slab about it, with volume=True all of them."""
    selection = scene_pb2.VoxelSelection()
    if volume:
        selection.volume.SetInParent()
        return selection
    middle = selection.slice if slab_mm is None else selection.slab.middle
    middle.SetInParent()
    middle.plane = enum_value(scene_pb2.Plane, "PLANE_", plane)
    if position_mm is not None:
        set_vector(middle.position_mm, position_mm)
    if normal is not None:
        set_vector(middle.normal, normal)
    if slab_mm is not None:
        selection.slab.thickness_mm = slab_mm
    return selection


def glyph_colour(colour=None, colour_map=None, colour_range=None, colour_image=None):
    """What colours the glyphs: "direction", "radius", "scalar" (with colour_image, a catalogue id) or three numbers, linear RGB.

    colour_map and colour_range (low, high) go with "radius" (mm) and "scalar" (values).
    """
    message = scene_pb2.GlyphColour()
    mapped = colour in ("radius", "scalar")
    if not mapped and (colour_map is not None or colour_range is not None):
        raise ValueError("colour_map and colour_range go with colour 'radius' or 'scalar' only")
    if (colour == "scalar") != (colour_image is not None):
        raise ValueError("colour 'scalar' and colour_image go together")
    if mapped:
        source = getattr(message, colour)
        source.map = enum_value(colour_pb2.ColourMap, "COLOUR_MAP_", colour_map)
        source.SetInParent()
        if colour_range is not None:
            source.range.low, source.range.high = colour_range
        if colour_image is not None:
            source.image_id = colour_image
    elif colour == "direction":
        message.direction.SetInParent()
    elif isinstance(colour, str):
        raise ValueError(f"'{colour}' is not one of direction, radius, scalar, or three numbers")
    elif colour is not None:
        set_vector(message.uniform, colour)
    return message


def frame_request(dataset=None, *, layers=(), uncertainty=None, light_fields=None, quality_fields=None, camera=None, size=(1280,
                  720), plane=None, position_mm=None, normal=None, slab_mm=None, volume=False, scale=None, factor=None, lmax=None,
                  lobes=None, opacity=None, convention=None, annotations=True, samples=None, intersection=None, traversal=None,
                  pole_table=None, mesh=None, mesh_level=None, mesh_normals=None, jpeg_quality=None, light=None, irradiance=None,
                  ambient=None, background=None, colour=None, colour_map=None, colour_range=None, colour_image=None,
                  light_world=None, shadow=None, light_radius_deg=None, shadow_rays=None, occlusion_rays=None,
                  occlusion_radius_mm=None, casts_shadows=None, sun_table=None, tensor_glyphs=None, tensor_march=None):
    """A FrameRequest message. What is None is left to the server; units and ranges stand in proto/radiata/v1.

    `dataset` is drawn as glyphs; without it the picture is of `layers` alone, which are dicts of the contract's Layer such as
    {"tractogram": {"dataset_id": "tracts", "line_width_px": 2}} or {"isosurface": {"dataset_id": "t1"}, "opacity": 0.3} and are
    drawn after it. light_fields and quality_fields are dicts of Light and Quality and set what has no argument of its own here,
    uncertainty is one of Uncertainty: {"dataset_id": "fod_deviations", "kind": "KIND_DEVIATIONS"}.
    tensor_glyphs ("reynolds" or "ellipsoid") makes the layer one of tensor glyphs; tensor_march is a dict of the fields of
    quality.TensorMarch, such as {"step": 0.01, "bisections": 3}.
    """
    request = frame_pb2.FrameRequest(width=size[0], height=size[1])
    # Without a dataset the layer of glyphs is thrown away in the end.
    layer = scene_pb2.Layer() if dataset is None else request.scene.layers.add()
    glyphs = layer.glyphs if tensor_glyphs is None else layer.tensor_glyphs.glyphs
    if tensor_glyphs is not None:
        layer.tensor_glyphs.shape = enum_value(scene_pb2.TensorShape, "TENSOR_SHAPE_", tensor_glyphs)
    glyphs.dataset_id = dataset or ""
    glyphs.selection.CopyFrom(voxel_selection(plane, position_mm, normal, slab_mm, volume))
    glyphs.scale.mode = enum_value(scene_pb2.GlyphScale.Mode, "MODE_", scale)
    glyphs.negative_lobes = enum_value(scene_pb2.NegativeLobes, "NEGATIVE_LOBES_", lobes)
    if colour is not None or colour_map is not None or colour_range is not None or colour_image is not None:
        glyphs.colour.CopyFrom(glyph_colour(colour, colour_map, colour_range, colour_image))
    quality = request.quality
    quality.intersection = enum_value(quality_pb2.IntersectionMethod, "INTERSECTION_METHOD_", intersection)
    if tensor_march is not None:
        quality.tensor_march.CopyFrom(quality_pb2.TensorMarch(**tensor_march))
    quality.traversal = enum_value(quality_pb2.Traversal, "TRAVERSAL_", traversal)
    quality.pole_table = enum_value(quality_pb2.PoleTable, "POLE_TABLE_", pole_table)
    if (mesh, mesh_level, mesh_normals) != (None, None, None):
        quality.tessellation.mesh = enum_value(quality_pb2.SphereMesh, "SPHERE_MESH_", mesh)
        quality.tessellation.normals = enum_value(quality_pb2.MeshNormals, "MESH_NORMALS_", mesh_normals)
        if mesh_level is not None:
            quality.tessellation.level = mesh_level
    quality.sun_table = enum_value(quality_pb2.PoleTable, "POLE_TABLE_", sun_table)
    request.scene.light.shadow = enum_value(scene_pb2.Shadow, "SHADOW_", shadow)
    occlusion = {"rays": occlusion_rays, "radius_mm": occlusion_radius_mm}
    for name, value in occlusion.items():
        if value is not None:
            setattr(request.scene.light.ambient_occlusion, name, value)
    for message, name, value in ((layer, "casts_shadows", casts_shadows),
                                 (request.scene.light, "angular_radius_deg", light_radius_deg),
                                 (request.scene.light, "shadow_rays", shadow_rays), (layer, "opacity", opacity),
                                 (glyphs, "lmax", lmax), (quality, "samples", samples), (quality, "jpeg_quality", jpeg_quality)):
        if value is not None:
            setattr(message, name, value)
    if factor is not None:
        glyphs.scale.factor = factor
    for name, value in (("irradiance", irradiance), ("ambient", ambient)):
        if value is not None:
            setattr(request.scene.light, name, value)
    if light is not None:
        set_vector(request.scene.light.direction_camera, light)
    if light_world is not None:
        set_vector(request.scene.light.direction_world, light_world)
    if background is not None:
        set_vector(request.scene.background, background)
    if uncertainty is not None:
        set_fields(glyphs.uncertainty, uncertainty, "uncertainty")
    for number, fields in enumerate(layers):
        set_fields(request.scene.layers.add(), fields, f"layers[{number}]")
    if not request.scene.layers:
        raise ValueError("dataset and layers are both missing; give one")
    set_fields(request.scene.light, light_fields or {}, "light_fields")
    set_fields(quality, quality_fields or {}, "quality_fields")
    request.scene.annotations.convention = enum_value(scene_pb2.Annotations.Convention, "CONVENTION_", convention)
    request.scene.annotations.hidden = not annotations
    if camera is not None:
        request.camera.CopyFrom(as_camera(camera))
    return request
