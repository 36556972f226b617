"""Cameras and camera paths as JSON, the format of docs/formats/camera.md; the command line reads the same files."""

import json

from .v1 import camera_pb2

_FIELDS = {"eye_mm", "target_mm", "up", "field_of_view_deg", "height_mm", "clip"}


def _number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _check_fields(fields, known, where):
    if not isinstance(fields, dict):
        raise ValueError(f"{where} is not a JSON object")
    unknown = sorted(set(fields) - known)
    if unknown:
        raise ValueError(f"{where} has the field '{unknown[0]}', which is not known; the fields are {', '.join(sorted(known))}")


def camera_from_json(fields, where="camera"):
    """A Camera message from a dict of the camera format. ValueError names the field that is missing, wrong or unknown."""
    _check_fields(fields, _FIELDS, where)
    camera = camera_pb2.Camera()
    for name in ("eye_mm", "target_mm", "up"):
        values = fields.get(name)
        if not isinstance(values, list) or len(values) != 3 or not all(_number(v) for v in values):
            raise ValueError(f"{where}: {name} must be a list of three numbers")
        vector = getattr(camera, name)
        vector.x, vector.y, vector.z = values
    if ("field_of_view_deg" in fields) == ("height_mm" in fields):
        raise ValueError(f"{where} must have either field_of_view_deg (perspective) or height_mm (orthographic)")
    lens = "field_of_view_deg" if "field_of_view_deg" in fields else "height_mm"
    if not _number(fields[lens]):
        raise ValueError(f"{where}: {lens} must be a number")
    setattr(camera, lens, fields[lens])
    if "clip" in fields:
        clip = fields["clip"]
        _check_fields(clip, {"nearest_mm", "farthest_mm"}, f"{where}: clip")
        if len(clip) != 2 or not all(_number(v) for v in clip.values()):
            raise ValueError(f"{where}: clip must have the numbers nearest_mm and farthest_mm")
        camera.clip.nearest_mm, camera.clip.farthest_mm = clip["nearest_mm"], clip["farthest_mm"]
    return camera


def camera_to_json(camera):
    """The dict that camera_from_json reads."""
    fields = {name: [getattr(camera, name).x, getattr(camera, name).y, getattr(camera, name).z]
              for name in ("eye_mm", "target_mm", "up")}
    lens = camera.WhichOneof("lens")
    if lens:
        fields[lens] = getattr(camera, lens)
    if camera.HasField("clip"):
        fields["clip"] = {"nearest_mm": camera.clip.nearest_mm, "farthest_mm": camera.clip.farthest_mm}
    return fields


def read_camera_path(file):
    """The Camera messages of a path file: a list of cameras, or an object with the list "cameras"."""
    with open(file, encoding="utf-8") as stream:
        document = json.load(stream)
    if isinstance(document, dict):
        _check_fields(document, {"cameras"}, file)
        document = document.get("cameras")
    if not isinstance(document, list) or not document:
        raise ValueError(f"{file} is no camera path: it must be a list of at least one camera")
    return [camera_from_json(fields, f"{file}: camera {i}") for i, fields in enumerate(document)]
