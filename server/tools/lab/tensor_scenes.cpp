#include "tools/lab/tensor_scenes.h"

#include <cmath>

#include "base/error.h"
#include "build/stiffness_field.h"
#include "math/cartesian_tensor.h"
#include "math/sh_rotation.h"
#include "math/tensor_sh.h"
#include "tools/lab/report.h"

namespace radiata::lab {

model::ShImage tensorImage(int order, const std::vector<std::vector<float>>& functions) {
    const TensorSh map(order);
    model::ShImage image;
    image.size = glm::ivec3(static_cast<int>(functions.size()), 1, 1);
    image.layout = {order, false};
    image.tensor_order = order;
    image.tensor_format = "made";
    for (std::size_t i = 0; i < functions.size(); ++i) {
        image.voxels.emplace_back(static_cast<int>(i), 0, 0);
        const std::vector<double> coefficients(functions[i].begin(), functions[i].end());
        std::vector<double> components(symmetricCount(order));
        map.toTensor(coefficients, components);
        image.coefficients.insert(image.coefficients.end(), functions[i].begin(), functions[i].end());
        image.tensors.insert(image.tensors.end(), components.begin(), components.end());
    }
    return image;
}

std::vector<float> turned(int k, const std::vector<float>& function, const glm::dvec3& axis, double angle) {
    const glm::dvec3 a = glm::normalize(axis);
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
    std::vector<double> coefficients(function.begin(), function.end());
    ShRotation({k, false}, c * glm::dmat3(1.0) + s * cross + (1 - c) * glm::outerProduct(a, a)).apply(coefficients);
    return {coefficients.begin(), coefficients.end()};
}

std::vector<Method> tensorMarches(bool adaptive) {
    std::vector<Method> methods;
    for (const float step : {0.01F, 0.02F, 0.05F}) {
        for (int refinement = 0; refinement <= 4; ++refinement) {
            const bool interpolate = refinement == 4;
            const std::string how = interpolate ? "interpolation" : "bisect " + std::to_string(refinement);
            methods.push_back(
                {"tensor-march, step " + shortNumber(static_cast<double>(step)) + ", " + how + (adaptive ? ", adaptive" : ""),
                 adaptive ? "tensor-march, adaptive" : "tensor-march", [=](model::Quality& quality) {
                     quality.intersection = model::Intersection::kTensorMarch;
                     quality.tensor_march.step = step;
                     quality.tensor_march.bisections = interpolate ? 0 : refinement;
                     quality.tensor_march.interpolate = interpolate;
                     quality.tensor_march.adaptive = adaptive;
                 }});
        }
    }
    return methods;
}

std::vector<Method> tensorRanges() {
    return {{"tensor-interval", "tensor-interval",
             [](model::Quality& quality) { quality.intersection = model::Intersection::kTensorInterval; }},
            {"tensor-affine", "tensor-affine",
             [](model::Quality& quality) { quality.intersection = model::Intersection::kTensorAffine; }}};
}

model::ShImage stiffnessGlyphs(std::size_t glyphs) {
    model::ShImage field = stiffnessImage({});
    if (field.voxels.size() < glyphs) {
        throw Error(Code::kInternal, "the stiffness field has " + std::to_string(field.voxels.size()) + " glyphs");
    }
    field.voxels.resize(glyphs);
    field.coefficients.resize(glyphs * field.layout.count());
    field.tensors.resize(glyphs * symmetricCount(field.tensor_order));
    return field;
}

}  // namespace radiata::lab
