// A frame is planned before anything is drawn: what was asked, what the datasets hold and what the device can do become a list
// of passes. Pure data and pure functions; tested without a device.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "math/sh_layout.h"
#include "model/frame.h"
#include "plan/plan_fiblets.h"

namespace radiata::plan {

/// What a device can do, as far as planning cares.
struct Abilities {
    bool ray_query = false;
    bool bvh = true;  ///< these two may have failed the start-up self-test
    bool tiles = true;
    bool software = false;  ///< a CPU rasteriser
    bool raster = false;    ///< draws triangles
    bool int64_atomics = false;
    bool lines = false;  ///< the device's rasteriser draws lines of pixels, up to line_width_max across
    float line_width_max = 1;
    bool mesh_shader = false, mesh_subgroups = false;
    bool geometry_shader = false, tessellation_shader = false;
    std::uint32_t failed_pipelines = 0;  ///< bit 1 << model::FibletPipeline for each that failed its self-test
    bool float64 = false;                ///< shaders in double precision
};

/// What is known about one layer of the request before drawing it.
struct LayerFacts {
    ShLayout layout;           ///< of the dataset
    int tensor_order = 0;      ///< of the dataset's tensors; 0: it has none
    std::uint64_t glyphs = 0;  ///< shown
    std::uint64_t glyphs_available = 0;
    double rays_per_glyph = 0;              ///< estimate: pixels of the picture that the layer covers, divided by its glyphs
    double depth_complexity = 1;            ///< estimate: glyph boxes along one ray
    double radius_typical_mm = 0;           ///< of the typical amplitude
    double value_min = 0, value_max = 0;    ///< of the volume that colours the layer or is its isosurface, if there is one
    model::ColourRange colours;             ///< values of the volume that colours an isosurface
    double value_split = 0;                 ///< of an isosurface's volume: what splits it best in two
    bool odd_bands_only = false;            ///< all even bands of a full layout are 0
    bool camera_close = false;              ///< the eye is inside or next to some glyph, where the pole frame is not defined
    double voxel_edge_mm = 0;               ///< the shortest
    double sun_depth = 0;                   ///< estimate: glyph boxes along a ray towards the light
    std::uint64_t fibres = 0, fiblets = 0;  ///< of a tractogram
    bool segments_filtered = false;         ///< single segments of them are left out
    bool paged = false;                     ///< not all of its fiblets are on the device
    std::vector<LayerFacts> uncertainty;    ///< of the layer's second glyphs: one entry, or none
};

/// How one glyph layer is drawn.
struct GlyphPlan {
    std::string layout_name;  ///< "even8": bands compiled in, the layout's lmax rounded up to an even number of at least 2
    std::uint32_t used = 0;   ///< coefficients that count; the band limit
    bool pole_table = false;
    bool both_lobes = false;
    std::uint32_t table_floats = 0;               ///< per glyph, of the table if there is one
    std::string method_module;                    ///< part of the modules' names: "polynomial_"; empty: the march
    std::vector<std::uint32_t> method_constants;  ///< specialisation constants of the method's settings, from id 9 on
};

/// Which secondary rays a frame has. None of them: no pass, buffer or shader variant for them.
struct VisibilityPlan {
    model::Shadow shadow = model::Shadow::kNone;
    bool occlusion = false;
    bool sun_table = false;  ///< rays towards the light of hard shadows use a table per glyph
    bool sun_tiles = false;  ///< and find boxes by lists along the light's direction, not by the hierarchy
    std::string sun_table_reason;
};

enum class PassKind {
    kGlyphTable,
    kGlyphTrace,
    kUncertaintyTable,
    kUncertainty,
    kGlyphBoxes,       ///< boxes drawn, one march per fragment
    kGlyphTessellate,  ///< runs part by part together with the next
    kGlyphMesh,
    kRasterSurface,    ///< what was drawn, into the surface buffer
    kFiblets,          ///< culls, draws and hands on a layer of fibres
    kClear,            ///< an empty surface buffer, where no pass writes all of it
    kPeels,            ///< all transparent layers, from the front, over the surface buffer
    kIsosurfaceTrace,  ///< first hits of an opaque isosurface
    kIsosurfaceMesh,   ///< the same by its triangles
    kIsosurfaceVeil,   ///< all transparent isosurfaces where nothing else is, over the surface buffer
    kIllumination,     ///< global light of an isosurface, and the texels that it lacks
    kPixelPaths,       ///< global light of an isosurface by paths from its pixels
    kSunTable,
    kShadow,
    kOcclusion,
    kLight,
    kResolve,
    kFxaa  ///< smooths a resolved picture of one sample
};

/// One pass, in order of execution.
struct PassPlan {
    PassKind kind;
    std::string name;     ///< "glyph table 0", "glyph trace 0", "uncertainty 0", "sun table 0", "shadow 0", "light", "resolve"
    std::string shader;   ///< module
    int layer = -1;       ///< of passes that draw or light one layer
    bool first = false;   ///< of the layer that writes the surface buffer first: every pixel of it, and reads none
    bool peeled = false;  ///< writes a surface buffer of its own, for kPeels
};

struct FramePlan {
    model::FrameRequest resolved;                       ///< the request with every choice filled in
    std::vector<GlyphPlan> glyphs;                      ///< one per layer; empty for layers of other kinds
    std::vector<std::optional<GlyphPlan>> uncertainty;  ///< of each layer's second glyphs, where it has them
    std::vector<std::optional<FibletPlan>> fiblets;     ///< of layers of fibres
    VisibilityPlan visibility;
    std::vector<PassPlan> passes;
    /// What the light pass is compiled for: bit 1 << model::ColourMode for each that some layer has.
    std::uint32_t colour_modes = 0;
    /// And for which kinds of layers: bit 1 << index of model::Layer::content.
    std::uint32_t layer_kinds = 0;
    bool fibre_occlusion = false, fibre_halos = false;  ///< some layer has them
    std::uint32_t paged_layers = 0;                     ///< bit of each layer of fibres that is not all on the device
    std::uint32_t fibre_colours = 0;                    ///< bit 1 << model::FibreColourMode for each that some layer has
    std::uint32_t surface_looks = 0;                    ///< shader::SURFACE_LOOKS_...: what some isosurface has of its own
    std::uint32_t peeled_layers = 0;                    ///< bit 1 << index of each that kPeels composes
    std::string traversal_reason;
    std::string pole_table_reason;
    bool uses_pole_table = false;

    bool usesPeels() const {
        return std::ranges::any_of(passes, [](const PassPlan& pass) { return pass.kind == PassKind::kPeels; });
    }
    bool usesVeil() const {
        return usesPeels() ||
               std::ranges::any_of(passes, [](const PassPlan& pass) { return pass.kind == PassKind::kIsosurfaceVeil; });
    }
    bool usesPathTracing() const {
        return std::ranges::any_of(passes, [](const PassPlan& pass) { return pass.kind == PassKind::kPixelPaths; });
    }
    /// By a lattice or by paths.
    bool usesGlobalLight() const {
        return usesPathTracing() ||
               std::ranges::any_of(passes, [](const PassPlan& pass) { return pass.kind == PassKind::kIllumination; });
    }
    bool usesUncertainty() const {
        return std::ranges::any_of(uncertainty, [](const auto& second) { return second.has_value(); });
    }
};

/// How glyphs with these bands up to lmax are drawn, without a table. An even layout takes the band below an odd lmax.
GlyphPlan planBands(ShLayout layout, int lmax, bool both_lobes);

/// \param layers  one per layer of the scene
/// \throws Error(kInvalidArgument) for a band limit above the data, Error(kUnsupported) for a traversal that the device lacks
///         or a method that does not fit the data (see method_plan.h), with what would do
FramePlan planFrame(const model::FrameRequest& request, const std::vector<LayerFacts>& layers, const Abilities& abilities);

/// Highest band and box pixels per glyph from which the table pays: below, a read of its longer rows costs as much as turning
/// the coefficients. Measured on lavapipe only: no gain at band 10 with 13 pixels and at band 8 with any, a gain of 1.0 to 1.6
/// at band 12 with one glyph filling the view (radiata-lab run glyph-frame, march-vs-polynomial).
constexpr int kPoleTableBand = 12;
constexpr double kPoleTableRays = 32.0;
/// Box pixels per glyph from which the table for rays towards the light pays: a part of the pixels in a glyph's box shows a
/// surface that faces the light.
constexpr double kSunTableRays = 12.0;
/// Boxes along a ray up to which lists per tile are shorter than a walk through a hierarchy.
constexpr double kTileDepth = 6.0;

}  // namespace radiata::plan
