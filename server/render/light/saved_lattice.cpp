// Lattices that are whole, to files and back; docs/formats/lattice.md.
#include <algorithm>
#include <cstdio>
#include <span>

#include "base/error.h"
#include "gpu/device.h"
#include "io/lattice_file.h"
#include "render/light/lattice.h"

namespace radiata::render {
namespace {

constexpr std::uint64_t kTexels = shader::TEXELS_PER_BRICK;
static_assert(kTexels == io::kTexelsPerBrick);
constexpr int kEdge = static_cast<int>(shader::TEXEL_BRICK_EDGE);

/// Numbers as short as they can be without losing a bit.
std::string words(std::initializer_list<double> numbers) {
    std::string text;
    for (const double number : numbers) {
        char word[32];
        std::snprintf(word, sizeof word, " %.17g", number);
        text += word;
    }
    return text;
}

/// Calls use(first, count) for each run of bricks whose slots follow each other: a copy has its price.
template <typename Use>
void forRuns(const LatticePool& pool, std::span<const std::uint32_t> bricks, const Use& use) {
    for (std::size_t first = 0, last = 0; first < bricks.size(); first = last) {
        const std::uint64_t slot = pool.slotOf(bricks[first]);
        for (last = first + 1; last < bricks.size() && pool.slotOf(bricks[last]) == slot + last - first;) ++last;
        use(first, last - first);
    }
}

std::string words(const glm::dvec3& v) { return words({v.x, v.y, v.z}); }

}  // namespace

std::string IlluminationLattice::lightKey() const {
    std::string key;
    if (light_.environment) {
        key += "; environment" + words({static_cast<double>(map_ ? map_->check : 0), light_.environment->scale});
    } else {
        key += "; sky" + words(light_.sky.radiance) + words(light_.sky.gradient) + words(light_.sky.up);
    }
    for (const model::SunDisc& sun : light_.suns) {
        key += "; sun" + words(sun.direction) + words({sun.angular_radius_deg}) + words(sun.irradiance);
    }
    for (const model::SphereLight& lamp : light_.lights) {
        key += "; lamp" + words(lamp.position_mm) + words({lamp.radius_mm}) + words(lamp.intensity);
    }
    const auto& turn = light_.rotation;
    key += "; turned" + words({turn[0], turn[1], turn[2], turn[3]});
    if (light_.storage == model::TexelStorage::kRgb8) key += "; albedo" + words(albedo_);
    return key;
}

std::string IlluminationLattice::key() const {
    const shader::VolumeParams& grid = volume_->params();
    std::string key = "lattice of volume " + std::to_string(volume_->check()) + words(glm::dvec3(grid.size));
    for (const glm::vec3& axis : {grid.grid_x, grid.grid_y, grid.grid_z}) key += words(axis);
    // Lights in the scene and the directions of all others are in world axes.
    key += "; from" + words(volume_->gridToWorld(glm::dvec3(0))) + "; texels" + words(glm::dvec3(size_));
    const bool transfer = light_.payload == model::TexelPayload::kTransfer;
    key += transfer ? "; transfer, orders" : "; irradiance";
    for (int k = 0; k <= light_.bounces && transfer; ++k) key += words({double(light_.orders[static_cast<std::size_t>(k)])});
    key += "; bounces" + words({double(light_.bounces)});
    key += light_.storage == model::TexelStorage::kRgb8      ? "; rgb8"
           : light_.storage == model::TexelStorage::kFloat16 ? "; float16"
                                                             : "; float32";
    if (light_.sampling == model::TexelSampling::kRandom) key += "; random paths";
    return transfer ? key : key + lightKey();
}

void IlluminationLattice::save(const std::filesystem::path& file) const {
    if (!whole()) throw Error(Code::kInternal, "a lattice is saved that is not whole");
    const std::uint64_t payload_bytes = payloadBytes();
    io::LatticeWriter writer(file, {key(), static_cast<std::uint32_t>(payload_bytes), brickCount()});
    for (std::uint64_t begin = 0; begin < brickCount(); begin += io::LatticePart::kBricksMax) {
        const std::uint64_t count = std::min<std::uint64_t>(io::LatticePart::kBricksMax, brickCount() - begin);
        io::LatticePart part;
        part.states.resize(count * kTexels);
        part.payloads.resize(count * kTexels * payload_bytes);
        for (std::uint64_t i = 0; i < count; ++i) part.bricks.push_back(static_cast<std::uint32_t>(begin + i));
        forRuns(pool_, part.bricks, [&](std::size_t i, std::size_t length) {
            const std::uint64_t slot = pool_.slotOf(part.bricks[i]) - 1;
            gpu::download(device_, pool_.state(), slot * kTexels * 4,
                          std::as_writable_bytes(std::span(part.states).subspan(i * kTexels, length * kTexels)));
            gpu::download(device_, pool_.payload(), slot * kTexels * payload_bytes,
                          std::span(part.payloads).subspan(i * kTexels * payload_bytes, length * kTexels * payload_bytes));
        });
        writer.write(part);
    }
    writer.finish();
}

void IlluminationLattice::restore(const LatticeRun& run, const std::filesystem::path& file) {
    dropTexels();
    io::LatticeReader reader(file);
    const std::uint64_t payload_bytes = payloadBytes();
    const std::string name = file.filename().string();
    if (reader.header().key != key() || reader.header().payload_bytes != payload_bytes ||
        reader.header().bricks != brickCount()) {
        throw Error(Code::kInvalidArgument, name + ": is a saved lattice of something else (" + reader.header().key + ")");
    }
    if (!pool_.fits(brickCount())) {
        throw Error(Code::kResourceExhausted, name + ": its texels need " +
                                                  std::to_string(brickCount() * pool_.brickBytes() / 1048576 + 1) +
                                                  " MiB, more than the budget");
    }
    try {
        shared().request = pool_.beginRequest();
        pool_.want(0, brickCount());
        left_out_ = pool_.admit(run.recorder);
        refreshAddresses();
        std::vector<bool> seen(brickCount());
        while (const std::optional<io::LatticePart> part = reader.read(brickCount())) {
            run.checkCancelled();
            for (std::size_t i = 0; i < part->bricks.size(); ++i) {
                const std::uint32_t brick = part->bricks[i];
                if (seen[brick]) throw Error(Code::kCorrupt, name + ": has brick " + std::to_string(brick) + " twice");
                seen[brick] = true;
                const glm::ivec3 at(brick % static_cast<std::uint32_t>(bricks_.x),
                                    brick / static_cast<std::uint32_t>(bricks_.x) % static_cast<std::uint32_t>(bricks_.y),
                                    brick / static_cast<std::uint32_t>(bricks_.x * bricks_.y));
                for (int t = 0; t < static_cast<int>(kTexels); ++t) {
                    const glm::ivec3 texel = kEdge * at + glm::ivec3(t % kEdge, t / kEdge % kEdge, t / (kEdge * kEdge));
                    if (glm::all(glm::lessThan(texel, size_)))
                        noteWhole(part->states[i * kTexels + static_cast<std::size_t>(t)]);
                }
            }
            forRuns(pool_, part->bricks, [&](std::size_t i, std::size_t length) {
                const std::uint64_t slot = pool_.slotOf(part->bricks[i]) - 1;
                gpu::upload(device_, pool_.state(), slot * kTexels * 4,
                            std::as_bytes(std::span(part->states).subspan(i * kTexels, length * kTexels)));
                gpu::upload(device_, pool_.payload(), slot * kTexels * payload_bytes,
                            std::span(part->payloads).subspan(i * kTexels * payload_bytes, length * kTexels * payload_bytes));
            });
        }
    } catch (...) {
        dropTexels();
        throw;
    }
    texels_read_ =
        static_cast<std::uint64_t>(size_.x) * static_cast<std::uint64_t>(size_.y) * static_cast<std::uint64_t>(size_.z);
    // Saved with a larger error than is asked for now: the parts are gone through again.
    if (whole_.done == texels_read_) {
        whole_.next_brick = brickCount();
    } else {
        whole_ = {};
    }
    relight(run);
}

}  // namespace radiata::render
