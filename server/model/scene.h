// What is shown: layers, light, background. Mirrors proto/radiata/v1/scene.proto with every choice filled in.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "math/colour_map.h"
#include "model/colour_range.h"
#include "model/illumination.h"
#include "model/isosurface_layer.h"
#include "model/tractogram_layer.h"

namespace radiata::model {

enum class Plane { kAxial, kCoronal, kSagittal, kOblique };
enum class Region { kSlice, kSlab, kVolume };
enum class ScaleMode { kGlobal, kPerGlyph, kAbsolute };
enum class NegativeLobes { kHidden, kShown };
enum class Shadow { kNone, kHard, kSoft };
/// What is drawn of a tensor: the surface of distance |T(x, ..., x)| (any order), or the ellipsoid with the eigenvalues as half
/// axes (order 2).
enum class TensorShape { kReynolds, kEllipsoid };
enum class Convention { kRadiological, kNeurological };

/// Which voxels of a dataset get a glyph.
struct VoxelSelection {
    Region region = Region::kVolume;
    Plane plane = Plane::kAxial;
    std::optional<glm::dvec3> position_mm;  ///< world; none: the dataset's centre
    glm::dvec3 normal{0, 0, 1};             ///< for kOblique; any length but zero
    double thickness_mm = 0;                ///< for kSlab
    bool operator==(const VoxelSelection&) const = default;
};

struct GlyphScale {
    ScaleMode mode = ScaleMode::kGlobal;
    float factor = 1;
    bool operator==(const GlyphScale&) const = default;
};

enum class ColourMode { kDirection, kRadius, kScalar, kUniform };

/// Where the base colour of a glyph's surface comes from.
struct GlyphColour {
    ColourMode mode = ColourMode::kDirection;
    ColourMap map = ColourMap::kViridis;  ///< kRadius and kScalar
    std::optional<ColourRange> range;     ///< of the map: mm, or values of the image; none: chosen by the plan
    std::string image_id;                 ///< kScalar: catalogue id of a scalar volume on the grid of the glyphs' image
    glm::vec3 uniform{0.5F};              ///< kUniform: linear RGB
    bool usesMap() const { return mode == ColourMode::kRadius || mode == ColourMode::kScalar; }
    bool operator==(const GlyphColour&) const = default;
};

/// What an image of uncertainty holds: the outer glyphs themselves, or standard deviations of the coefficients.
enum class UncertaintyKind { kGlyphs, kDeviations };

/// A second glyph around each glyph, drawn as a homogeneous medium (Peters et al. 2023, Sec. 4.3).
struct Uncertainty {
    std::string dataset_id;
    UncertaintyKind kind = UncertaintyKind::kGlyphs;
    float deviations = 1;                    ///< of kDeviations: how many the outer surface is away
    std::optional<float> extinction_per_mm;  ///< none: 2 / half the voxel
    glm::vec3 emission{0.21404114F};         ///< linear RGB; the default is the sRGB triple (1/2, 1/2, 1/2) of the paper
    bool operator==(const Uncertainty&) const = default;
};

struct GlyphLayer {
    std::string dataset_id;
    VoxelSelection selection;
    GlyphScale scale;
    std::optional<int> lmax;  ///< none: all bands
    NegativeLobes negative_lobes = NegativeLobes::kHidden;
    GlyphColour colour;
    std::optional<TensorShape> tensor;  ///< the layer is one of tensor glyphs
    std::optional<Uncertainty> uncertainty;
    float isotropic_part = 0;  ///< added in all directions, in units of the dataset's typical amplitude
    bool operator==(const GlyphLayer&) const = default;
};

struct Layer {
    std::variant<GlyphLayer, TractogramLayer, IsosurfaceLayer> content;
    float opacity = 1;
    bool casts_shadows = true;

    /// Null: the layer is of another kind.
    const GlyphLayer* ifGlyphs() const { return std::get_if<GlyphLayer>(&content); }
    const TractogramLayer* ifTracts() const { return std::get_if<TractogramLayer>(&content); }
    const IsosurfaceLayer* ifSurface() const { return std::get_if<IsosurfaceLayer>(&content); }
    /// \throws std::bad_variant_access for a layer of another kind
    GlyphLayer& glyphs() { return std::get<GlyphLayer>(content); }
    const GlyphLayer& glyphs() const { return std::get<GlyphLayer>(content); }
    TractogramLayer& tracts() { return std::get<TractogramLayer>(content); }
    const TractogramLayer& tracts() const { return std::get<TractogramLayer>(content); }
    IsosurfaceLayer& surface() { return std::get<IsosurfaceLayer>(content); }
    const IsosurfaceLayer& surface() const { return std::get<IsosurfaceLayer>(content); }
    const std::string& datasetId() const {
        return std::visit([](const auto& layer) -> const std::string& { return layer.dataset_id; }, content);
    }

    bool operator==(const Layer&) const = default;
};

struct AmbientOcclusion {
    int rays = 16;
    std::optional<float> radius_mm;  ///< none: twice the shortest voxel edge of the first layer
    bool operator==(const AmbientOcclusion&) const = default;
};

/// The default is the light named "headlight-left": above and left of the viewer.
struct Light {
    glm::dvec3 direction_camera{-0.4, 0.6, 1.0};
    std::optional<glm::dvec3> direction_world;  ///< takes the place of direction_camera
    float irradiance = 2.6F;
    float ambient = 0.35F;
    Shadow shadow = Shadow::kNone;
    float angular_radius_deg = 5;  ///< of the spherical light of soft shadows
    int shadow_rays = 16;          ///< of soft shadows, per sample
    std::optional<AmbientOcclusion> ambient_occlusion;
    std::optional<Illumination> illumination;  ///< lights opaque isosurfaces in place of the rest
    bool operator==(const Light&) const = default;
};

struct Annotations {
    Convention convention = Convention::kRadiological;
    bool hidden = false;
    bool operator==(const Annotations&) const = default;
};

struct Scene {
    std::vector<Layer> layers;
    Light light;
    glm::vec3 background{0};
    Annotations annotations;
    bool operator==(const Scene&) const = default;
};

}  // namespace radiata::model
