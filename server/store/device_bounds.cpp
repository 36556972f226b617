#include "store/device_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "build/bounds_certificate.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "math/sh_evaluate.h"
#include "shaders/modules.h"

namespace radiata::store {
namespace {

constexpr std::uint32_t kGroup = 64;
constexpr std::uint32_t kGlyphsPerGroup = 4;
/// Products per submission: some milliseconds on a GPU, some tens on a CPU driver.
constexpr double kProducts = 2e8;
/// Largest coefficients whose reciprocal and products stay in float's normal range; others are left to the CPU.
constexpr double kSmallest = 1e-30, kLargest = 1e30;

struct Push {
    std::uint64_t coefficients, slots, unit, table, extremes;
    std::uint32_t glyphs, stride, directions, first;
};

gpu::Buffer uploaded(gpu::Device& device, std::span<const std::byte> bytes, const char* name) {
    gpu::Buffer buffer(device, bytes.size(), gpu::Memory::kDevice, name);
    gpu::upload(device, buffer, 0, bytes);
    return buffer;
}

std::vector<float> basisTable(const BoundsEvaluator& evaluator) {
    const std::vector<glm::dvec3>& directions = evaluator.directions();
    const std::size_t count = evaluator.layout().count(), n = directions.size();
    std::vector<float> table((count + 3) * n);
    std::vector<double> basis(count);
    for (std::size_t i = 0; i < n; ++i) {
        evaluateSh(evaluator.layout(), directions[i], basis);
        for (std::size_t axis = 0; axis < 3; ++axis)
            table[axis * n + i] = static_cast<float>(directions[i][static_cast<int>(axis)]);
        for (std::size_t j = 0; j < count; ++j) table[(j + 3) * n + i] = static_cast<float>(basis[j]);
    }
    return table;
}

/// What certifyBounds() needs beside the samples; unit is the reciprocal that the shader multiplies by.
struct Scales {
    std::vector<BoundsSamples> samples;
    std::vector<float> unit;
    std::vector<bool> extreme;  ///< too large or small for the shader
};

Scales scalesOf(std::span<const float> host, std::size_t stride, std::span<const std::uint32_t> slots, std::size_t count) {
    Scales scales;
    for (const std::uint32_t slot : slots) {
        double largest = 0, squares = 0;
        for (const float c : host.subspan(slot * stride, count)) {
            if (!std::isfinite(c)) throw Error(Code::kInvalidArgument, "glyph bounds: a coefficient is not finite");
            largest = std::max(largest, std::abs(static_cast<double>(c)));
        }
        const bool usual = largest > kSmallest && largest < kLargest;
        const float unit = usual ? static_cast<float>(1 / largest) : 1.0F;
        for (const float c : host.subspan(slot * stride, count)) squares += std::pow(static_cast<double>(c) * unit, 2);
        scales.samples.push_back({{}, std::sqrt(squares), 1 / static_cast<double>(unit)});
        scales.unit.push_back(unit);
        scales.extreme.push_back(!usual);
    }
    return scales;
}

}  // namespace

DeviceBounds::DeviceBounds(gpu::Device& device, ShLayout layout) : device_(device), evaluator_(layout) {
    table_ = uploaded(device, std::as_bytes(std::span<const float>(basisTable(evaluator_))), "basis for glyph bounds");
    const shaders::Module& module = shaders::module("glyph_bounds");
    const std::array<std::uint32_t, 2> constants{kGroup, static_cast<std::uint32_t>(layout.count())};
    pipeline_ = gpu::ComputePipeline(device, {module.name, module.spirv}, constants);
}

std::vector<GlyphBounds> DeviceBounds::evaluate(const gpu::Buffer& coefficients, std::span<const float> host,
                                                std::size_t stride, std::span<const std::uint32_t> slots, bool negative_lobes) {
    std::vector<GlyphBounds> bounds(slots.size());
    time_ms_ = 0;
    if (slots.empty()) return bounds;
    const ShLayout layout = evaluator_.layout();
    const std::size_t count = layout.count(), directions = evaluator_.directions().size();
    Scales scales = scalesOf(host, stride, slots, count);
    const gpu::Buffer slot_buffer = uploaded(device_, std::as_bytes(slots), "slots for glyph bounds");
    const gpu::Buffer unit_buffer =
        uploaded(device_, std::as_bytes(std::span<const float>(scales.unit)), "units for glyph bounds");
    const gpu::Buffer extremes(device_, slots.size() * sizeof(shader::GlyphExtremes), gpu::Memory::kReadback, "glyph extremes");
    gpu::CommandRecorder recorder(device_);
    const auto glyphs = static_cast<std::uint32_t>(slots.size());
    const double per_group = kGlyphsPerGroup * static_cast<double>(count) * static_cast<double>(directions);
    const auto groups_most = static_cast<std::uint32_t>(std::clamp(kProducts / per_group, 1.0, 60000.0));
    for (std::uint32_t first = 0; first < glyphs;) {
        const std::uint32_t groups = std::min(groups_most, (glyphs - first + kGlyphsPerGroup - 1) / kGlyphsPerGroup);
        recorder.dispatch(
            pipeline_, "glyph bounds", groups, 1, 1,
            Push{coefficients.address(), slot_buffer.address(), unit_buffer.address(), table_.address(), extremes.address(),
                 glyphs, static_cast<std::uint32_t>(stride), static_cast<std::uint32_t>(directions), first});
        recorder.submitAndWait();
        first += groups * kGlyphsPerGroup;
    }
    for (const gpu::PassTiming& timing : recorder.takeTimings()) time_ms_ += timing.time_ms;
    const std::span<const shader::GlyphExtremes> found = extremes.as<shader::GlyphExtremes>();
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (scales.extreme[i]) {
            evaluator_.evaluate(host.subspan(slots[i] * stride, count), negative_lobes, {&bounds[i], 1});
            continue;
        }
        scales.samples[i].extremes = found[i];
        bounds[i] = certifyBounds(layout, evaluator_.coveringRadius(), scales.samples[i], negative_lobes);
    }
    return bounds;
}

}  // namespace radiata::store
