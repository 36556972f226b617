#include "common/tensor_options.h"

#include <map>

namespace radiata::client {

void addTensorOptions(CLI::App& app, TensorOptions& options) {
    const std::map<std::string, v1::TensorShape> shapes{{"reynolds", v1::TENSOR_SHAPE_REYNOLDS},
                                                        {"ellipsoid", v1::TENSOR_SHAPE_ELLIPSOID}};
    app.add_option_function<std::string>(
           "--tensor-glyphs", [&options, shapes](const std::string& word) { options.shape = shapes.at(word); },
           "A layer of tensor glyphs: Reynolds glyphs of any order, or ellipsoids of order 2")
        ->check(CLI::IsMember({"reynolds", "ellipsoid"}));
    v1::TensorMarch& march = options.march;
    app.add_option_function<float>(
        "--tensor-step", [&march](float value) { march.set_step(value); },
        "Step of tensor-march in radii of the glyph's sphere, 0.001 to 0.5 (default 0.02)");
    app.add_option_function<std::uint32_t>(
        "--tensor-bisections", [&march](std::uint32_t value) { march.set_bisections(value); },
        "Bisections of the last bracket by the tensor methods, 0 to 3 (default 0)");
    app.add_option_function<bool>(
        "--tensor-interpolate", [&march](bool value) { march.set_interpolate(value); },
        "Whether a linear interpolation follows them (default true)");
    app.add_option_function<bool>(
        "--tensor-adaptive", [&march](bool value) { march.set_adaptive(value); },
        "Whether tensor-march takes steps of a third near the centre (default true)");
    app.add_option_function<std::uint32_t>(
        "--tensor-depth", [&march](std::uint32_t value) { march.set_depth(value); },
        "Halvings of a ray by tensor-interval and tensor-affine, 4 to 16 (default 12)");
}

v1::GlyphLayer& glyphsOf(v1::Layer& layer, const TensorOptions& options) {
    if (!options.shape) return *layer.mutable_glyphs();
    layer.mutable_tensor_glyphs()->set_shape(*options.shape);
    return *layer.mutable_tensor_glyphs()->mutable_glyphs();
}

v1::GlyphLayer& glyphsOf(v1::Layer& layer) {
    return layer.has_tensor_glyphs() ? *layer.mutable_tensor_glyphs()->mutable_glyphs() : *layer.mutable_glyphs();
}

}  // namespace radiata::client
