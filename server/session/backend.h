// What sessions need from whatever draws: a few functions, so that a stub fits where there is no device.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/frame.h"
#include "model/pick.h"
#include "model/selection.h"

namespace radiata::session {

/// Adds samples [first_sample, first_sample + count) to the picture of a view and returns it; the contract of
/// render::Renderer::render, with one target per view id. Ids are never used twice. No samples of a picture of one: works for a
/// slice of time at its light and answers with info.samples 0 until that is done, then 1. \throws Error(kCancelled) at most 50
/// ms after `cancel` was raised
using RenderFunction = std::function<model::Frame(std::uint64_t view, const model::FrameRequest& request, int first_sample,
                                                  int count, const model::Outputs& outputs, const std::atomic<bool>* cancel)>;

struct Backend {
    // Called by the one render thread only.
    RenderFunction render;
    std::function<void(std::uint64_t view)> release;  ///< the view will not be drawn again
    std::function<model::Camera(const std::string& dataset_id, const model::VoxelSelection& selection,
                                model::Convention convention, double aspect)>
        fit_camera;

    /// What the ray through a pixel's centre hits, without its peaks; nothing if it hits nothing.
    /// \param all_hits  of the ray with a glyph are wanted, for a request that model::checkAllHits() lets pass
    std::function<std::optional<model::Picked>(const model::FrameRequest& request, int x, int y, int radius_px, bool all_hits)>
        pick;

    /// Fibres within an outline; the contract of render::Renderer::pickFibres.
    std::function<std::vector<model::PickedFibres>(const model::FrameRequest& request, const std::vector<glm::dvec2>& outline,
                                                   bool through)>
        pick_fibres;

    // Called by any thread.
    std::function<std::vector<model::DatasetInfo>()> list;
    std::function<model::DatasetInfo(const std::string& id)> info;  ///< \throws Error(kNotFound)

    /// \throws Error(kNotFound, kInvalidArgument) as model/selection_text.h and build/fibre_selection.h say
    std::function<model::SelectedFibres(const std::string& id, const std::string& selection)> select;
    /// Writes the selected fibres as .tck or .trx. \return the files written
    std::function<std::vector<std::filesystem::path>(const std::string& id, const std::string& selection,
                                                     const std::filesystem::path& file)>
        write_fibres;

    /// Whether all that the request is drawn from is there: its datasets, those of its regions, triangles that are made for an
    /// isovalue. Answers at once.
    std::function<bool(const model::FrameRequest& request)> resident;
    /// Brings them there, which may take long. \throws what rendering the request would
    std::function<void(const model::FrameRequest& request)> load;
    /// Whether what is made of that for the request is there too, such as selections of fibres, and makes it, which may take
    /// long: once resident() says yes. Empty: nothing is. \throws as load
    std::function<bool(const model::FrameRequest& request)> made;
    std::function<void(const model::FrameRequest& request)> make;

    std::string device;
    std::vector<std::string> traversals;
};

}  // namespace radiata::session
