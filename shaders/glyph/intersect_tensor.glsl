// Glyphs of Cartesian tensors by the methods of Hlawitschka et al., on the components themselves: fixed steps (tensor-march), intervals
// (tensor-interval), reduced affine forms (tensor-affine). Included by intersect.glsl in place of the march where METHOD_TENSOR is defined.
// Lengths are divided by the glyph's certified radius, which is the paper's bounding sphere.
#include "shaders/common/range_arithmetic.glsl"
#include "tensor.glsl"
#include "shaders/common/tensor_march.glsl"
#include "shaders/common/tensor_ranges.glsl"

layout(constant_id = 9) const uint kTensorMethod = 0u;  // 0: fixed steps, 1: intervals, 2: affine forms
layout(constant_id = 10) const float kTensorStep = 0.02;
layout(constant_id = 11) const uint kTensorBisections = 0u;
layout(constant_id = 12) const bool kTensorInterpolate = true;
layout(constant_id = 13) const bool kTensorAdaptive = true;
layout(constant_id = 14) const uint kTensorDepth = 12u;

float tensor_components[TENSOR_COUNT];
uint loaded_tensor = 0xffffffffu;

void loadTensor(GlyphLayerParams layer, uint slot) {
    if (slot == loaded_tensor) return;
    loaded_tensor = slot;
    FloatBuffer source = FloatBuffer(layer.tensors + uint64_t(slot) * uint64_t(TENSOR_COUNT * 4));
    for (uint i = 0u; i < TENSOR_COUNT; ++i) tensor_components[i] = source.at[i];
}

void intersectInstance(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre) {
    const float unit = 1.0 / instance.radius;
    const vec3 origin = (ray.origin - centre) * unit;
    // The sphere first: components are read for rays that meet it only.
    if (rayPlane(origin, ray.direction).h >= 1.0) return;
    loadTensor(layer, instance.slot);
    float weights[TENSOR_COUNT];
    tensorWeights(tensor_components, instance.scale * unit, weights);
    const TensorSettings settings =
        TensorSettings(kTensorStep, kTensorBisections, kTensorInterpolate, kTensorAdaptive, kTensorDepth);
    TensorHit hit;
    if (kTensorMethod == 0u) {
        hit = tensorMarch(weights, origin, ray.direction, ray.near * unit, kBothLobes, settings);
    } else {
        hit = tensorRangeMarch(weights, origin, ray.direction, ray.near * unit, kBothLobes, settings, kTensorMethod == 2u);
    }
    total_steps += hit.steps;
    capped_rays += hit.capped ? 1u : 0u;
    const float t = hit.t * instance.radius;
    if (hit.value != 0.0 && (t < best_t || (t == best_t && index < best_instance))) {
        best_t = t;
        best_instance = index;
        best_direction = normalize(origin + hit.t * ray.direction);
    }
}

// \param p  unit, from the centre to the surface. \return unit, away from the inside
vec3 methodNormal(GlyphLayerParams layer, uint index, vec3 p) {
    loadTensor(layer, InstanceBuffer(layer.instances).at[index].slot);
    float weights[TENSOR_COUNT];
    tensorWeights(tensor_components, 1.0, weights);
    return glyphNormal(tensorEvaluateGradient(weights, p), p);
}
