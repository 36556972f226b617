#include "store/surface_triangles.h"

#include <algorithm>
#include <span>

#include "build/marching_cubes.h"
#include "gpu/device.h"
#include "shaders/shared/surface_mesh.glsl"

namespace radiata::store {
namespace {

constexpr std::size_t kKept = 4;
constexpr std::size_t kPieceIndices = 3 * 16384;

template <typename T>
gpu::Buffer uploaded(gpu::Device& device, std::span<const T> values, const char* name) {
    gpu::Buffer buffer(device, values.size_bytes(), gpu::Memory::kDevice, name);
    gpu::upload(device, buffer, 0, std::as_bytes(values));
    return buffer;
}

std::shared_ptr<const SurfaceTriangles> made(gpu::Device& device, const std::shared_ptr<const ScalarDataset>& volume,
                                             float isovalue) {
    auto result = std::make_shared<SurfaceTriangles>();
    result->volume = volume;
    result->isovalue = isovalue;
    const SurfaceMesh mesh = marchCubes(volume->image(), isovalue);
    if (mesh.triangles.empty()) return result;
    std::vector<shader::SurfaceCorner> corners(mesh.positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = {mesh.positions[i], mesh.normals[i]};
    result->corners = uploaded(device, std::span<const shader::SurfaceCorner>(corners), "corners of an isosurface");
    const std::span<const std::uint32_t> all(mesh.triangles);
    for (std::size_t begin = 0; begin < all.size(); begin += kPieceIndices) {
        const auto piece = all.subspan(begin, std::min(kPieceIndices, all.size() - begin));
        result->pieces.push_back(
            {uploaded(device, piece, "triangles of an isosurface"), static_cast<std::uint32_t>(piece.size())});
    }
    return result;
}

}  // namespace

bool TriangleCache::has(const std::shared_ptr<const ScalarDataset>& volume, float isovalue) const {
    std::lock_guard lock(mutex_);
    return std::ranges::any_of(kept_, [&](const auto& one) { return one->volume == volume && one->isovalue == isovalue; });
}

std::shared_ptr<const SurfaceTriangles> TriangleCache::find(const std::shared_ptr<const ScalarDataset>& volume,
                                                            float isovalue) {
    std::lock_guard lock(mutex_);
    const auto found =
        std::ranges::find_if(kept_, [&](const auto& one) { return one->volume == volume && one->isovalue == isovalue; });
    if (found == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front();
}

std::shared_ptr<const SurfaceTriangles> TriangleCache::get(gpu::Device& device,
                                                           const std::shared_ptr<const ScalarDataset>& volume, float isovalue) {
    if (auto there = find(volume, isovalue)) return there;
    std::lock_guard one_at_a_time(making_);
    if (auto there = find(volume, isovalue)) return there;
    auto triangles = made(device, volume, isovalue);
    std::lock_guard lock(mutex_);
    kept_.push_front(triangles);
    if (kept_.size() > kKept) kept_.pop_back();
    return triangles;
}

}  // namespace radiata::store
