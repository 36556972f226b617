#include "common/request_options.h"

#include <algorithm>
#include <charconv>

#include "common/camera_json.h"
#include "common/client_error.h"
#include "common/enum_words.h"

namespace radiata::client {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw ClientError(ExitCode::kUsage, message); }

void setVector(v1::Vec3& vector, const std::vector<double>& values) {
    vector.set_x(values[0]);
    vector.set_y(values[1]);
    vector.set_z(values[2]);
}

CLI::Option* addVector(CLI::App& app, const std::string& name, std::vector<double>& values, const std::string& what) {
    return app.add_option(name, values, what)->delimiter(',')->expected(3)->type_name("X,Y,Z");
}

template <typename Enum>
void addWords(CLI::App& app, const std::string& name, Enum& value, const google::protobuf::EnumDescriptor* type,
              const std::string& what, const std::string& unspecified = "") {
    const auto words = enumWords<Enum>(type, unspecified);
    std::string list;
    for (const auto& [word, number] : words) list += (list.empty() ? "" : "|") + word;
    app.add_option_function<std::string>(
           name,
           [&value, words, name, list](const std::string& word) {
               // The server's own lists write ray_query; both spellings are understood.
               std::string spelled = word;
               std::replace(spelled.begin(), spelled.end(), '_', '-');
               const auto found = words.find(spelled);
               if (found == words.end()) throw CLI::ValidationError(name, "'" + word + "' is not one of " + list);
               value = found->second;
           },
           what)
        ->type_name(list);
}

void setSize(v1::FrameRequest& request, const std::string& text) {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
    if (good) {
        const auto second = std::from_chars(first.ptr + 1, end, height);
        good = second.ec == std::errc() && second.ptr == end;
    }
    if (!good) refuse("--size is '" + text + "'; it must be WIDTHxHEIGHT in pixels, such as 1280x720");
    request.set_width(width);
    request.set_height(height);
}

void setSelection(v1::VoxelSelection& selection, const RequestOptions& options) {
    const bool oblique = options.plane == v1::PLANE_OBLIQUE;
    if (oblique && options.normal.empty()) refuse("--plane oblique needs --normal X,Y,Z");
    if (!oblique && !options.normal.empty()) refuse("--normal goes with --plane oblique only");
    if (options.volume) {
        if (options.slab_mm) refuse("--slab and --volume exclude each other");
        if (oblique || !options.position_mm.empty())
            refuse("--volume shows everything; --plane and --position say nothing then");
        selection.mutable_volume();
        return;
    }
    v1::Slice& slice = options.slab_mm ? *selection.mutable_slab()->mutable_middle() : *selection.mutable_slice();
    if (options.slab_mm) selection.mutable_slab()->set_thickness_mm(*options.slab_mm);
    slice.set_plane(options.plane);
    if (!options.position_mm.empty()) setVector(*slice.mutable_position_mm(), options.position_mm);
    if (oblique) setVector(*slice.mutable_normal(), options.normal);
}

template <typename Message>
void setMap(Message& message, const RequestOptions& options) {
    message.set_map(options.colour_map);
    if (options.colour_range.empty()) return;
    message.mutable_range()->set_low(static_cast<float>(options.colour_range[0]));
    message.mutable_range()->set_high(static_cast<float>(options.colour_range[1]));
}

void setColour(v1::GlyphLayer& glyphs, const RequestOptions& options) {
    const bool scalar = options.colour == "scalar", mapped = scalar || options.colour == "radius";
    const bool uniform = options.colour == "uniform";
    if (!mapped && (options.colour_map != v1::COLOUR_MAP_UNSPECIFIED || !options.colour_range.empty())) {
        refuse("--colour-map and --colour-range go with --colour radius or scalar only");
    }
    if (scalar == options.colour_image.empty()) {
        refuse(scalar ? "--colour scalar needs --colour-image ID" : "--colour-image goes with --colour scalar only");
    }
    if (!uniform && !options.uniform_colour.empty()) refuse("--uniform-colour goes with --colour uniform only");
    if (options.colour.empty()) return;
    v1::GlyphColour& colour = *glyphs.mutable_colour();
    if (scalar) {
        colour.mutable_scalar()->set_image_id(options.colour_image);
        setMap(*colour.mutable_scalar(), options);
    } else if (mapped) {
        setMap(*colour.mutable_radius(), options);
    } else if (uniform) {
        setVector(*colour.mutable_uniform(),
                  options.uniform_colour.empty() ? std::vector<double>{0.5, 0.5, 0.5} : options.uniform_colour);
    } else {
        colour.mutable_direction();
    }
}

void setTessellation(v1::Quality& quality, const RequestOptions& options) {
    const bool given = options.mesh != v1::SPHERE_MESH_UNSPECIFIED || options.mesh_level ||
                       options.mesh_normals != v1::MESH_NORMALS_UNSPECIFIED;
    if (!given) return;
    if (options.intersection != v1::INTERSECTION_METHOD_TESSELLATED) {
        refuse("--mesh, --mesh-level and --mesh-normals go with --intersection tessellated only");
    }
    v1::Tessellation& tessellation = *quality.mutable_tessellation();
    tessellation.set_mesh(options.mesh);
    if (options.mesh_level) tessellation.set_level(*options.mesh_level);
    tessellation.set_normals(options.mesh_normals);
}

void setQuality(v1::Quality& quality, const RequestOptions& options) {
    if (options.samples) quality.set_samples(*options.samples);
    quality.set_intersection(options.intersection);
    if (options.polynomial_stop != v1::PolynomialSettings::STOP_UNSPECIFIED) {
        quality.mutable_polynomial()->set_stop(options.polynomial_stop);
    }
    if (options.tolerance) quality.mutable_polynomial()->set_tolerance(*options.tolerance);
    if (options.march_steps) quality.mutable_ray_march()->set_steps(*options.march_steps);
    if (options.refinements) quality.mutable_ray_march()->set_refinements(*options.refinements);
    quality.set_glyph_boxes(options.glyph_boxes);
    quality.set_traversal(options.traversal);
    quality.set_pole_table(options.pole_table);
    quality.set_sun_table(options.sun_table);
    if (options.tensors.march.ByteSizeLong() > 0) *quality.mutable_tensor_march() = options.tensors.march;
    setTessellation(quality, options);
    setFibreQuality(quality, options.fibres);
    quality.set_fxaa(options.fxaa);
    if (options.jpeg_quality) quality.set_jpeg_quality(*options.jpeg_quality);
}

void addGlyphs(v1::Scene& scene, const RequestOptions& options) {
    v1::Layer& layer = *scene.add_layers();
    if (options.opacity) layer.set_opacity(*options.opacity);
    if (options.no_casting) layer.set_casts_shadows(false);
    v1::GlyphLayer& glyphs = glyphsOf(layer, options.tensors);
    glyphs.set_dataset_id(options.dataset);
    setSelection(*glyphs.mutable_selection(), options);
    glyphs.mutable_scale()->set_mode(options.scale);
    if (options.factor) glyphs.mutable_scale()->set_factor(*options.factor);
    if (options.lmax) glyphs.set_lmax(*options.lmax);
    glyphs.set_negative_lobes(options.lobes);
    setColour(glyphs, options);
    setUncertainty(glyphs, options.uncertainty);
    if (options.isotropic_part) glyphs.set_isotropic_part(*options.isotropic_part);
}

std::string onlyDataset(v1::CatalogService::Stub& stub, const Connection& connection) {
    grpc::ClientContext context;
    connection.prepare(context);
    v1::ListDatasetsResponse response;
    connection.check(stub.ListDatasets(&context, {}, &response));
    std::string ids;
    std::string only;
    int count = 0;
    for (const v1::Dataset& dataset : response.datasets()) {
        // Volumes of numbers colour glyphs and have none, maps are light, meshes cut; tractograms are named by --tracts.
        if (dataset.kind() == v1::DATASET_KIND_SCALAR_VOLUME || dataset.kind() == v1::DATASET_KIND_TRACTOGRAM ||
            dataset.kind() == v1::DATASET_KIND_ENVIRONMENT_MAP || dataset.kind() == v1::DATASET_KIND_MESH) {
            continue;
        }
        ids += (ids.empty() ? "" : ", ") + dataset.id();
        only = dataset.id();
        ++count;
    }
    if (count == 1) return only;
    refuse(ids.empty() ? "the server has no dataset to show" : "--dataset is needed; the server has " + ids);
}

/// What a default camera has to show: the first isosurface's volume seen along the plane's normal, or else the glyphs, or else
/// a tractogram along that normal.
v1::FitCameraRequest cameraWish(const v1::Scene& scene, v1::Plane plane) {
    v1::FitCameraRequest fit;
    fit.mutable_selection()->mutable_slice()->set_plane(plane == v1::PLANE_OBLIQUE ? v1::PLANE_AXIAL : plane);
    for (const v1::Layer& layer : scene.layers()) {
        if (!layer.has_isosurface()) continue;
        fit.set_dataset_id(layer.isosurface().dataset_id());
        return fit;
    }
    for (v1::Layer layer : scene.layers()) {
        if (layer.has_tractogram()) {
            if (fit.dataset_id().empty()) fit.set_dataset_id(layer.tractogram().dataset_id());
            continue;
        }
        const v1::GlyphLayer& glyphs = glyphsOf(layer);
        fit.set_dataset_id(glyphs.dataset_id());
        *fit.mutable_selection() = glyphs.selection();
    }
    return fit;
}

}  // namespace

void addRequestOptions(CLI::App& app, RequestOptions& options, bool with_camera) {
    app.add_option("--dataset", options.dataset, "Catalogue id; may be left out if the server has one dataset only");
    addWords(app, "--plane", options.plane, v1::Plane_descriptor(), "Plane of the shown slice (default axial)");
    addVector(app, "--position", options.position_mm, "Point on the plane, world mm (default: the dataset's centre)");
    addVector(app, "--normal", options.normal, "Normal of an oblique plane, world axes");
    app.add_option("--slab", options.slab_mm, "Show all voxels within a slab of this thickness about the plane, mm");
    app.add_flag("--volume", options.volume, "Show the whole masked volume instead of a slice");
    addWords(app, "--scale", options.scale, v1::GlyphScale::Mode_descriptor(), "Glyph radii relative to what (default global)");
    app.add_option("--factor", options.factor, "Factor on the radii (default 1)");
    app.add_option("--lmax", options.lmax, "Highest band drawn (default: all)");
    addWords(app, "--lobes", options.lobes, v1::NegativeLobes_descriptor(), "Negative lobes (default hidden)");
    app.add_option("--colour", options.colour, "What colours the glyphs (default direction)")
        ->check(CLI::IsMember({"direction", "radius", "scalar", "uniform"}));
    addWords(app, "--colour-map", options.colour_map, v1::ColourMap_descriptor(),
             "Colour map of --colour radius and scalar (default viridis)");
    app.add_option("--colour-range", options.colour_range,
                   "Ends of the map: radii in mm (default 0 to the typical one), or values (default those of the whole image)")
        ->delimiter(',')
        ->expected(2)
        ->type_name("LOW,HIGH");
    app.add_option("--colour-image", options.colour_image, "Catalogue id of the scalar volume of --colour scalar");
    addVector(app, "--uniform-colour", options.uniform_colour, "Colour of --colour uniform, linear RGB 0 to 1 (default grey)")
        ->type_name("R,G,B");
    addTensorOptions(app, options.tensors);
    addFibreOptions(app, options.fibres);
    addIsosurfaceOptions(app, options.isosurfaces);
    app.add_option("--opacity", options.opacity, "Opacity of the glyphs, above 0, up to 1: what is behind shines through");
    addUncertaintyOptions(app, options.uncertainty);
    app.add_option("--isotropic", options.isotropic_part,
                   "Constant added to each glyph's function, in typical amplitudes, 0 to 10 (default 0)");
    app.add_option("--size", options.size, "Picture size in pixels")->type_name("WxH")->capture_default_str();
    addWords(app, "--convention", options.convention, v1::Annotations::Convention_descriptor(),
             "How default cameras look at the head (default radiological)");
    app.add_flag("--no-annotations", options.no_annotations, "Leave marks and texts out of the picture");
    app.add_option("--samples", options.samples, "Samples per pixel (default 16)");
    addWords(app, "--method,--intersection", options.intersection, v1::IntersectionMethod_descriptor(),
             "How rays meet glyphs (default march)");
    addWords(app, "--polynomial-stop", options.polynomial_stop, v1::PolynomialSettings::Stop_descriptor(),
             "When a root of the polynomial is done (default bracket; step: as in the paper)");
    app.add_option("--tolerance", options.tolerance,
                   "Tolerance of the polynomial methods, 1e-15 to 0.1 (default: by the rule)");
    app.add_option("--march-steps", options.march_steps, "Pieces of a ray of the ray-march methods (default 100)");
    app.add_option("--refinements", options.refinements,
                   "Steps that narrow a hit down: bisections (default 10) or regula falsi (default 4)");
    addWords(app, "--glyph-boxes", options.glyph_boxes, v1::GlyphBoxes_descriptor(), "Boxes around glyphs (default tight)");
    addWords(app, "--traversal", options.traversal, v1::Traversal_descriptor(), "Way to the boxes (default auto)", "auto");
    addWords(app, "--pole-table", options.pole_table, v1::PoleTable_descriptor(), "Pole-frame table (default auto)", "auto");
    addWords(app, "--sun-table", options.sun_table, v1::PoleTable_descriptor(), "The same for hard shadows (default auto)",
             "auto");
    addWords(app, "--mesh", options.mesh, v1::SphereMesh_descriptor(), "Sphere of tessellated glyphs (default icosphere)");
    app.add_option("--mesh-level", options.mesh_level, "Subdivisions of that sphere, or bands of a grid (default 4, grids 20)");
    addWords(app, "--mesh-normals", options.mesh_normals, v1::MeshNormals_descriptor(),
             "Normals of tessellated glyphs (default analytic)");
    app.add_flag("--fxaa", options.fxaa, "Smooth the edges of pictures of one sample");
    app.add_option("--jpeg-quality", options.jpeg_quality, "Quality of JPEG pictures, 1 to 100 (default 90)");
    addLightOptions(app, options.light);
    app.add_flag("--casts-no-shadows", options.no_casting, "The glyphs stand in nobody's light");
    addVector(app, "--background", options.background, "Background, linear RGB 0 to 1")->type_name("R,G,B");
    if (with_camera) {
        app.add_option("--camera", options.camera, "Camera: a JSON file or JSON text (default: one that fits the selection)")
            ->type_name("FILE|JSON");
    }
}

v1::FrameRequest makeRequest(const RequestOptions& options) {
    v1::FrameRequest request;
    setSize(request, options.size);
    v1::Scene& scene = *request.mutable_scene();
    addFibres(scene, options.fibres);
    // A tractogram or an isosurface may stand alone.
    const bool alone = options.fibres.datasets.empty() && options.isosurfaces.layers.empty();
    if (alone || !options.dataset.empty()) {
        addGlyphs(scene, options);
    } else if (!options.uncertainty.glyphs.empty() || !options.uncertainty.deviations.empty()) {
        refuse("--uncertainty and --deviations are about glyphs, and the picture shows none; --dataset ID names their image");
    }
    setIsosurfaces(request, options.isosurfaces);
    setLight(*scene.mutable_light(), options.light);
    setShading(scene, options.light);
    if (!options.background.empty()) setVector(*scene.mutable_background(), options.background);
    scene.mutable_annotations()->set_convention(options.convention);
    scene.mutable_annotations()->set_hidden(options.no_annotations);
    setQuality(*request.mutable_quality(), options);
    if (!options.camera.empty()) *request.mutable_camera() = cameraFromOption(options.camera);
    return request;
}

void completeRequest(v1::FrameRequest& request, const Connection& connection, v1::Plane plane) {
    const auto stub = v1::CatalogService::NewStub(connection.channel());
    for (v1::Layer& layer : *request.mutable_scene()->mutable_layers()) {
        if (layer.has_tractogram() || layer.has_isosurface()) continue;
        v1::GlyphLayer& glyphs = glyphsOf(layer);
        if (glyphs.dataset_id().empty()) glyphs.set_dataset_id(onlyDataset(*stub, connection));
    }
    if (request.has_camera()) return;
    v1::FitCameraRequest fit = cameraWish(request.scene(), plane);
    fit.set_convention(request.scene().annotations().convention());
    // Kept within what FitCamera takes, so that an impossible size is refused where the picture is asked for, as a size.
    fit.set_aspect(std::clamp(static_cast<double>(request.width()) / std::max(request.height(), 1U), 0.05, 20.0));
    grpc::ClientContext context;
    connection.prepare(context);
    v1::FitCameraResponse response;
    connection.check(stub->FitCamera(&context, fit, &response));
    *request.mutable_camera() = response.camera();
}

}  // namespace radiata::client
