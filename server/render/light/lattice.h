// The illumination lattice of one volume: which texels a view needs, lighting them in bounded pieces, and what is known of
// their error. Source: Wyman et al. 2006; lazy computation Sec. 4. Shaders:
// shaders/isosurface/{request,collect,light}_texels.comp, relight.comp.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/pipeline.h"
#include "model/illumination.h"
#include "render/light/lattice_light.h"
#include "render/light/lattice_pool.h"
#include "render/light/light_spent.h"
#include "store/volume_dataset.h"

namespace radiata::io {
struct LatticeHeader;
struct SavedLattice;
}  // namespace radiata::io

namespace radiata::render {

/// What the lattice's passes run with.
struct LatticeRun {
    gpu::Device& device;
    gpu::CommandRecorder& recorder;
    std::function<const gpu::ComputePipeline&(const std::string& shader, const std::vector<std::uint32_t>& constants)> pipeline;
    const std::atomic<bool>* cancel = nullptr;  ///< may be null
    LightSpent* spent = nullptr;                ///< that paths are added to; may be null

    /// \throws Error(kCancelled)
    void checkCancelled() const;
};

/// Device addresses of a picture's surface buffer and of the layer in it.
struct LatticePixels {
    std::uint64_t frame = 0;    ///< shader::FrameParams
    std::uint64_t layer = 0;    ///< shader::IsosurfaceParams
    std::uint64_t surface = 0;  ///< shader::Surface[pixels]
    std::uint32_t pixels = 0;
};

/// Samples that a texel's payload is the mean of, and their relative standard error, from its state.
std::uint32_t texelSamples(std::uint32_t state);
float texelError(std::uint32_t state);

class IlluminationLattice {
public:
    /// Whether two scenes' texels are the same: everything but the light, its colour, the interpolation and when to stop.
    /// \param projected  texels are lit on the shown surface
    static bool sameTexels(const model::Illumination& a, const model::Illumination& b);

    /// \throws Error(kInvalidArgument) for settings out of range
    IlluminationLattice(gpu::Device& device, std::shared_ptr<const store::VolumeDataset> volume,
                        const model::Illumination& light, bool projected);

    /// Takes over what may change from frame to frame. Texels with transfer are lit anew, those with irradiance dropped if the
    /// light changed; a projected lattice drops its texels if the isovalue did.
    /// \param map  of the environment, or null \return whether no texel has light: saved ones may take their place
    bool update(const LatticeRun& run, const model::Illumination& light,
                const std::shared_ptr<const model::EnvironmentMap>& map, const glm::vec3& albedo, float isovalue);

    /// Finds out what the pixels interpolate, and lists it by coverage. \throws Error(kCancelled, kResourceExhausted)
    /// \param number  what requestedFor() is to say; 0: nothing in particular
    void request(const LatticeRun& run, const LatticePixels& pixels, std::uint64_t number);
    std::uint64_t requestedFor() const { return requested_for_; }
    /// All texels, in place of those that pixels need. \throws Error(kResourceExhausted) if the budget is too small for them
    void requestAll(const LatticeRun& run);

    /// Goes on with all texels of the lattice, part by part, until they are done or the time is up. \return whether all are
    /// done \throws Error(kResourceExhausted) if the budget is too small for them
    bool lightAll(const LatticeRun& run, std::optional<std::chrono::steady_clock::time_point> until);
    /// Whether the latest request was one of lightAll().
    bool requestedWhole() const { return (requested_for_ & kWholeMark) != 0; }
    bool whole() const { return whole_.next_brick == brickCount(); }

    /// What a saved lattice must agree in, and its key: volume, settings and, of irradiance, the light.
    io::LatticeHeader header() const;
    std::string key() const;
    /// \throws Error(kInternal) unless it is whole, Error(kUnavailable) naming the reason, such as a full disk
    void save(const std::filesystem::path& file) const;
    /// Takes over all texels of a saved lattice with this one's header, in place of what there is.
    /// \throws Error(kResourceExhausted) if the budget is too small, Error(kInvalidArgument) for another lattice; then there
    /// are no texels
    void restore(const LatticeRun& run, const io::SavedLattice& saved);
    /// What became of saving it, for info().
    void noteSaved(const std::string& sentence) { saved_ = sentence; }
    const std::string& saved() const { return saved_; }

    /// Lights the first stage of every requested texel that has none.
    void lightFirst(const LatticeRun& run);
    /// Goes on with the stages of all requested texels until they are done or the time is up. \return whether all are done
    bool refine(const LatticeRun& run, std::optional<std::chrono::steady_clock::time_point> until);
    bool done() const { return active_.empty(); }
    /// Whether the budget had no room for some texels of the latest request.
    bool beyondBudget() const { return left_out_ > 0; }

    /// Radiance of a white surface for each pixel of the layer into vec3[pixels]; negative where nothing is known.
    /// \param settled  whether lacking() counts texels that are there and not done
    void gather(const LatticeRun& run, const LatticePixels& pixels, std::uint64_t light_address, const std::string& pass,
                bool settled);
    /// Whether the latest gather(), when it has run, found a texel lacking.
    bool lacking() const { return lacking_.as<std::uint32_t>()[0] != 0; }

    /// Paths are those of the latest request, or of the whole lattice.
    model::IlluminationInfo info() const;
    const gpu::Buffer& params() const { return params_; }
    const LatticePool& pool() const { return pool_; }
    const store::VolumeDataset& volume() const { return *volume_; }
    const model::Illumination& settings() const { return light_; }
    bool projected() const { return projected_; }
    const glm::ivec3& size() const { return size_; }
    /// Payload of one texel as it is kept, for tests and for saving; empty if it has none.
    std::vector<float> payload(gpu::Device& device, const glm::ivec3& texel) const;
    /// Its relative standard error; infinite if it has none.
    double relativeError(gpu::Device& device, const glm::ivec3& texel) const;

private:
    shader::LatticeParams& shared() const { return *reinterpret_cast<shader::LatticeParams*>(params_.mapped().data()); }
    std::vector<std::uint32_t> constants() const;
    void refreshAddresses();
    void relight(const LatticeRun& run);
    void list(const LatticeRun& run);
    void clearCoverage(const LatticeRun& run);
    void freeWorking();
    bool isExact(std::uint32_t state) const;
    bool isDone(std::uint32_t state) const;
    std::optional<std::uint64_t> rowOf(const glm::ivec3& texel) const;
    void keepBricksWhole(const LatticeRun& run);
    void lightBatch(const LatticeRun& run, std::size_t begin, std::size_t end);
    void requestBricks(const LatticeRun& run, std::uint64_t begin, std::uint64_t end, std::uint64_t mark);
    std::uint64_t brickCount() const;
    std::uint64_t payloadBytes() const;
    void dropTexels();
    void noteWhole(std::uint32_t state);
    model::IlluminationInfo wholeInfo(model::IlluminationInfo info) const;

    gpu::Device& device_;
    std::shared_ptr<const store::VolumeDataset> volume_;
    model::Illumination light_;
    bool projected_;
    glm::ivec3 size_, bricks_;
    std::shared_ptr<const model::EnvironmentMap> map_;
    glm::vec3 albedo_{-1};
    float isovalue_ = 0;
    bool lit_ = false;
    LatticePool pool_;
    std::unique_ptr<LatticeLightBuffers> light_buffers_;
    gpu::Buffer params_, lacking_;
    gpu::Buffer coverage_, items_, sums_;  ///< while texels are not done

    /// A requested texel. Its row of sums stays while the request does.
    struct Texel {
        shader::TexelItem item;
        std::uint32_t row = 0;
        std::uint32_t paths = 0;  ///< of each replicate, in its sums
    };
    std::vector<Texel> requested_;
    std::vector<std::uint32_t> active_;  ///< of requested_: not done, in the order of work
    std::size_t cursor_ = 0;             ///< of active_, in this stage
    std::uint32_t stage_paths_ = 1;      ///< paths of each replicate at the end of this stage
    double items_per_batch_ = 256;
    std::uint64_t left_out_ = 0;
    std::uint64_t requested_for_ = 0;
    double seconds_ = 0;
    std::uint64_t samples_ = 0;

    /// Marks requests of lightAll(), beside the number of their first brick.
    static constexpr std::uint64_t kWholeMark = 1ULL << 63;
    /// How far lightAll() is: what is known of the texels of all bricks before next_brick.
    struct Whole {
        std::uint64_t next_brick = 0, done = 0, out_of_samples = 0, samples = 0;
        double seconds = 0;
        std::vector<std::uint64_t> errors;  ///< texels by the bits of their relative standard errors
    };
    Whole whole_;
    std::uint64_t texels_read_ = 0;
    std::string saved_;
};

}  // namespace radiata::render
