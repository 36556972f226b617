// What a picture is made from, and what is known about it afterwards. Mirrors proto/radiata/v1/{quality,frame}.proto.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/camera.h"
#include "model/intersection.h"
#include "model/left_out.h"
#include "model/scene.h"
#include "model/tessellation.h"

namespace radiata::model {

enum class Traversal { kAuto, kRayQuery, kBvh, kTiles, kRasterBoxes };
enum class PoleTable { kAuto, kOn, kOff };

/// Settings of the methods that draw tensors themselves; Hlawitschka et al., Sec. 4 and 5.
struct TensorMarchSettings {
    float step = 0.02F;       ///< radii of the glyph's bounding sphere
    int bisections = 0;       ///< of the bracket in which the surface was found
    bool interpolate = true;  ///< one linear interpolation after them; else the middle of the bracket
    bool adaptive = true;     ///< steps of a third near the centre
    int depth = 12;           ///< intervals and affine forms: a ray is halved so many times at most
    bool operator==(const TensorMarchSettings&) const = default;
};

struct Quality {
    int samples = 16;  ///< per pixel of a picture at rest
    Intersection intersection = Intersection::kMarch;
    Traversal traversal = Traversal::kAuto;
    PoleTable pole_table = PoleTable::kAuto;
    PoleTable sun_table = PoleTable::kAuto;  ///< for rays towards the light of hard shadows
    TensorMarchSettings tensor_march;
    Tessellation tessellation;      ///< for kTessellated
    PolynomialSettings polynomial;  ///< of the methods by polynomials
    RayMarchSettings ray_march;     ///< of the marches with equal steps
    GlyphBoxes glyph_boxes = GlyphBoxes::kTight;
    FibletPipeline fiblet_pipeline = FibletPipeline::kAuto;
    FibletCulling fiblet_culling = FibletCulling::kAuto;
    std::optional<Camera> frozen_culling;   ///< fibres are drawn that two phases see from here, in a picture of the same size
    bool fxaa = false;                      ///< pictures of one sample have their edges smoothed
    std::optional<float> fiblet_detail_px;  ///< that lines may be off, to be fewer; none: every segment is drawn
    IsosurfaceSettings isosurface;
    int jpeg_quality = 90;
    bool operator==(const Quality&) const = default;
};

struct FrameRequest {
    Scene scene;
    Camera camera;
    Quality quality;
    int width = 1280;
    int height = 720;
    bool operator==(const FrameRequest&) const = default;
};

/// Bits of the lossless outputs that are wanted beside the picture.
struct Outputs {
    bool depth = false;
    bool id = false;
    bool position = false;
    bool normal = false;
    bool steps = false;
    bool any() const { return depth || id || position || normal || steps; }
};

enum class FrameState { kInteractive, kRefining, kConverged };

struct PassTime {
    std::string name;
    std::string shader;
    double time_ms = 0;
};

/// Everything about a frame but its pixels.
struct FrameInfo {
    FrameRequest request;  ///< with every open choice filled in
    FrameState state = FrameState::kInteractive;
    int samples = 0;  ///< in this picture
    std::vector<PassTime> passes;
    double render_ms = 0;  ///< wall clock, passes and read-back
    bool pole_table_used = false;
    std::string pole_table_reason;
    std::string traversal_reason;
    bool sun_table_used = false;
    std::string sun_table_reason;  ///< empty: no rays towards the light
    std::uint64_t glyphs = 0;
    std::uint64_t glyphs_available = 0;
    std::vector<LeftOut> left_out;  ///< of layers of glyphs that leave out something
    std::uint64_t hit_pixels = 0;
    std::uint64_t capped_rays = 0;
    std::uint64_t fiblets = 0;        ///< of all layers of fibres
    std::uint64_t fiblets_drawn = 0;  ///< of the latest sample
    /// Of tractograms that take more than the device memory for them, in the latest sample: pages of fiblets that can be seen,
    /// those of them that are shown in full, and those that have no room beside the others; of the rest a subset of their
    /// fibres is shown, while they come or instead.
    std::uint64_t fiblet_pages_wanted = 0, fiblet_pages_resident = 0, fiblet_pages_left_out = 0;
    std::uint64_t fiblet_bytes_read = 0;  ///< of pages that came to the device while the frame was drawn
    double fiblet_error_px = 0;           ///< bound on how far simplified lines are off; 0: there are none
    double depth_offset_mm = 0;
    glm::dvec3 position_origin_mm{0};
    std::string device;
    std::optional<IlluminationInfo> illumination;  ///< of scenes with global light
};

/// Row-major, first row on top. Arrays that were not wanted are empty.
struct FramePixels {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;   ///< sRGB, 4 bytes a pixel, alpha 255
    std::vector<float> depth;         ///< along the line of sight minus depth_offset_mm; +inf: nothing
    std::vector<std::int32_t> id;     ///< 4 a pixel: layer, i, j, k; -1: nothing
    std::vector<float> position;      ///< 3 a pixel: world minus position_origin_mm; NaN: nothing
    std::vector<float> normal;        ///< 3 a pixel: unit, world, towards the viewer; 0: nothing
    std::vector<std::int32_t> steps;  ///< march steps over all glyphs tried
};

struct Frame {
    FrameInfo info;
    FramePixels pixels;
};

}  // namespace radiata::model
