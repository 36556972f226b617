// The camera that shows a selection the way its users are used to.
#pragma once

#include "model/camera.h"
#include "model/scene.h"
#include "plan/camera_rays.h"

namespace radiata::plan {

/// Orthographic, the selection's bounds fitted into the picture with a 2 % margin. Axial: radiological from the feet (a
/// person's left on the right of the picture), neurological from above; coronal: from the front, or from behind; sagittal: from
/// the left side, nose to the left. Oblique: against the normal. A whole volume is seen as an axial slice is. \param aspect
/// width divided by height of the picture
model::Camera fitCamera(const SceneBounds& bounds, const model::VoxelSelection& selection, model::Convention convention,
                        double aspect);

}  // namespace radiata::plan
