// Layers of isosurfaces and their settings.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {

model::IsosurfaceLayer fromProto(const v1::IsosurfaceLayer& message) {
    model::IsosurfaceLayer layer;
    layer.dataset_id = message.dataset_id();
    if (message.has_isovalue()) layer.isovalue = message.isovalue();
    if (message.has_colour()) {
        layer.colour = glm::vec3(glm::dvec3(message.colour().x(), message.colour().y(), message.colour().z()));
    }
    return layer;
}

model::IsosurfaceSettings fromProto(const v1::IsosurfaceSettings& message, const std::string& where) {
    checkEnum(message.method(), v1::SurfaceMethod_IsValid, v1::SurfaceMethod_MAX, where + ".method");
    checkEnum(message.normals(), v1::SurfaceNormals_IsValid, v1::SurfaceNormals_MAX, where + ".normals");
    model::IsosurfaceSettings settings;
    if (message.method() == v1::SURFACE_METHOD_MARCH_BISECT) settings.method = model::SurfaceMethod::kMarchBisect;
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
    return message;
}

v1::IsosurfaceSettings toProto(const model::IsosurfaceSettings& settings) {
    v1::IsosurfaceSettings message;
    message.set_method(settings.method == model::SurfaceMethod::kMarchBisect ? v1::SURFACE_METHOD_MARCH_BISECT
                                                                             : v1::SURFACE_METHOD_EXACT);
    message.set_step(settings.step);
    message.set_bisections(static_cast<std::uint32_t>(settings.bisections));
    message.set_normals(settings.normals == model::SurfaceNormals::kTrilinear ? v1::SURFACE_NORMALS_TRILINEAR
                                                                              : v1::SURFACE_NORMALS_SPLINE);
    message.set_bricks(settings.bricks);
    return message;
}

}  // namespace radiata::service
