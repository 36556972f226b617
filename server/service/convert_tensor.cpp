// What layers and methods of tensors add to scenes and quality.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {

model::TensorMarchSettings fromProto(const v1::TensorMarch& settings, const std::string& where) {
    model::TensorMarchSettings result;
    if (settings.has_step()) result.step = settings.step();
    if (settings.has_bisections()) result.bisections = toInt(settings.bisections(), where + ".bisections");
    if (settings.has_interpolate()) result.interpolate = settings.interpolate();
    if (settings.has_adaptive()) result.adaptive = settings.adaptive();
    if (settings.has_depth()) result.depth = toInt(settings.depth(), where + ".depth");
    return result;
}

v1::TensorMarch toProto(const model::TensorMarchSettings& settings) {
    v1::TensorMarch message;
    message.set_step(settings.step);
    message.set_bisections(static_cast<std::uint32_t>(settings.bisections));
    message.set_interpolate(settings.interpolate);
    message.set_adaptive(settings.adaptive);
    message.set_depth(static_cast<std::uint32_t>(settings.depth));
    return message;
}

model::TensorShape fromProto(v1::TensorShape shape, const std::string& where) {
    checkEnum(shape, v1::TensorShape_IsValid, v1::TensorShape_MAX, where);
    return shape == v1::TENSOR_SHAPE_ELLIPSOID ? model::TensorShape::kEllipsoid : model::TensorShape::kReynolds;
}

v1::TensorShape toProto(model::TensorShape shape) {
    return shape == model::TensorShape::kEllipsoid ? v1::TENSOR_SHAPE_ELLIPSOID : v1::TENSOR_SHAPE_REYNOLDS;
}

}  // namespace radiata::service
