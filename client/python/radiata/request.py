"""Requests from plain Python values, with the words of the command line: plane="oblique", scale="per-glyph"."""

from .camera import camera_from_json
from .v1 import camera_pb2, frame_pb2, quality_pb2, scene_pb2


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


def frame_request(dataset, *, camera=None, size=(1280, 720), plane=None, position_mm=None, normal=None, slab_mm=None,
                  volume=False, scale=None, factor=None, lmax=None, lobes=None, opacity=None, convention=None,
                  annotations=True, samples=None, intersection=None, traversal=None, pole_table=None, jpeg_quality=None,
                  light=None, irradiance=None, ambient=None, background=None):
    """A FrameRequest message. What is None is left to the server; units and ranges stand in proto/radiata/v1."""
    request = frame_pb2.FrameRequest(width=size[0], height=size[1])
    layer = request.scene.layers.add()
    glyphs = layer.glyphs
    glyphs.dataset_id = dataset
    glyphs.selection.CopyFrom(voxel_selection(plane, position_mm, normal, slab_mm, volume))
    glyphs.scale.mode = enum_value(scene_pb2.GlyphScale.Mode, "MODE_", scale)
    glyphs.negative_lobes = enum_value(scene_pb2.NegativeLobes, "NEGATIVE_LOBES_", lobes)
    quality = request.quality
    quality.intersection = enum_value(quality_pb2.IntersectionMethod, "INTERSECTION_METHOD_", intersection)
    quality.traversal = enum_value(quality_pb2.Traversal, "TRAVERSAL_", traversal)
    quality.pole_table = enum_value(quality_pb2.PoleTable, "POLE_TABLE_", pole_table)
    for message, name, value in ((layer, "opacity", opacity), (glyphs, "lmax", lmax), (quality, "samples", samples),
                                 (quality, "jpeg_quality", jpeg_quality)):
        if value is not None:
            setattr(message, name, value)
    if factor is not None:
        glyphs.scale.factor = factor
    for name, value in (("irradiance", irradiance), ("ambient", ambient)):
        if value is not None:
            setattr(request.scene.light, name, value)
    if light is not None:
        set_vector(request.scene.light.direction_camera, light)
    if background is not None:
        set_vector(request.scene.background, background)
    request.scene.annotations.convention = enum_value(scene_pb2.Annotations.Convention, "CONVENTION_", convention)
    request.scene.annotations.hidden = not annotations
    if camera is not None:
        request.camera.CopyFrom(as_camera(camera))
    return request
