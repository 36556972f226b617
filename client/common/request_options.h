// The options that describe a picture, shared by all native programs, and the request they make.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "radiata/v1/catalog.grpc.pb.h"
#include "radiata/v1/frame.pb.h"

#include "common/connection.h"
#include "common/fibre_options.h"
#include "common/isosurface_options.h"
#include "common/light_options.h"
#include "common/tensor_options.h"
#include "common/uncertainty_options.h"

namespace radiata::client {

/// What the options say. Vectors hold three numbers, or none where the option was not given; absent choices are left to the
/// server.
struct RequestOptions {
    std::string dataset;  ///< empty: the only one there is
    v1::Plane plane = v1::PLANE_AXIAL;
    std::vector<double> position_mm;
    std::vector<double> normal;
    std::optional<double> slab_mm;
    bool volume = false;
    v1::GlyphScale::Mode scale = v1::GlyphScale::MODE_GLOBAL;
    std::optional<float> factor;
    std::optional<std::uint32_t> lmax;
    v1::NegativeLobes lobes = v1::NEGATIVE_LOBES_HIDDEN;
    std::string colour;  ///< direction, radius, scalar or uniform; empty: the server's choice
    v1::ColourMap colour_map = v1::COLOUR_MAP_UNSPECIFIED;
    std::vector<double> colour_range;  ///< two numbers
    std::string colour_image;
    std::vector<double> uniform_colour;
    TensorOptions tensors;
    FibreOptions fibres;
    IsosurfaceOptions isosurfaces;
    std::optional<float> opacity;
    UncertaintyOptions uncertainty;
    std::optional<float> isotropic_part;
    std::string size = "1280x720";
    v1::Annotations::Convention convention = v1::Annotations::CONVENTION_RADIOLOGICAL;
    bool no_annotations = false;
    std::optional<std::uint32_t> samples;
    v1::IntersectionMethod intersection = v1::INTERSECTION_METHOD_MARCH;
    v1::PolynomialSettings::Stop polynomial_stop = v1::PolynomialSettings::STOP_UNSPECIFIED;
    std::optional<double> tolerance;
    std::optional<std::uint32_t> march_steps;
    std::optional<std::uint32_t> refinements;
    v1::GlyphBoxes glyph_boxes = v1::GLYPH_BOXES_UNSPECIFIED;
    v1::Traversal traversal = v1::TRAVERSAL_UNSPECIFIED;
    v1::PoleTable pole_table = v1::POLE_TABLE_UNSPECIFIED;
    v1::PoleTable sun_table = v1::POLE_TABLE_UNSPECIFIED;
    v1::SphereMesh mesh = v1::SPHERE_MESH_UNSPECIFIED;
    std::optional<std::uint32_t> mesh_level;
    v1::MeshNormals mesh_normals = v1::MESH_NORMALS_UNSPECIFIED;
    std::optional<std::uint32_t> jpeg_quality;
    bool fxaa = false;
    LightOptions light;
    bool no_casting = false;
    std::vector<double> background;
    std::string camera;  ///< file or JSON; empty: the server's FitCamera
};

/// Adds the options to a command; --camera only where one camera is wanted.
void addRequestOptions(CLI::App& app, RequestOptions& options, bool with_camera);

/// \throws ClientError(kUsage) if options contradict each other or "WxH" is not a size
v1::FrameRequest makeRequest(const RequestOptions& options);

/// Fills in what only the server knows: the dataset if there is one only, and the camera that fits it unless one is set.
/// \param plane  isosurfaces are looked at along its normal
/// \throws ClientError(kUsage) if no dataset was named and the server has none or several
void completeRequest(v1::FrameRequest& request, const Connection& connection, v1::Plane plane);

}  // namespace radiata::client
