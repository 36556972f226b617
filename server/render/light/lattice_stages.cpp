// Lighting of requested texels in stages that double, and what is known of their error.
#include <algorithm>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>

#include <glm/gtc/packing.hpp>

#include "gpu/device.h"
#include "math/low_discrepancy.h"
#include "render/light/lattice.h"

namespace radiata::render {
namespace {

using Clock = std::chrono::steady_clock;

/// Paths of one replicate in one dispatch, at most: a submission stays short for texels of many samples too.
constexpr std::uint32_t kPathsPerDispatch = 16;
constexpr double kSubmissionMs = 20;
/// Seed of every lattice: equal requests give equal texels.
constexpr std::uint32_t kSeed = 0x57a7e115U;

std::uint32_t stageOf(std::uint32_t state) { return (state >> shader::TEXEL_STAGE_SHIFT) & shader::TEXEL_STAGE_MASK; }

}  // namespace

/// Samples that a texel's payload is the mean of.
std::uint32_t texelSamples(std::uint32_t state) {
    const std::uint32_t stage = stageOf(state);
    return stage == 0 || (state & shader::TEXEL_EMPTY) != 0 ? 0 : 1U << (stage - 1);
}

float texelError(std::uint32_t state) { return glm::unpackHalf1x16(static_cast<std::uint16_t>(state & 0xffffU)); }

bool IlluminationLattice::isExact(std::uint32_t state) const {
    if ((state & shader::TEXEL_EMPTY) != 0) return true;
    return texelSamples(state) >= kLeastSamples && texelError(state) <= light_.relative_error;
}

bool IlluminationLattice::isDone(std::uint32_t state) const {
    return isExact(state) || texelSamples(state) >= static_cast<std::uint32_t>(light_.samples_max);
}

/// One stage's paths for texels [begin, end) of active_, in bounded dispatches.
void IlluminationLattice::lightBatch(const LatticeRun& run, std::size_t begin, std::size_t end) {
    struct Push {
        std::uint64_t lattice, items, sums;
        std::uint32_t first_item, item_end, first_path, path_end, stage_end, seed;
    };
    const auto count = static_cast<std::uint32_t>(end - begin);
    auto* items = reinterpret_cast<shader::TexelItem*>(items_.mapped().data() + 4);
    std::uint32_t first = stage_paths_;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Texel& texel = requested_[active_[begin + i]];
        items[i] = texel.item;
        items[i].coverage = texel.row;
        items[i].state = texel.paths;
        first = std::min(first, texel.paths);
    }
    const gpu::ComputePipeline& pipeline = run.pipeline("isosurface_light_texels", constants());
    for (std::uint32_t path = first; path < stage_paths_;) {
        run.checkCancelled();
        const std::uint32_t path_end = std::min(stage_paths_, path + kPathsPerDispatch);
        run.recorder.dispatch(
            pipeline, "illumination texels", (count + 63) / 64, 1, 1,
            Push{params_.address(), items_.address() + 4, sums_.address(), 0, count, path, path_end, stage_paths_, kSeed});
        const auto before = Clock::now();
        run.recorder.submitAndWait();
        const double took_ms = std::chrono::duration<double, std::milli>(Clock::now() - before).count();
        seconds_ += took_ms / 1000;
        if (run.spent != nullptr) run.spent->seconds += took_ms / 1000;
        // As if all texels had the paths of a full dispatch.
        const double full = took_ms * kPathsPerDispatch / (path_end - path);
        const double wished = count * kSubmissionMs / std::max(full, 1e-3);
        items_per_batch_ = std::clamp(wished, 0.5 * items_per_batch_, 2 * items_per_batch_);
        items_per_batch_ = std::clamp(items_per_batch_, 64.0, 65536.0);
        path = path_end;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        Texel& texel = requested_[active_[begin + i]];
        const std::uint64_t followed = std::uint64_t{stage_paths_ - texel.paths} * kReplicates;
        samples_ += followed;
        if (run.spent != nullptr) run.spent->samples += followed;
        texel.item.state = items[i].state;
        texel.paths = stage_paths_;
    }
}

bool IlluminationLattice::refine(const LatticeRun& run, std::optional<Clock::time_point> until) {
    while (!active_.empty()) {
        for (; cursor_ < active_.size();) {
            if (until && Clock::now() >= *until) return false;
            // Texels that have as many samples from an earlier request wait for the stage that gives them more.
            std::size_t end = cursor_;
            const auto batch = static_cast<std::size_t>(
                std::max(items_per_batch_ * kPathsPerDispatch / std::clamp(stage_paths_, 1U, kPathsPerDispatch), 64.0));
            const auto waits = [&](std::size_t i) {
                return texelSamples(requested_[active_[i]].item.state) >= stage_paths_ * kReplicates;
            };
            while (cursor_ < active_.size() && waits(cursor_)) ++cursor_;
            for (end = cursor_; end < active_.size() && end - cursor_ < batch && !waits(end);) ++end;
            if (cursor_ == end) continue;
            lightBatch(run, cursor_, end);
            cursor_ = end;
        }
        std::erase_if(active_, [&](std::uint32_t i) { return isDone(requested_[i].item.state); });
        std::ranges::stable_sort(active_, [&](std::uint32_t a, std::uint32_t b) {
            return texelError(requested_[a].item.state) > texelError(requested_[b].item.state);
        });
        cursor_ = 0;
        stage_paths_ *= 2;
        if (active_.empty()) freeWorking();
    }
    return true;
}

void IlluminationLattice::lightFirst(const LatticeRun& run) {
    if (active_.empty() || stage_paths_ > kFirstStageSamples / kReplicates) return;
    const std::uint32_t first = stage_paths_;
    // refine() sorts by error after a stage; the first one alone ends here.
    while (cursor_ < active_.size() && stage_paths_ == first) {
        const auto waits = [&](std::size_t i) { return texelSamples(requested_[active_[i]].item.state) > 0; };
        while (cursor_ < active_.size() && waits(cursor_)) ++cursor_;
        std::size_t end = cursor_;
        const auto batch = static_cast<std::size_t>(items_per_batch_ * kPathsPerDispatch);
        while (end < active_.size() && end - cursor_ < batch && !waits(end)) ++end;
        if (end > cursor_) lightBatch(run, cursor_, end);
        cursor_ = end;
    }
}

model::IlluminationInfo IlluminationLattice::info() const {
    model::IlluminationInfo info;
    info.texels =
        static_cast<std::uint64_t>(size_.x) * static_cast<std::uint64_t>(size_.y) * static_cast<std::uint64_t>(size_.z);
    info.texels_needed = requested_.size();
    info.bricks_left_out = left_out_;
    info.seconds = seconds_;
    info.samples = samples_;
    info.bytes = pool_.bytes();
    for (const gpu::Buffer* buffer : {&coverage_, &items_, &sums_}) info.bytes += *buffer ? buffer->sizeBytes() : 0;
    info.payload_bytes = pool_.payloadBytes();
    info.projected = projected_;
    info.texels_read = texels_read_;
    info.saved = saved_;
    if (light_.full) return wholeInfo(info);
    std::vector<float> errors;
    for (const Texel& texel : requested_) {
        info.texels_done += isDone(texel.item.state);
        info.texels_out_of_samples += isDone(texel.item.state) && !isExact(texel.item.state);
        if (texelSamples(texel.item.state) > 0) errors.push_back(texelError(texel.item.state));
    }
    if (errors.empty()) return info;
    for (const float error : errors) info.mean_error += static_cast<double>(error) / static_cast<double>(errors.size());
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size() - 1));
    std::ranges::nth_element(errors, at);
    info.p95_error = *at;
    return info;
}

void IlluminationLattice::gather(const LatticeRun& run, const LatticePixels& pixels, std::uint64_t light_address,
                                 const std::string& pass, bool settled) {
    struct Push {
        std::uint64_t frame, layer, surface, lattice, light, lacking;
    };
    lacking_.as<std::uint32_t>()[0] = 0;
    run.recorder.dispatch(
        run.pipeline("isosurface_gather_light",
                     {64U, static_cast<std::uint32_t>(light_.interpolation), settled ? 1U : 0U, projected_ ? 1U : 0U}),
        pass, (pixels.pixels + 63) / 64, 1, 1,
        Push{pixels.frame, pixels.layer, pixels.surface, params_.address(), light_address, lacking_.address()});
}

std::optional<std::uint64_t> IlluminationLattice::rowOf(const glm::ivec3& texel) const {
    constexpr int kEdge = static_cast<int>(shader::TEXEL_BRICK_EDGE);
    const glm::ivec3 brick = texel / kEdge, at = texel % kEdge;
    return pool_.rowOf(static_cast<std::uint32_t>(brick.x + bricks_.x * (brick.y + bricks_.y * brick.z)),
                       static_cast<std::uint32_t>(at.x + kEdge * (at.y + kEdge * at.z)));
}

double IlluminationLattice::relativeError(gpu::Device& device, const glm::ivec3& texel) const {
    std::uint32_t state = 0;
    if (const auto row = rowOf(texel)) {
        gpu::download(device, pool_.state(), *row * 4, std::as_writable_bytes(std::span(&state, 1)));
    }
    return texelSamples(state) > 0 ? texelError(state) : std::numeric_limits<double>::infinity();
}

std::vector<float> IlluminationLattice::payload(gpu::Device& device, const glm::ivec3& texel) const {
    const auto at = rowOf(texel);
    if (!at) return {};
    const std::uint64_t row = *at;
    const std::size_t count = shared().stride;
    std::uint32_t state = 0;
    gpu::download(device, pool_.state(), row * 4, std::as_writable_bytes(std::span(&state, 1)));
    if (texelSamples(state) == 0) return {};
    if (light_.storage == model::TexelStorage::kRgb8) {
        glm::u8vec4 bytes;
        gpu::download(device, pool_.payload(), row * 4, std::as_writable_bytes(std::span(&bytes, 1)));
        const glm::vec3 root = glm::vec3(bytes) / 255.0F,
                        irradiance = root * root * (std::numbers::pi_v<float> * shared().rgb8_scale);
        return {irradiance.x, irradiance.y, irradiance.z};
    }
    std::vector<float> values(count);
    if (light_.storage == model::TexelStorage::kFloat32) {
        gpu::download(device, pool_.payload(), row * count * 4, std::as_writable_bytes(std::span(values)));
        return values;
    }
    const std::size_t words = (count + 1) / 2;
    std::vector<std::uint16_t> halves(2 * words);
    gpu::download(device, pool_.payload(), row * words * 4, std::as_writable_bytes(std::span(halves)));
    for (std::size_t i = 0; i < count; ++i) values[i] = glm::unpackHalf1x16(halves[i]);
    return values;
}

}  // namespace radiata::render
