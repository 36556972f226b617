#include "render/light/lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "base/error.h"
#include "gpu/device.h"
#include "math/low_discrepancy.h"
#include "render/light/lattice_key.h"
#include "render/light/transport_params.h"

namespace radiata::render {
namespace {

constexpr int kEdge = static_cast<int>(shader::TEXEL_BRICK_EDGE);

/// What the estimates of irradiance depend on.
bool sameLight(const model::Illumination& a, const model::Illumination& b) {
    return a.sky == b.sky && a.suns == b.suns && a.lights == b.lights && a.environment == b.environment &&
           a.rotation == b.rotation;
}

}  // namespace

void LatticeRun::checkCancelled() const {
    if (cancel != nullptr && *cancel) throw Error(Code::kCancelled, "nobody waits for this picture any more");
}

bool IlluminationLattice::sameTexels(const model::Illumination& a, const model::Illumination& b) {
    return a.payload == b.payload && a.storage == b.storage && a.resolution == b.resolution && a.bounces == b.bounces &&
           a.sampling == b.sampling && a.budget_mib == b.budget_mib &&
           (a.payload == model::TexelPayload::kIrradiance || a.orders == b.orders);
}

IlluminationLattice::IlluminationLattice(gpu::Device& device, std::shared_ptr<const store::VolumeDataset> volume,
                                         const model::Illumination& light, bool projected)
    : device_(device),
      volume_(std::move(volume)),
      light_(light),
      projected_(projected),
      size_(latticeSize(volume_->params().size, light.resolution)),
      bricks_((size_ + (kEdge - 1)) / kEdge),
      pool_(device, latticeProduct(bricks_), texelBytes(light),
            static_cast<std::uint64_t>(double{light.budget_mib} * 1048576)) {
    pool_.keepWhole(light.full);
    params_ = gpu::Buffer(device, sizeof(shader::LatticeParams), gpu::Memory::kUpload, "lattice");
    lacking_ = gpu::Buffer(device, 16, gpu::Memory::kReadback, "lattice lacks");
    if (latticeProduct(size_) >> 32 != 0) {
        throw Error(Code::kUnsupported, "an illumination lattice of " + std::to_string(latticeProduct(size_)) +
                                            " texels; 2^32 is the limit: choose a lower resolution");
    }
    shader::LatticeParams& lattice = shared();
    lattice = transportParams(*volume_, light);
    lattice.size = size_;
    lattice.brick_size = bricks_;
    lattice.voxels_per_texel = static_cast<float>(voxelsPerTexel(light.resolution));
    lattice.stride = static_cast<std::uint32_t>(light.payloadCount());
    for (std::size_t k = 0; k < light.orders.size(); ++k)
        lattice.orders |= static_cast<std::uint32_t>(light.orders[k]) << (4 * k);
    lattice.projected = projected ? 1 : 0;
    lattice.random_paths = light.sampling == model::TexelSampling::kRandom ? 1 : 0;
    refreshAddresses();
}

std::vector<std::uint32_t> IlluminationLattice::constants() const {
    return {64U, light_.payload == model::TexelPayload::kTransfer ? 1U : 0U, static_cast<std::uint32_t>(light_.storage)};
}

void IlluminationLattice::refreshAddresses() {
    shader::LatticeParams& lattice = shared();
    const auto address = [](const gpu::Buffer& buffer) { return buffer ? buffer.address() : 0; };
    lattice.index = pool_.index();
    lattice.wanted = pool_.wanted();
    lattice.coverage = address(coverage_);
    lattice.places = pool_.places();
    lattice.state = address(pool_.state());
    lattice.payload = address(pool_.payload());
    lattice.shown = address(pool_.shown());
}

bool IlluminationLattice::update(const LatticeRun& run, const model::Illumination& light,
                                 const std::shared_ptr<const model::EnvironmentMap>& map, const glm::vec3& albedo,
                                 float isovalue) {
    const bool new_light = !lit_ || !sameLight(light, light_) || map != map_;
    const bool new_albedo = !lit_ || albedo != albedo_;
    const bool irradiance = light.payload == model::TexelPayload::kIrradiance;
    const bool one_colour = light.storage == model::TexelStorage::kRgb8;
    const bool drop =
        lit_ && ((new_light && irradiance) || (new_albedo && one_colour) || (projected_ && isovalue != isovalue_));
    const bool harder = light.relative_error < light_.relative_error || light.samples_max > light_.samples_max;
    const bool other_stop = light.relative_error != light_.relative_error || light.samples_max != light_.samples_max;
    light_ = light;
    map_ = map;
    albedo_ = albedo;
    isovalue_ = isovalue;
    shader::LatticeParams& lattice = shared();
    lattice.albedo = albedo;
    lattice.isovalue = isovalue;
    lattice.relative_error = light.relative_error;
    lattice.samples_least = kLeastSamples;
    lattice.samples_max = static_cast<std::uint32_t>(light.samples_max);
    if (new_light) {
        light_buffers_ = std::make_unique<LatticeLightBuffers>(device_, light, map.get(), *volume_, light_buffers_.get());
        lattice.light = light_buffers_->params();
        lattice.rgb8_scale = std::max(light_buffers_->radianceMax(), 1e-20F);
        lattice.irradiance_floor = std::max(0.01F * light_buffers_->openIrradiance(), 1e-20F);
    }
    if (drop || harder) {
        requested_.clear();
        active_.clear();
        requested_for_ = 0;
        whole_ = {};
    }
    const bool empty = !lit_ || drop;
    if (drop) {
        dropTexels();
    } else if (lit_ && (new_light || new_albedo || other_stop)) {
        relight(run);
    }
    if (pool_.slotsUsed() == 0) pool_.keepWhole(light.full);
    lit_ = true;
    return empty;
}

void IlluminationLattice::dropTexels() {
    pool_.clear();
    pool_.keepWhole(light_.full);
    freeWorking();
    requested_.clear();
    active_.clear();
    requested_for_ = 0;
    whole_ = {};
    texels_read_ = 0;
    saved_.clear();
}

std::uint64_t IlluminationLattice::brickCount() const { return latticeProduct(bricks_); }

std::uint64_t IlluminationLattice::payloadBytes() const { return texelBytes(light_); }

void IlluminationLattice::relight(const LatticeRun& run) {
    struct Push {
        std::uint64_t lattice;
        std::uint32_t rows;
    };
    const std::uint32_t rows = pool_.rowsUsed();
    if (rows == 0) return;
    run.recorder.dispatch(run.pipeline("isosurface_relight", constants()), "illumination relight", (rows + 63) / 64, 1, 1,
                          Push{params_.address(), rows});
    run.recorder.submitAndWait();
}

void IlluminationLattice::request(const LatticeRun& run, const LatticePixels& pixels, std::uint64_t number) {
    struct Push {
        std::uint64_t frame, layer, surface, lattice;
    };
    run.checkCancelled();
    requested_for_ = 0;
    requested_.clear();
    active_.clear();
    const Push push{pixels.frame, pixels.layer, pixels.surface, params_.address()};
    pool_.beginRequest();
    refreshAddresses();
    const auto interpolation = static_cast<std::uint32_t>(light_.interpolation);
    const std::uint32_t groups = (pixels.pixels + 63) / 64;
    run.recorder.dispatch(run.pipeline("isosurface_request_texels", {64U, interpolation, 1U}), "illumination request", groups,
                          1, 1, push);
    run.recorder.submitAndWait();
    left_out_ = pool_.admit(run.recorder);
    refreshAddresses();
    requested_for_ = number;
    if (pool_.slotsUsed() == 0) return freeWorking();
    clearCoverage(run);
    run.recorder.dispatch(run.pipeline("isosurface_request_texels", {64U, interpolation, 0U}), "illumination request", groups,
                          1, 1, push);
    list(run);
}

void IlluminationLattice::clearCoverage(const LatticeRun& run) {
    const std::uint64_t bytes = std::uint64_t{pool_.slotsUsed()} * shader::TEXELS_PER_BRICK * 4;
    if (!coverage_ || coverage_.sizeBytes() < bytes) {
        coverage_ = gpu::Buffer(device_, bytes + bytes / 8, gpu::Memory::kDevice, "lattice coverage");
        refreshAddresses();
    }
    run.recorder.fill(coverage_, 0, bytes, 0);
}

/// What is not needed once texels are done is more than the texels.
void IlluminationLattice::freeWorking() {
    for (gpu::Buffer* buffer : {&coverage_, &items_, &sums_}) *buffer = gpu::Buffer();
    pool_.endRequest();
    refreshAddresses();
}

/// Reads the texels with coverage back.
void IlluminationLattice::list(const LatticeRun& run) {
    struct Push {
        std::uint64_t lattice, items, bricks;
        std::uint32_t rows, capacity;
    };
    const std::uint32_t rows = pool_.rowsUsed();
    std::uint32_t count = std::min<std::uint32_t>(rows, 65536);
    for (std::uint32_t capacity = 0; count > capacity;) {
        if (!items_ || items_.sizeBytes() < 4 + count * sizeof(shader::TexelItem)) {
            items_ = gpu::Buffer(device_, 4 + (std::uint64_t{count} + count / 4) * sizeof(shader::TexelItem),
                                 gpu::Memory::kReadback, "texels wanted");
        }
        capacity = static_cast<std::uint32_t>((items_.sizeBytes() - 4) / sizeof(shader::TexelItem));
        *items_.as<std::uint32_t>().data() = 0;
        run.recorder.dispatch(run.pipeline("isosurface_collect_texels", {64U}), "illumination request", (rows + 63) / 64, 1, 1,
                              Push{params_.address(), items_.address(), pool_.slotBricks().address(), rows, capacity});
        run.recorder.submitAndWait();
        count = *items_.as<std::uint32_t>().data();
    }
    std::vector<shader::TexelItem> items(count);
    std::memcpy(items.data(), items_.mapped().data() + 4, count * sizeof(shader::TexelItem));
    // The device lists them in any order; the number of a texel makes it one.
    std::ranges::sort(items, [](const shader::TexelItem& a, const shader::TexelItem& b) {
        return a.coverage != b.coverage ? a.coverage > b.coverage : a.texel < b.texel;
    });
    requested_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) requested_[i] = {items[i], i, 0};
    seconds_ = 0;
    samples_ = 0;
    stage_paths_ = kFirstStageSamples / kReplicates;
    cursor_ = 0;
    active_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!isDone(items[i].state)) active_.push_back(i);
    }
    const std::uint64_t sum_bytes = std::max<std::uint64_t>(requested_.size(), 1) * (shared().stride + kReplicates) * 4;
    if (!active_.empty() && (!sums_ || sums_.sizeBytes() < sum_bytes)) {
        sums_ = gpu::Buffer(device_, sum_bytes + sum_bytes / 4, gpu::Memory::kDevice, "sums of texels");
    }
    if (active_.empty()) freeWorking();
}

}  // namespace radiata::render
