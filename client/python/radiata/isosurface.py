"""Layers of isosurfaces, and their global light, from plain Python values."""

from .request import enum_value, set_vector
from .v1 import colour_pb2, illumination_pb2, isosurface_pb2, scene_pb2


def isosurface(dataset, isovalue=None, *, opacity=None, colour=None, shading=None, fog=None, colour_by=None, colour_map=None,
               colour_range=None, casts_shadows=None):
    """A Layer message for frame_request's `layers`: the surface of one value of a scalar volume.

    shading: "scene", "lambert" or "phong"; fog: share of the background at the far end, 0 to 1; colour_by: id of the volume that
    colours it, with colour_map and colour_range (low, high). What is None is left to the server.
    """
    layer = scene_pb2.Layer()
    surface = layer.isosurface
    surface.dataset_id = dataset
    surface.shading = enum_value(isosurface_pb2.SurfaceShading, "SURFACE_SHADING_", shading)
    for message, name, value in ((surface, "isovalue", isovalue), (surface, "fog", fog), (layer, "opacity", opacity),
                                 (layer, "casts_shadows", casts_shadows)):
        if value is not None:
            setattr(message, name, value)
    if colour is not None:
        set_vector(surface.colour, colour)
    if colour_by is None and (colour_map is not None or colour_range is not None):
        raise ValueError("colour_map and colour_range go with colour_by only")
    if colour_by is not None:
        surface.colour_by.image_id = colour_by
        surface.colour_by.map = enum_value(colour_pb2.ColourMap, "COLOUR_MAP_", colour_map)
        if colour_range is not None:
            surface.colour_by.range.low, surface.colour_by.range.high = colour_range
    return layer


def illumination(payload="irradiance", *, method=None, interpolation=None, resolution=None, storage=None, sky=None,
                 sky_gradient=None, sky_up=None, suns=(), lamps=(), **fields):
    """An Illumination message for frame_request's `illumination`: shadows and light that bounces, on opaque isosurfaces.

    suns: dicts of direction, angular_radius_deg, irradiance; lamps: dicts of position_mm, radius_mm, intensity. Other words are
    fields of the message, such as bounces=2, relative_error=0.05 or project=False.
    """
    light = illumination_pb2.Illumination(**fields)
    light.payload = enum_value(illumination_pb2.TexelPayload, "TEXEL_PAYLOAD_", payload)
    light.method = enum_value(illumination_pb2.IlluminationMethod, "ILLUMINATION_METHOD_", method)
    light.storage = enum_value(illumination_pb2.TexelStorage, "TEXEL_STORAGE_", storage)
    light.interpolation = enum_value(illumination_pb2.TexelInterpolation, "TEXEL_INTERPOLATION_", interpolation)
    light.resolution = enum_value(illumination_pb2.LatticeResolution, "LATTICE_RESOLUTION_", resolution)
    for name, values in (("radiance", sky), ("gradient", sky_gradient), ("up", sky_up)):
        if values is not None:
            set_vector(getattr(light.sky, name), values)
    for added, lights in ((light.suns, suns), (light.lights, lamps)):
        for values in lights:
            message = added.add()
            for name, value in values.items():
                if hasattr(value, "__len__"):
                    set_vector(getattr(message, name), value)
                else:
                    setattr(message, name, value)
    return light


def vicinity(**fields):
    """Vicinity shading as an Illumination message: an even sky of radiance 1, no bounces."""
    return illumination(bounces=0, sky=(1, 1, 1), **fields)
