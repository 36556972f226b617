#include "plan/tensor_methods.h"

#include <bit>

#include "base/error.h"

namespace radiata::plan {

std::string_view tensorMethodName(model::Intersection method) {
    if (method == model::Intersection::kTensorMarch) return "tensor-march";
    if (method == model::Intersection::kTensorInterval) return "tensor-interval";
    if (method == model::Intersection::kTensorAffine) return "tensor-affine";
    return {};
}

bool drawsTensors(model::Intersection method) { return !tensorMethodName(method).empty(); }

std::string tensorShader(const model::GlyphLayer& layer, const std::string& where, int order, model::Intersection method) {
    if (layer.tensor && order == 0) {
        throw Error(Code::kInvalidArgument, where + " is a layer of tensor glyphs, but dataset '" + layer.dataset_id +
                                                "' holds spherical harmonics; draw it as a layer of glyphs");
    }
    if (layer.tensor == model::TensorShape::kEllipsoid) {
        if (order != 2) {
            throw Error(Code::kInvalidArgument, where + ".shape is ellipsoid, but dataset '" + layer.dataset_id +
                                                    "' has tensors of order " + std::to_string(order) +
                                                    "; only order 2 has ellipsoids, reynolds draws every order");
        }
        return "ellipsoid";
    }
    if (!drawsTensors(method)) return {};
    const std::string name(tensorMethodName(method));
    if (order == 0) {
        throw Error(Code::kUnsupported, where + ": " + name + " draws Cartesian tensors, but dataset '" + layer.dataset_id +
                                            "' holds spherical harmonics; use the march");
    }
    if (order % 2 != 0) {
        throw Error(Code::kUnsupported, where + ": " + name + " draws tensors of even order 2 to 12, dataset '" +
                                            layer.dataset_id + "' has order " + std::to_string(order) +
                                            "; use the march, which draws its bands");
    }
    if (layer.lmax && *layer.lmax < order) {
        throw Error(Code::kInvalidArgument, where + ".lmax is " + std::to_string(*layer.lmax) + ", but " + name +
                                                " draws whole tensors, here of order " + std::to_string(order) +
                                                "; leave lmax out or use the march");
    }
    return "tensor" + std::to_string(order);
}

std::vector<std::uint32_t> tensorConstants(const model::Quality& quality) {
    const model::TensorMarchSettings& settings = quality.tensor_march;
    const auto method =
        static_cast<std::uint32_t>(quality.intersection) - static_cast<std::uint32_t>(model::Intersection::kTensorMarch);
    return {method,
            std::bit_cast<std::uint32_t>(settings.step),
            static_cast<std::uint32_t>(settings.bisections),
            settings.interpolate ? 1U : 0U,
            settings.adaptive ? 1U : 0U,
            static_cast<std::uint32_t>(settings.depth)};
}

}  // namespace radiata::plan
