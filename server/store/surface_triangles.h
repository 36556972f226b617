// Triangles of isosurfaces on the device: what marching cubes made of a volume and one isovalue.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include "gpu/buffer.h"
#include "store/scalar_dataset.h"

namespace radiata::store {

struct SurfaceTriangles {
    /// A piece that is drawn at a time.
    struct Piece {
        gpu::Buffer indices;  ///< uint32
        std::uint32_t index_count = 0;
    };
    std::shared_ptr<const ScalarDataset> volume;
    float isovalue = 0;
    gpu::Buffer corners;        ///< shader::SurfaceCorner[]; empty: there is no triangle
    std::vector<Piece> pieces;  ///< in the order of the volume's cells
};

/// The latest ones, made when first asked for, on the calling thread. Thread-safe: one is made at a time, and who only asks
/// what there is does not wait for it.
class TriangleCache {
public:
    bool has(const std::shared_ptr<const ScalarDataset>& volume, float isovalue) const;
    /// \throws Error as marchCubes(), Error(kResourceExhausted) if they do not fit the device
    std::shared_ptr<const SurfaceTriangles> get(gpu::Device& device, const std::shared_ptr<const ScalarDataset>& volume,
                                                float isovalue);

private:
    std::shared_ptr<const SurfaceTriangles> find(const std::shared_ptr<const ScalarDataset>& volume, float isovalue);

    std::mutex making_;         ///< held while triangles are made, before mutex_
    mutable std::mutex mutex_;  ///< of the list
    std::list<std::shared_ptr<const SurfaceTriangles>> kept_;
};

}  // namespace radiata::store
