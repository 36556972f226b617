#include "store/store.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "base/error.h"
#include "build/fiblet_source.h"
#include "build/fibre_selection.h"
#include "gpu/device.h"
#include "io/fiblet_file.h"
#include "io/mesh_file.h"
#include "io/scalar_image.h"
#include "io/sh_image.h"
#include "io/stored_image.h"
#include "io/tensor_image.h"
#include "io/tractogram.h"
#include "store/catalog_ids.h"
#include "store/dataset_infos.h"
#include "store/environment_files.h"
#include "store/glyph_dataset.h"
#include "store/lattice_files.h"
#include "store/saved_lattices.h"
#include "store/scalar_dataset.h"
#include "store/surface_triangles.h"
#include "store/tract_files.h"
#include "store/volume_dataset.h"

namespace radiata::store {
namespace {

model::DatasetKind kindOf(const io::StoredImage& header) {
    return header.size[3] == 1 ? model::DatasetKind::kScalarVolume : model::DatasetKind::kShImage;
}

}  // namespace

struct Store::Impl {
    struct Slot {
        std::filesystem::path path;
        std::optional<io::TensorOptions> tensors;  ///< the file holds tensors, whatever its header says
        std::mutex loading;  ///< held while the dataset loads, so that it loads once and others stay available
        std::shared_ptr<const GlyphDataset> dataset;  ///< at most one of these, once it is loaded
        std::shared_ptr<const ScalarDataset> scalars;
        std::shared_ptr<const VolumeDataset> volume;  ///< of the scalars, once an isosurface needed it
        std::shared_ptr<const model::FibletSet> fiblets;
        std::shared_ptr<FibreSelector> selector;  ///< once one was asked for
        model::FibreMemory fibre_memory;          ///< under the table's mutex
        std::shared_ptr<const model::EnvironmentMap> environment;
        std::shared_ptr<const model::TriangleMesh> mesh;

        std::string_view kind() const {
            return dataset       ? "an SH image"
                   : scalars     ? "a scalar volume"
                   : environment ? "an environment map"
                   : mesh        ? "a mesh"
                                 : "a tractogram";
        }
    };
    gpu::Device& device;
    io::ShOptions options;
    std::function<void(const std::string&)> log;
    TractReading tracts;
    std::filesystem::path lattice_folder;
    std::mutex mutex;  ///< of the table, never held while anything loads
    std::map<std::string, std::shared_ptr<Slot>> slots;
    TriangleCache triangles;
    SavedLattices saved_lattices;

    std::shared_ptr<Slot> find(const std::string& id) {
        std::lock_guard lock(mutex);
        const auto found = slots.find(id);
        if (found == slots.end()) {
            throw Error(Code::kNotFound, "there is no dataset '" + printable(id) + "'; the catalogue lists " +
                                             std::to_string(slots.size()) + " datasets");
        }
        return found->second;
    }

    model::FibreMemory memoryOf(const Slot& slot) {
        std::lock_guard lock(mutex);
        return slot.fibre_memory;
    }

    void insert(const std::string& id, std::shared_ptr<Slot> slot) {
        std::lock_guard lock(mutex);
        if (slots.contains(id)) throw Error(Code::kInvalidArgument, "dataset id '" + id + "' is taken");
        slots[id] = std::move(slot);
    }

    /// Reads the slot's dataset if it was not read yet. The caller holds the slot's mutex.
    void load(const std::string& id, Slot& slot) const {
        if (slot.dataset || slot.scalars || slot.fiblets || slot.environment || slot.mesh) return;
        if (isEnvironmentName(slot.path)) {
            slot.environment = loadEnvironment(slot.path);
            if (log) log(slot.environment->source + ": an environment map");
            return;
        }
        if (io::isMeshName(slot.path)) {
            slot.mesh = std::make_shared<const model::TriangleMesh>(io::readMesh(slot.path));
            return;
        }
        if (isTractName(slot.path)) {
            slot.fiblets = std::make_shared<const model::FibletSet>(loadTracts(slot.path, tracts, log));
            return;
        }
        const io::StoredImage stored = io::readStoredImage(slot.path);
        if (!slot.tensors && kindOf(stored) == model::DatasetKind::kScalarVolume) {
            slot.scalars = std::make_shared<const ScalarDataset>(id, io::readScalarImage(slot.path));
            if (log) log(slot.scalars->image().source + ": a scalar volume");
            return;
        }
        const bool tensors = slot.tensors || stored.tensor;
        model::ShImage image = tensors ? io::readTensorImage(slot.path, slot.tensors.value_or(io::TensorOptions{}))
                                       : io::readShImage(slot.path, options);
        if (log) log(io::describe(image));
        slot.dataset = std::make_shared<const GlyphDataset>(device, id, std::move(image));
    }
};

Store::Store(gpu::Device& device, io::ShOptions options, std::function<void(const std::string&)> log)
    : impl_(new Impl{device, options, std::move(log), {}, {}, {}, {}, {}, {}}) {}
Store::~Store() = default;

std::vector<CatalogEntry> Store::add(const std::filesystem::path& folder_or_file,
                                     const std::optional<io::TensorOptions>& tensors) {
    std::vector<std::filesystem::path> files;
    std::error_code failure;
    const bool folder = std::filesystem::is_directory(folder_or_file, failure);
    if (folder && isTractName(folder_or_file)) {
        files.push_back(folder_or_file);
    } else if (folder) {
        for (const auto& entry : std::filesystem::directory_iterator(folder_or_file, failure)) {
            const bool tract_folder = entry.is_directory(failure) && isTractName(entry.path());
            if ((entry.is_regular_file(failure) || tract_folder) && !stemOf(entry.path()).empty())
                files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
    } else if (std::filesystem::is_regular_file(folder_or_file, failure)) {
        if (stemOf(folder_or_file).empty()) {
            throw Error(Code::kUnsupported, "data: '" + folder_or_file.string() +
                                                "' is no image (.nii, .nii.gz, .mif, .mif.gz, .mih, .nrrd, .nhdr), no "
                                                "environment map (.hdr), no tractogram (.tck, .trk, .trx, .tt, .vtk, .vtp, "
                                                ".gz of them, .fiblet) and no mesh (.obj, .stl)");
        }
        files.push_back(folder_or_file);
    } else {
        throw Error(Code::kNotFound, "data: there is no file or folder '" + folder_or_file.string() + "'");
    }
    std::lock_guard lock(impl_->mutex);
    std::vector<CatalogEntry> added;
    for (const auto& file : files) {
        const std::string stem = idOf(stemOf(file));
        std::string id = stem;
        for (int n = 2; impl_->slots.contains(id); ++n) id = stem + "-" + std::to_string(n);
        auto slot = std::make_shared<Impl::Slot>();
        slot->path = file;
        slot->tensors = tensors;
        impl_->slots[id] = std::move(slot);
        added.push_back({id, file});
    }
    return added;
}

void Store::add(const std::string& id, model::ShImage image) {
    checkId(id);
    auto slot = std::make_shared<Impl::Slot>();
    slot->dataset = std::make_shared<const GlyphDataset>(impl_->device, id, std::move(image));
    impl_->insert(id, std::move(slot));
}

void Store::add(const std::string& id, model::ScalarImage image) {
    checkId(id);
    auto slot = std::make_shared<Impl::Slot>();
    slot->scalars = std::make_shared<const ScalarDataset>(id, std::move(image));
    impl_->insert(id, std::move(slot));
}

void Store::add(const std::string& id, model::FibletSet fiblets) {
    checkId(id);
    auto slot = std::make_shared<Impl::Slot>();
    slot->fiblets = std::make_shared<const model::FibletSet>(std::move(fiblets));
    impl_->insert(id, std::move(slot));
}

void Store::add(const std::string& id, model::EnvironmentMap map) {
    checkId(id);
    auto slot = std::make_shared<Impl::Slot>();
    slot->environment = completeEnvironment(std::move(map));
    impl_->insert(id, std::move(slot));
}

std::shared_ptr<const model::EnvironmentMap> Store::environment(const std::string& id) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (!slot->environment) {
        throw Error(Code::kInvalidArgument, "dataset '" + id + "' is " + std::string(slot->kind()) +
                                                "; light from all around needs an environment map");
    }
    return slot->environment;
}

void Store::add(const std::string& id, model::TriangleMesh mesh) {
    checkId(id);
    auto slot = std::make_shared<Impl::Slot>();
    slot->mesh = std::make_shared<const model::TriangleMesh>(std::move(mesh));
    impl_->insert(id, std::move(slot));
}

std::shared_ptr<const model::TriangleMesh> Store::mesh(const std::string& id) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (!slot->mesh) {
        throw Error(Code::kInvalidArgument,
                    "dataset '" + id + "' is " + std::string(slot->kind()) + "; a region by mesh needs a mesh");
    }
    return slot->mesh;
}

std::shared_ptr<const GlyphDataset> Store::glyphs(const std::string& id) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (!slot->dataset) {
        throw Error(Code::kInvalidArgument,
                    "dataset '" + id + "' is " + std::string(slot->kind()) + "; glyphs need an SH image");
    }
    return slot->dataset;
}

std::shared_ptr<const ScalarDataset> Store::scalars(const std::string& id, std::string_view use) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (!slot->scalars) {
        throw Error(Code::kInvalidArgument, "dataset '" + id + "' is " + std::string(slot->kind()) + "; " + std::string(use));
    }
    return slot->scalars;
}

std::shared_ptr<const model::FibletSet> Store::fiblets(const std::string& id) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (!slot->fiblets) {
        throw Error(Code::kInvalidArgument,
                    "dataset '" + id + "' is " + std::string(slot->kind()) + "; fibres need a tractogram");
    }
    return slot->fiblets;
}

std::shared_ptr<FibreSelector> Store::selector(const std::string& id) {
    std::shared_ptr<const model::FibletSet> set = fiblets(id);
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    if (!slot->selector) {
        const auto masks = [this](const std::string& mask) {
            const std::shared_ptr<const ScalarDataset> volume = scalars(mask, "a mask is a scalar volume");
            return std::shared_ptr<const model::ScalarImage>(volume, &volume->image());
        };
        slot->selector = std::make_shared<FibreSelector>(std::move(set), masks, std::uint64_t{1} << 28,
                                                         [this](const std::string& surface) { return mesh(surface); });
    }
    return slot->selector;
}

std::unique_ptr<model::TractogramSource> Store::tracts(const std::string& id) {
    const std::shared_ptr<const model::FibletSet> set = fiblets(id);
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    if (slot->path.empty() || io::isFibletName(slot->path)) return sourceOf(*set);
    return openTracts(slot->path, impl_->tracts, {});
}

void Store::setTractCache(const std::filesystem::path& folder) { impl_->tracts.cache = folder; }

void Store::setVtkSpace(io::VtkSpace space) { impl_->tracts.vtk_space = space; }

void Store::setLatticeFolder(const std::filesystem::path& folder) { impl_->lattice_folder = folder; }

std::filesystem::path Store::latticeFile(const std::string& id, const std::string& key) {
    return latticePath(impl_->find(id)->path, impl_->lattice_folder, key);
}

SavedLattices& Store::savedLattices() { return impl_->saved_lattices; }

void Store::setFibreMemory(const std::string& id, const model::FibreMemory& memory) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(impl_->mutex);
    slot->fibre_memory = memory;
}

void Store::note(const std::string& sentence) const {
    if (impl_->log) impl_->log(sentence);
}

std::shared_ptr<const VolumeDataset> Store::volume(const std::string& id) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (!slot->scalars) {
        throw Error(Code::kInvalidArgument, "dataset '" + id + "' is no scalar volume; isosurfaces need one");
    }
    if (!slot->volume) slot->volume = std::make_shared<const VolumeDataset>(impl_->device, slot->scalars->image());
    return slot->volume;
}

std::shared_ptr<const SurfaceTriangles> Store::triangles(const std::string& id, const std::optional<float>& isovalue) {
    const float value = isovalue ? *isovalue : volume(id)->valueSplit();
    return impl_->triangles.get(impl_->device, scalars(id), value);
}

model::DatasetInfo Store::info(const std::string& id) {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::lock_guard lock(slot->loading);
    impl_->load(id, *slot);
    if (slot->fiblets) return fibletInfo(id, *slot->fiblets, impl_->memoryOf(*slot));
    if (slot->environment) return environmentInfo(id, *slot->environment);
    if (slot->mesh) return meshInfo(id, *slot->mesh);
    return slot->dataset ? slot->dataset->info() : slot->scalars->info();
}

bool Store::resident(const std::string& id) const {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::unique_lock lock(slot->loading, std::try_to_lock);
    return lock && (slot->dataset || slot->scalars || slot->fiblets || slot->environment || slot->mesh);
}

bool Store::volumeResident(const std::string& id) const {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::unique_lock lock(slot->loading, std::try_to_lock);
    return lock && slot->volume;
}

bool Store::trianglesResident(const std::string& id, const std::optional<float>& isovalue) const {
    const std::shared_ptr<Impl::Slot> slot = impl_->find(id);
    std::unique_lock lock(slot->loading, std::try_to_lock);
    return lock && slot->volume && impl_->triangles.has(slot->scalars, isovalue.value_or(slot->volume->valueSplit()));
}

std::vector<model::DatasetInfo> Store::list() {
    std::map<std::string, std::shared_ptr<Impl::Slot>> slots;
    {
        std::lock_guard lock(impl_->mutex);
        slots = impl_->slots;
    }
    std::vector<model::DatasetInfo> infos;
    for (const auto& [id, slot] : slots) {
        model::DatasetInfo info;
        info.id = id;
        std::unique_lock lock(slot->loading, std::try_to_lock);
        if (lock && slot->dataset) {
            info = slot->dataset->info();
        } else if (lock && slot->scalars) {
            info = slot->scalars->info();
        } else if (lock && slot->fiblets) {
            info = fibletInfo(id, *slot->fiblets, impl_->memoryOf(*slot));
        } else if (lock && slot->environment) {
            info = environmentInfo(id, *slot->environment);
        } else if (isEnvironmentName(slot->path)) {
            info = environmentHeaderInfo(id, slot->path);
        } else if (lock && slot->mesh) {
            info = meshInfo(id, *slot->mesh);
        } else if (io::isMeshName(slot->path)) {
            info.kind = model::DatasetKind::kMesh;
        } else if (isTractName(slot->path)) {
            info = tractHeaderInfo(id, slot->path);
        } else if (!slot->path.empty()) {
            try {
                const io::StoredImage stored = io::readStoredImage(slot->path);
                info.kind = kindOf(stored);
                if (!slot->tensors && info.kind == model::DatasetKind::kScalarVolume) {
                    info.size = glm::ivec3(stored.size[0], stored.size[1], stored.size[2]);
                    info.voxel_to_world = stored.voxel_to_world;
                    infos.push_back(info);
                    continue;
                }
                const bool tensors = slot->tensors || stored.tensor;
                const model::ShImage header =
                    tensors ? io::readTensorHeader(slot->path, slot->tensors.value_or(io::TensorOptions{}))
                            : io::readShHeader(slot->path, impl_->options);
                info.size = header.size;
                info.voxel_to_world = header.voxel_to_world;
                info.layout = header.layout;
                info.convention = header.file_convention;
                info.axes = header.file_axes;
                info.tensor_order = header.tensor_order;
                info.tensor_format = header.tensor_format;
            } catch (const Error&) {
                // The list goes on; whoever asks for this dataset gets the reader's sentence.
            }
        }
        infos.push_back(info);
    }
    return infos;
}

}  // namespace radiata::store
