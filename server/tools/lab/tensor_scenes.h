// Glyphs given as Cartesian tensors, for the experiments of Hlawitschka et al.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "model/sh_image.h"
#include "tools/lab/method.h"

namespace radiata::lab {

/// One voxel per function, in a row; each as a tensor of the order and as its
/// bands. \param functions  coefficients of even bands up to `order`, internal
/// convention
model::ShImage tensorImage(int order, const std::vector<std::vector<float>>& functions);

/// f turned by an angle about an axis. \param k  even bands up to it
std::vector<float> turned(int k, const std::vector<float>& function, const glm::dvec3& axis, double angle);

/// tensor-march with steps of 0.01, 0.02 and 0.05 and each refinement of the
/// paper's Table 1, then interval and affine arithmetic. \param adaptive  steps
/// of a third near the centre
std::vector<Method> tensorMarches(bool adaptive);
std::vector<Method> tensorRanges();

/// The first glyphs of the sample stiffness field that are no voids, as many as
/// asked for.
model::ShImage stiffnessGlyphs(std::size_t glyphs);

}  // namespace radiata::lab
