// Isosurfaces in a scene, and how rays find them. Mirrors proto/radiata/v1/isosurface.proto.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace radiata::model {

/// The surface of one value of a scalar volume.
struct IsosurfaceLayer {
    std::string dataset_id;
    std::optional<float> isovalue;          ///< none: the value that splits the volume best in two
    glm::vec3 colour{0.75F, 0.68F, 0.55F};  ///< linear RGB
    bool operator==(const IsosurfaceLayer&) const = default;
};

enum class SurfaceMethod { kExact, kMarchBisect };
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
