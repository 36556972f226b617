// Datasets by catalogue id: read on first use, kept in device memory. The catalogue is a folder's image files or a list;
// ids are made from file names once, at start-up, and requests are looked up in that table, so none reaches the file system.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/fwd.h"
#include "io/sh_options.h"
#include "io/tensor_options.h"
#include "io/vtk_lines.h"
#include "model/dataset.h"
#include "model/fiblet_set.h"
#include "model/illumination.h"
#include "model/scalar_image.h"
#include "model/sh_image.h"
#include "model/tractogram.h"
#include "model/triangle_mesh.h"

namespace radiata {
class FibreSelector;
}

namespace radiata::store {

class GlyphDataset;
class SavedLattices;
class ScalarDataset;
struct SurfaceTriangles;
class VolumeDataset;

struct CatalogEntry {
    std::string id;
    std::filesystem::path path;
};

/// Thread-safe. The device must outlive it.
class Store {
public:
    /// \param log  gets one sentence for each dataset that is read, with what was assumed about it; may be empty
    Store(gpu::Device& device, io::ShOptions options, std::function<void(const std::string&)> log = {});
    ~Store();

    /// Where tractograms are kept once they are encoded (store/tract_files.h). Empty, as at first: nowhere.
    void setTractCache(const std::filesystem::path& folder);

    /// Which way the axes of .vtk and .vtp tractograms point. At first: as each says, RAS with a remark if it does not.
    void setVtkSpace(io::VtkSpace space);

    /// Where illumination lattices are saved. Empty, as at first: beside their datasets.
    void setLatticeFolder(const std::filesystem::path& folder);
    /// The file for a lattice of this dataset with this key; empty if there is no place for it.
    std::filesystem::path latticeFile(const std::string& id, const std::string& key);
    /// Saved lattices on their way to the device.
    SavedLattices& savedLattices();
    /// Who draws a tractogram says what it takes on the device, for info() and list(). \throws Error(kNotFound)
    void setFibreMemory(const std::string& id, const model::FibreMemory& memory);
    /// One sentence for the log.
    void note(const std::string& sentence) const;

    /// Adds every readable image, environment map and tractogram of a folder, or one file (or .trx folder). Ids come from file
    /// names
    /// ("xa_fod8.nii.gz" -> "xa_fod8"). \param tensors  the files hold tensors in this format; without it those are tensors
    /// whose headers say so \return the entries added.  \throws Error(kNotFound) if there is no such folder or file
    std::vector<CatalogEntry> add(const std::filesystem::path& folder_or_file,
                                  const std::optional<io::TensorOptions>& tensors = {});
    /// Adds an image that is already in memory (tests, lab). \throws Error(kInvalidArgument) for a malformed or taken id
    void add(const std::string& id, model::ShImage image);
    void add(const std::string& id, model::ScalarImage image);
    void add(const std::string& id, model::FibletSet fiblets);
    void add(const std::string& id, model::EnvironmentMap map);
    void add(const std::string& id, model::TriangleMesh mesh);

    /// All datasets. Those that are not resident are told from their headers (glyph count, amplitudes and bytes are 0);
    /// one whose header cannot be read has size 0.
    std::vector<model::DatasetInfo> list();
    /// \throws Error(kNotFound) naming the id; Error of the reader
    model::DatasetInfo info(const std::string& id);
    /// Whether the dataset is loaded, without waiting for one that just loads. \throws Error(kNotFound)
    bool resident(const std::string& id) const;
    /// The same of what volume() and triangles() give.
    bool volumeResident(const std::string& id) const;
    bool trianglesResident(const std::string& id, const std::optional<float>& isovalue) const;
    /// The dataset, loaded if it was not; other datasets stay available meanwhile.
    /// \throws as info(); Error(kInvalidArgument) if it is of another kind
    std::shared_ptr<const GlyphDataset> glyphs(const std::string& id);
    /// \param use  what it is wanted for, as messages say it
    std::shared_ptr<const ScalarDataset> scalars(const std::string& id,
                                                 std::string_view use = "colours are taken from a scalar volume");
    std::shared_ptr<const model::FibletSet> fiblets(const std::string& id);
    /// What selects of this tractogram, with what it remembers; masks are scalar volumes of the catalogue. \throws as fiblets()
    std::shared_ptr<FibreSelector> selector(const std::string& id);
    /// The fibres as their file has them, or as they are decoded if there is none. \throws as fiblets()
    std::unique_ptr<model::TractogramSource> tracts(const std::string& id);
    /// A picture of the sky, with its harmonics. \throws as fiblets()
    std::shared_ptr<const model::EnvironmentMap> environment(const std::string& id);
    /// A surface of triangles. \throws as fiblets()
    std::shared_ptr<const model::TriangleMesh> mesh(const std::string& id);
    /// A scalar volume on the device, for isosurfaces; put there by the first call.
    std::shared_ptr<const VolumeDataset> volume(const std::string& id);
    /// The triangles of one isovalue, or of that which splits the volume best; the latest few are kept.
    /// \throws as volume() and marchCubes()
    std::shared_ptr<const SurfaceTriangles> triangles(const std::string& id, const std::optional<float>& isovalue);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::store
