// Isosurfaces in a scene, and how rays find them. Mirrors proto/radiata/v1/isosurface.proto.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "math/colour_map.h"
#include "model/colour_range.h"

namespace radiata::model {

/// How a surface reflects the scene's light. kScene: as everything else does, and by global light if there is any. The others
/// are the local ways that Wyman et al. 2006 compare with in Fig. 8 and 9: Lambert's cosine, and with Phong's highlight, both
/// with ambient light that varies with the normal. Numbers as in shaders/shared/surface_look.glsl.
enum class SurfaceShading { kScene, kLambert, kPhong };

/// Colours of a surface by what another volume, on any grid, holds where the surface is.
struct VolumeColour {
    std::string image_id;
    ColourMap map = ColourMap::kViridis;
    std::optional<ColourRange> range;  ///< none: from the volume's smallest to its largest value
    bool operator==(const VolumeColour&) const = default;
};

/// The surface of one value of a scalar volume.
struct IsosurfaceLayer {
    std::string dataset_id;
    std::optional<float> isovalue;          ///< none: the value that splits the volume best in two
    glm::vec3 colour{0.75F, 0.68F, 0.55F};  ///< linear RGB; light that bounces off the surface has it
    SurfaceShading shading = SurfaceShading::kScene;
    std::optional<float> fog{};               ///< share of the background at the far end of the volume's box; above 0, to 1
    std::optional<VolumeColour> colour_by{};  ///< what is seen in place of `colour`
    bool operator==(const IsosurfaceLayer&) const = default;
};

/// The cubic of each cell; steps and bisection; triangles of marching cubes, made anew for each isovalue. Of kMarchingCubes
/// what light, shadows and transparent surfaces need beyond the first hits is traced exactly.
enum class SurfaceMethod { kExact, kMarchBisect, kMarchingCubes };
enum class SurfaceNormals { kSpline, kTrilinear };

struct IsosurfaceSettings {
    SurfaceMethod method = SurfaceMethod::kExact;
    float step = 0.5F;    ///< of kMarchBisect, shortest voxel edges
    int bisections = 10;  ///< of kMarchBisect
    SurfaceNormals normals = SurfaceNormals::kSpline;
    bool bricks = true;
    bool operator==(const IsosurfaceSettings&) const = default;
};

}  // namespace radiata::model
