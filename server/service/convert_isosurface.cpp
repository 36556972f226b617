// Layers of isosurfaces and their settings.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {

model::IsosurfaceLayer fromProto(const v1::IsosurfaceLayer& message, const std::string& where) {
    checkEnum(message.shading(), v1::SurfaceShading_IsValid, v1::SurfaceShading_MAX, where + ".shading");
    model::IsosurfaceLayer layer;
    layer.dataset_id = message.dataset_id();
    if (message.has_isovalue()) layer.isovalue = message.isovalue();
    if (message.has_colour()) {
        layer.colour = glm::vec3(glm::dvec3(message.colour().x(), message.colour().y(), message.colour().z()));
    }
    if (message.shading() == v1::SURFACE_SHADING_LAMBERT) layer.shading = model::SurfaceShading::kLambert;
    if (message.shading() == v1::SURFACE_SHADING_PHONG) layer.shading = model::SurfaceShading::kPhong;
    if (message.has_fog()) layer.fog = message.fog();
    if (!message.has_colour_by()) return layer;
    const v1::VolumeColour& colour = message.colour_by();
    layer.colour_by = model::VolumeColour{colour.image_id(), fromProto(colour.map(), where + ".colour_by.map"), {}};
    if (colour.has_range()) layer.colour_by->range = model::ColourRange{colour.range().low(), colour.range().high()};
    return layer;
}

model::IsosurfaceSettings fromProto(const v1::IsosurfaceSettings& message, const std::string& where) {
    checkEnum(message.method(), v1::SurfaceMethod_IsValid, v1::SurfaceMethod_MAX, where + ".method");
    checkEnum(message.normals(), v1::SurfaceNormals_IsValid, v1::SurfaceNormals_MAX, where + ".normals");
    model::IsosurfaceSettings settings;
    if (message.method() == v1::SURFACE_METHOD_MARCH_BISECT) settings.method = model::SurfaceMethod::kMarchBisect;
    if (message.method() == v1::SURFACE_METHOD_MARCHING_CUBES) settings.method = model::SurfaceMethod::kMarchingCubes;
    if (message.has_step()) settings.step = message.step();
    if (message.has_bisections()) settings.bisections = toInt(message.bisections(), where + ".bisections");
    if (message.normals() == v1::SURFACE_NORMALS_TRILINEAR) settings.normals = model::SurfaceNormals::kTrilinear;
    if (message.has_bricks()) settings.bricks = message.bricks();
    return settings;
}

v1::IsosurfaceLayer toProto(const model::IsosurfaceLayer& layer) {
    v1::IsosurfaceLayer message;
    message.set_dataset_id(layer.dataset_id);
    if (layer.isovalue) message.set_isovalue(*layer.isovalue);
    *message.mutable_colour() = toProto(glm::dvec3(layer.colour));
    message.set_shading(layer.shading == model::SurfaceShading::kPhong     ? v1::SURFACE_SHADING_PHONG
                        : layer.shading == model::SurfaceShading::kLambert ? v1::SURFACE_SHADING_LAMBERT
                                                                           : v1::SURFACE_SHADING_SCENE);
    if (layer.fog) message.set_fog(*layer.fog);
    if (!layer.colour_by) return message;
    v1::VolumeColour& colour = *message.mutable_colour_by();
    colour.set_image_id(layer.colour_by->image_id);
    colour.set_map(toProto(layer.colour_by->map));
    if (!layer.colour_by->range) return message;
    colour.mutable_range()->set_low(layer.colour_by->range->low);
    colour.mutable_range()->set_high(layer.colour_by->range->high);
    return message;
}

v1::IsosurfaceSettings toProto(const model::IsosurfaceSettings& settings) {
    v1::IsosurfaceSettings message;
    message.set_method(settings.method == model::SurfaceMethod::kMarchBisect     ? v1::SURFACE_METHOD_MARCH_BISECT
                       : settings.method == model::SurfaceMethod::kMarchingCubes ? v1::SURFACE_METHOD_MARCHING_CUBES
                                                                                 : v1::SURFACE_METHOD_EXACT);
    message.set_step(settings.step);
    message.set_bisections(static_cast<std::uint32_t>(settings.bisections));
    message.set_normals(settings.normals == model::SurfaceNormals::kTrilinear ? v1::SURFACE_NORMALS_TRILINEAR
                                                                              : v1::SURFACE_NORMALS_SPLINE);
    message.set_bricks(settings.bricks);
    return message;
}

}  // namespace radiata::service
