// What the passes of a frame have in common while they run: where they record, what they draw into, how far the frame is.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/recorder.h"
#include "plan/camera_rays.h"
#include "plan/plan.h"
#include "render/fiblet/fiblet_scene.h"
#include "render/fiblet/fibre_look.h"
#include "render/fiblet/fibre_vertices.h"
#include "render/frame/pipelines.h"
#include "render/frame/target.h"
#include "render/glyph/glyph_scene.h"
#include "render/light/lattice.h"
#include "render/light/path_light.h"
#include "store/surface_triangles.h"

namespace radiata::store {
class VolumeDataset;
}

namespace radiata::render {

/// One layer as it stands on the device; of the scenes, that of the layer's kind is set.
struct DrawnLayer {
    GlyphScene* glyphs = nullptr;
    std::shared_ptr<const FibletScene> tracts;
    std::optional<FibreLook> fibres;                           ///< of tracts
    std::shared_ptr<const FibreVertices> vertices;             ///< of tracts, for pipelines that draw uncompressed points
    std::shared_ptr<const store::ScalarDataset> scalars;       ///< that colour the layer, if any do
    std::shared_ptr<const store::VolumeDataset> volume;        ///< of an isosurface
    std::shared_ptr<const store::VolumeDataset> colours;       ///< what colours an isosurface, if another volume does
    std::shared_ptr<const store::SurfaceTriangles> triangles;  ///< of an isosurface that is drawn by them
    std::shared_ptr<const PathLight> path_light;               ///< of an isosurface whose pixels are path-traced
    plan::SceneBounds bounds;                                  ///< world
    /// Of an isosurface with global light: texels on their own level sets, and those on the shown surface, which a picture at
    /// rest has in their place unless it is off; or null.
    std::shared_ptr<IlluminationLattice> lattice, rest_lattice;
};

/// What is drawn: one entry per layer of the plan, all with the same centre.
struct DrawList {
    const plan::FramePlan* plan = nullptr;
    std::vector<DrawnLayer> layers;
    plan::RebasedCamera camera;
    std::optional<plan::RebasedCamera> frozen;  ///< that fiblets are culled for, if not for the camera
    glm::vec2 pixel_offset{0};                  ///< added to every sample's place in its pixel, pixels right and down
    glm::dvec3 light_direction_world{0, 0, 1};
    bool moving = false;  ///< transparent fibres are drawn fast
    /// Until when pages of fibres are waited for that are not on the device; none: until they are there.
    std::optional<std::chrono::steady_clock::time_point> pages_until;
    bool all_pages = false;     ///< pages that find no room beside each other are drawn one after the other, for picks
    bool settled = false;       ///< global light is that of a picture at rest
    bool picture_only = false;  ///< nobody reads the sample's surface buffer
    bool same_view = false;     ///< what the target's surface buffer had last is drawn again
};

/// Rows of work per submission, adapted to the last measured speed so that each takes about kSubmissionMs.
struct BandSize {
    static constexpr double kSubmissionMs = 20;
    double block_rows = 8;  ///< blocks of 8 pixel rows
};

struct PassRun {
    static constexpr std::uint32_t kGroup = 64;  ///< invocations per workgroup; in pictures a block of 8x8 pixels

    gpu::Device& device;
    gpu::CommandRecorder& recorder;
    Pipelines& pipelines;
    Target::Impl& target;
    const DrawList& list;
    int sample = 0;
    const std::atomic<bool>* cancel = nullptr;  ///< may be null

    /// Device addresses of what drawer.cpp filled in.
    std::uint64_t frameAddress() const { return target.params.address(); }
    std::uint64_t layerAddress(std::size_t layer) const;
    std::uint64_t counterAddress() const { return target.params.address() + Target::Impl::kCounterOffset; }

    /// \throws Error(kCancelled) if nobody wants the picture any more
    void checkCancelled() const;

    /// Dispatches one workgroup per block of 8x8 pixels in bands of rows, each submitted and waited for, in the order that
    /// shaders/common/invocation.glsl expects; looks at `cancel` before each. `push` ends with `std::uint32_t first_block_row`,
    /// which is set here.
    template <typename Push>
    void dispatchBands(const gpu::ComputePipeline& pipeline, const std::string& pass, Push push, BandSize& size) {
        const std::uint32_t blocks_x = static_cast<std::uint32_t>(target.width + 7) / 8;
        const std::uint32_t blocks_y = static_cast<std::uint32_t>(target.height + 7) / 8;
        for (std::uint32_t row = 0; row < blocks_y;) {
            checkCancelled();
            const std::uint32_t left = blocks_y - row, wanted = bandRows(size, left), runs = std::min(wanted, rowRuns());
            // Rows below the picture have no pixels, rows of the next band would be drawn twice.
            const std::uint32_t of_each = wanted == left ? (wanted + runs - 1) / runs : wanted / runs;
            const std::uint32_t rows = std::min(of_each * runs, left);
            push.first_block_row = row;
            recorder.dispatch(pipeline, pass, blocks_x, of_each, runs, push);
            submitBand(size, rows);
            row += rows;
        }
    }

    /// Workgroups for one invocation each.
    static std::uint32_t groups(std::uint64_t count) { return static_cast<std::uint32_t>((count + kGroup - 1) / kGroup); }
    std::uint64_t pixels() const {
        return static_cast<std::uint64_t>(target.width) * static_cast<std::uint64_t>(target.height);
    }

private:
    /// Into how many runs rows of blocks are dealt out: one for each thread that a CPU driver may have.
    static std::uint32_t rowRuns();
    static std::uint32_t bandRows(const BandSize& size, std::uint32_t left);
    void submitBand(BandSize& size, std::uint32_t rows) const;
};

}  // namespace radiata::render
