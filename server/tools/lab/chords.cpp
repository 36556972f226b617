#include "tools/lab/chords.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <random>

#include "base/parallel.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"
#include "gpu/recorder.h"
#include "reference/cubic.h"
#include "shaders/modules.h"
#include "shaders/test/isosurface_io.glsl"

namespace radiata::lab {
namespace {

constexpr std::size_t kPart = 250'000;
constexpr std::uint32_t kGroup = 64;

glm::vec3 onFace(std::mt19937& random, std::uint32_t face) {
    std::uniform_real_distribution<float> unit(0, 1);
    glm::vec3 p(unit(random), unit(random), unit(random));
    p[static_cast<int>(face / 2)] = face % 2 ? 1.0F : 0.0F;
    return p;
}

shader::CubicInput randomChord(std::mt19937& random, std::size_t kind) {
    std::uniform_real_distribution<float> unit(0, 1), sign(-1, 1);
    shader::CubicInput x{};
    x.isovalue = kind == 2 ? 1000 + 20 * sign(random) : 0;
    const glm::vec3 slope(sign(random), sign(random), sign(random));
    const float offset = -glm::dot(slope, glm::vec3(unit(random), unit(random), unit(random)));
    for (int n = 0; n < 8; ++n) {
        const float planar = glm::dot(slope, glm::vec3(n & 1, n >> 1 & 1, n >> 2)) + offset;
        const float noise = sign(random);
        x.corners[n] = kind == 0 ? noise : kind == 1 ? planar + 1e-3F * noise : 1000 + std::round(60 * noise);
    }
    const auto first = static_cast<std::uint32_t>(random() % 6);
    const std::uint32_t second = (first + 1 + static_cast<std::uint32_t>(random() % 5)) % 6;
    x.from = onFace(random, first);
    x.to = onFace(random, second);
    return x;
}

/// The roots that the device finds. \return ms of device time
double trace(gpu::Device& device, const gpu::ComputePipeline& pipeline, const std::vector<shader::CubicInput>& chords,
             std::vector<float>& roots) {
    struct Push {
        std::uint64_t inputs, outputs, shared_values;
        std::uint32_t count, padding = 0;
    };
    const gpu::Buffer inputs(device, std::as_bytes(std::span(chords)).size(), gpu::Memory::kDevice, "chords");
    const gpu::Buffer outputs(device, chords.size() * sizeof(float), gpu::Memory::kDevice, "roots");
    gpu::upload(device, inputs, 0, std::as_bytes(std::span(chords)));
    const auto count = static_cast<std::uint32_t>(chords.size());
    gpu::CommandRecorder recorder(device);
    recorder.dispatch(pipeline, "cubic", (count + kGroup - 1) / kGroup, 1, 1,
                      Push{inputs.address(), outputs.address(), inputs.address(), count});
    recorder.submitAndWait();
    roots.resize(chords.size());
    gpu::download(device, outputs, 0, std::as_writable_bytes(std::span(roots)));
    return recorder.takeTimings().at(0).time_ms;
}

/// Adds what one chord shows.
void compare(const shader::CubicInput& x, float root, ChordErrors& errors) {
    std::array<double, 8> corners{};
    double largest = 0;
    for (std::size_t n = 0; n < 8; ++n) {
        corners[n] = static_cast<double>(x.corners[n]);
        largest = std::max(largest, std::abs(corners[n]));
    }
    // Less than this is within the rounding of the corners in float: neither a hit nor its absence is wrong.
    const double rounding = 2e-6 * (1 + 0.02 * largest), isovalue = static_cast<double>(x.isovalue);
    const glm::dvec3 from(x.from), to(x.to);
    const auto expected = reference::firstChordRoot(corners, isovalue, from, to);
    if (root >= 0 && !expected) {
        const double value = reference::cellValue(corners, glm::mix(from, to, static_cast<double>(root))) - isovalue;
        errors.invented += std::abs(value) > rounding ? 1 : 0;
    }
    if (!expected || expected->margin < rounding) return;
    ++errors.hits;
    if (root < 0) {
        ++errors.missed;
        return;
    }
    errors.cells.push_back(std::abs(static_cast<double>(root) - expected->u) * glm::length(to - from));
    const double ends = (reference::cellValue(corners, from) - isovalue) * (reference::cellValue(corners, to) - isovalue);
    errors.even += ends > 0 ? 1 : 0;
}

}  // namespace

ChordErrors measureChords(gpu::Device& device, std::uint64_t count) {
    const shaders::Module& module = shaders::module("test_cubic");
    const gpu::ComputePipeline pipeline(device, gpu::Shader{module.name, module.spirv}, std::vector<std::uint32_t>{kGroup});
    ChordErrors all;
    double device_ms = 0;
    std::uint64_t done = 0;
    for (std::uint32_t part = 0; done < count; ++part) {
        std::mt19937 random(101 + part);
        std::vector<shader::CubicInput> chords(std::min<std::uint64_t>(kPart, count - done));
        for (std::size_t i = 0; i < chords.size(); ++i) chords[i] = randomChord(random, i % 3);
        std::vector<float> roots;
        device_ms += trace(device, pipeline, chords, roots);
        std::mutex mutex;
        parallelFor(chords.size(), 10'000, [&](std::size_t begin, std::size_t end) {
            ChordErrors own;
            for (std::size_t i = begin; i < end; ++i) compare(chords[i], roots[i], own);
            const std::lock_guard lock(mutex);
            all.hits += own.hits;
            all.missed += own.missed;
            all.invented += own.invented;
            all.even += own.even;
            all.cells.insert(all.cells.end(), own.cells.begin(), own.cells.end());
        });
        done += chords.size();
    }
    all.ns_per_chord = 1e6 * device_ms / static_cast<double>(done);
    return all;
}

}  // namespace radiata::lab
