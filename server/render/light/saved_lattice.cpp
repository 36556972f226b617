// Lattices that are whole, to files and back; docs/formats/lattice.md.
#include <algorithm>
#include <span>

#include "base/error.h"
#include "gpu/device.h"
#include "io/lattice_file.h"
#include "render/light/lattice.h"
#include "render/light/lattice_key.h"

namespace radiata::render {
namespace {

constexpr std::uint64_t kTexels = shader::TEXELS_PER_BRICK;
static_assert(kTexels == io::kTexelsPerBrick);
constexpr int kEdge = static_cast<int>(shader::TEXEL_BRICK_EDGE);

/// Calls use(first, count) for each run of bricks whose slots follow each other: a copy has its price.
template <typename Use>
void forRuns(const LatticePool& pool, std::span<const std::uint32_t> bricks, const Use& use) {
    for (std::size_t first = 0, last = 0; first < bricks.size(); first = last) {
        const std::uint64_t slot = pool.slotOf(bricks[first]);
        for (last = first + 1; last < bricks.size() && pool.slotOf(bricks[last]) == slot + last - first;) ++last;
        use(first, last - first);
    }
}

}  // namespace

io::LatticeHeader IlluminationLattice::header() const { return latticeHeader(*volume_, light_, map_.get(), albedo_); }

std::string IlluminationLattice::key() const { return latticeKey(*volume_, light_, map_.get(), albedo_); }

void IlluminationLattice::save(const std::filesystem::path& file) const {
    if (!whole()) throw Error(Code::kInternal, "a lattice is saved that is not whole");
    const std::uint64_t payload_bytes = payloadBytes();
    io::LatticeWriter writer(file, header());
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

void IlluminationLattice::restore(const LatticeRun& run, const io::SavedLattice& saved) {
    dropTexels();
    const std::uint64_t payload_bytes = payloadBytes();
    if (!(saved.header == header())) {
        throw Error(Code::kInvalidArgument, saved.name + ": is a saved lattice of something else (" + saved.header.key + ")");
    }
    if (!pool_.fitsWhole()) {
        throw Error(Code::kResourceExhausted, saved.name + ": its texels need " +
                                                  std::to_string(brickCount() * pool_.wholeBrickBytes() / 1048576 + 1) +
                                                  " MiB, more than the budget");
    }
    try {
        pool_.keepWhole(true);
        pool_.beginRequest();
        pool_.want(0, brickCount());
        left_out_ = pool_.admit(run.recorder);
        refreshAddresses();
        for (const io::LatticePart& part : saved.parts) {
            run.checkCancelled();
            for (std::size_t i = 0; i < part.bricks.size(); ++i) {
                const std::uint32_t brick = part.bricks[i];
                const glm::ivec3 at(brick % static_cast<std::uint32_t>(bricks_.x),
                                    brick / static_cast<std::uint32_t>(bricks_.x) % static_cast<std::uint32_t>(bricks_.y),
                                    brick / static_cast<std::uint32_t>(bricks_.x * bricks_.y));
                for (int t = 0; t < static_cast<int>(kTexels); ++t) {
                    const glm::ivec3 texel = kEdge * at + glm::ivec3(t % kEdge, t / kEdge % kEdge, t / (kEdge * kEdge));
                    if (glm::all(glm::lessThan(texel, size_)))
                        noteWhole(part.states[i * kTexels + static_cast<std::size_t>(t)]);
                }
            }
            forRuns(pool_, part.bricks, [&](std::size_t i, std::size_t length) {
                const std::uint64_t slot = pool_.slotOf(part.bricks[i]) - 1;
                gpu::upload(device_, pool_.state(), slot * kTexels * 4,
                            std::as_bytes(std::span(part.states).subspan(i * kTexels, length * kTexels)));
                gpu::upload(device_, pool_.payload(), slot * kTexels * payload_bytes,
                            std::span(part.payloads).subspan(i * kTexels * payload_bytes, length * kTexels * payload_bytes));
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
