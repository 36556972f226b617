// Selections of fibres as one bit per fibre; what regions say of each fibre is kept, so that joining
// them anew costs nothing.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "build/region_volume.h"
#include "model/fiblet_set.h"
#include "model/selection.h"

namespace radiata {

/// One bit per fibre; bits beyond the count are 0.
class FibreBits {
public:
    explicit FibreBits(std::uint64_t count = 0, bool value = false);

    std::uint64_t size() const { return size_; }
    bool test(std::uint64_t f) const { return (words_[f / 64] >> (f % 64) & 1U) != 0; }
    void set(std::uint64_t f) { words_[f / 64] |= std::uint64_t{1} << (f % 64); }
    std::uint64_t count() const;
    /// Numbers of the set bits, ascending.
    std::vector<std::uint32_t> fibres() const;

    FibreBits& operator&=(const FibreBits& other);
    FibreBits& operator|=(const FibreBits& other);
    FibreBits& invert();
    bool operator==(const FibreBits&) const = default;

private:
    std::uint64_t size_ = 0;
    std::vector<std::uint64_t> words_;
};

/// Thread-safe; one for each tractogram.
class FibreSelector {
public:
    /// \param masks        gives volumes by id, whenever a selection names one
    /// \param cache_bytes  of kept bits; the longest unused go first
    /// \param meshes       gives surfaces by id
    FibreSelector(std::shared_ptr<const model::FibletSet> set, MaskLookup masks,
                  std::uint64_t cache_bytes = std::uint64_t{1} << 28, MeshLookup meshes = {});

    /// \throws Error(kNotFound) naming the columns or groups there are, and as masks()
    FibreBits select(const model::Selection& selection);

    /// One region written as in model/selection_text.h. \throws as regionVolume() and parseRegion()
    std::unique_ptr<RegionVolume> region(const std::string& text) const;
    /// The surface of a region mesh(DATASET). \throws as region()
    std::shared_ptr<const model::TriangleMesh> mesh(const std::string& text) const;

    const model::FibletSet& set() const { return *set_; }

private:
    struct Entry {
        std::shared_ptr<const std::vector<std::uint8_t>> flags;  ///< FibreRegionFlag, per fibre
        std::uint64_t used = 0;
    };
    std::shared_ptr<const std::vector<std::uint8_t>> flagsOf(const model::FibreRegion& region);
    FibreBits inRegion(const model::Selection& selection);
    FibreBits ordered(const model::Selection& selection);
    FibreBits byLength(const model::Selection& selection);
    FibreBits byColumn(const model::Selection& selection) const;
    FibreBits byPoints(const model::PointColumn& column, const model::Selection& selection) const;
    FibreBits inGroup(const model::Selection& selection) const;
    FibreBits drawn(const model::Selection& selection) const;

    std::shared_ptr<const model::FibletSet> set_;
    MaskLookup masks_;
    MeshLookup meshes_;
    std::uint64_t cache_bytes_;
    std::mutex mutex_;
    std::uint64_t clock_ = 0;
    std::map<std::string, Entry> kept_;
    std::shared_ptr<const std::vector<float>> lengths_;
};

}  // namespace radiata
