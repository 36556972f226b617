#include "common/isosurface_options.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <string_view>

#include "common/client_error.h"
#include "common/enum_words.h"

namespace radiata::client {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw ClientError(ExitCode::kUsage, "--isosurface " + message); }

std::vector<std::string_view> parts(std::string_view text, char separator) {
    std::vector<std::string_view> result;
    while (true) {
        const std::size_t end = text.find(separator);
        result.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return result;
        text.remove_prefix(end + 1);
    }
}

double number(std::string_view text, const std::string& whole) {
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size()) {
        refuse("'" + whole + "': '" + std::string(text) + "' is not a number");
    }
    return value;
}

void setColour(v1::Vec3& colour, std::string_view text, const std::string& whole) {
    const auto channels = parts(text, '/');
    if (channels.size() != 3)
        refuse("'" + whole + "': colour is '" + std::string(text) + "'; it must be R/G/B, linear, 0 to 1");
    colour.set_x(number(channels[0], whole));
    colour.set_y(number(channels[1], whole));
    colour.set_z(number(channels[2], whole));
}

/// "ID[/MAP[/LOW/HIGH]]"
void setColourBy(v1::VolumeColour& colour, std::string_view text, const std::string& whole) {
    const auto words = parts(text, '/');
    static const auto maps = enumWords<v1::ColourMap>(v1::ColourMap_descriptor());
    const auto map = words.size() > 1 ? maps.find(std::string(words[1])) : maps.end();
    if (words[0].empty() || (words.size() != 1 && words.size() != 2 && words.size() != 4) ||
        (words.size() > 1 && map == maps.end())) {
        refuse("'" + whole + "': colour-by is '" + std::string(text) +
               "'; it must be ID[/MAP[/LOW/HIGH]] with a map such as viridis");
    }
    colour.set_image_id(std::string(words[0]));
    if (words.size() > 1) colour.set_map(map->second);
    if (words.size() < 4) return;
    colour.mutable_range()->set_low(static_cast<float>(number(words[2], whole)));
    colour.mutable_range()->set_high(static_cast<float>(number(words[3], whole)));
}

void setLayer(v1::Layer& layer, const std::string& whole) {
    const auto words = parts(whole, ',');
    v1::IsosurfaceLayer& surface = *layer.mutable_isosurface();
    const std::size_t colon = words[0].find(':');
    surface.set_dataset_id(std::string(words[0].substr(0, colon)));
    if (surface.dataset_id().empty()) refuse("'" + whole + "': the catalogue id is missing");
    if (colon != std::string_view::npos) surface.set_isovalue(static_cast<float>(number(words[0].substr(colon + 1), whole)));
    std::vector<std::string_view> given;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string_view word = words[i], name = word.substr(0, word.find('='));
        if (std::ranges::find(given, name) != given.end()) {
            refuse("'" + whole + "': " + std::string(name) + " is given twice; a layer takes it once");
        }
        given.push_back(name);
        if (word.starts_with("opacity=")) {
            layer.set_opacity(static_cast<float>(number(word.substr(8), whole)));
        } else if (word.starts_with("colour=")) {
            setColour(*surface.mutable_colour(), word.substr(7), whole);
        } else if (word.starts_with("colour-by=")) {
            setColourBy(*surface.mutable_colour_by(), word.substr(10), whole);
        } else if (word.starts_with("fog=")) {
            surface.set_fog(static_cast<float>(number(word.substr(4), whole)));
        } else if (word == "shading=lambert" || word == "shading=phong") {
            surface.set_shading(word.ends_with("phong") ? v1::SURFACE_SHADING_PHONG : v1::SURFACE_SHADING_LAMBERT);
        } else if (word == "no-shadows") {
            layer.set_casts_shadows(false);
        } else {
            refuse("'" + whole + "': '" + std::string(word) +
                   "' is none of opacity=A, colour=R/G/B, colour-by=ID[/MAP[/LOW/HIGH]], shading=lambert, shading=phong, fog=F "
                   "and no-shadows");
        }
    }
}

}  // namespace

void addIsosurfaceOptions(CLI::App& app, IsosurfaceOptions& options) {
    app.add_option(
           "--isosurface", options.layers,
           "A layer with the surface of a scalar volume: its catalogue id, the value (default: what splits the volume best "
           "in two), opacity, colour, another volume that colours it, its shading, and the share of fog at its far end; may be "
           "given several times. Without --dataset only surfaces are shown")
        ->type_name(
            "ID[:VALUE][,opacity=A][,colour=R/G/B][,colour-by=ID[/MAP[/LOW/"
            "HIGH]]][,shading=lambert|phong][,fog=F][,no-shadows]")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    v1::IsosurfaceSettings& settings = options.settings;
    const std::map<std::string, v1::SurfaceMethod> methods{{"exact", v1::SURFACE_METHOD_EXACT},
                                                           {"march-bisect", v1::SURFACE_METHOD_MARCH_BISECT},
                                                           {"marching-cubes", v1::SURFACE_METHOD_MARCHING_CUBES}};
    app.add_option_function<std::string>(
           "--surface-method", [&settings, methods](const std::string& word) { settings.set_method(methods.at(word)); },
           "How isosurfaces are found (default exact; march-bisect and marching-cubes are there to compare with)")
        ->check(CLI::IsMember({"exact", "march-bisect", "marching-cubes"}));
    app.add_option_function<float>(
        "--surface-step", [&settings](float value) { settings.set_step(value); },
        "Step of march-bisect in voxel edges, 0.05 to 4 (default 0.5)");
    app.add_option_function<std::uint32_t>(
        "--surface-bisections", [&settings](std::uint32_t value) { settings.set_bisections(value); },
        "Bisections of march-bisect, 0 to 32 (default 10)");
    const std::map<std::string, v1::SurfaceNormals> normals{{"spline", v1::SURFACE_NORMALS_SPLINE},
                                                            {"trilinear", v1::SURFACE_NORMALS_TRILINEAR}};
    app.add_option_function<std::string>(
           "--surface-normals", [&settings, normals](const std::string& word) { settings.set_normals(normals.at(word)); },
           "Normals of isosurfaces: of a smoothing spline over 4x4x4 samples, or of the trilinear cell (default spline)")
        ->check(CLI::IsMember({"spline", "trilinear"}));
    app.add_option_function<bool>(
        "--surface-bricks", [&settings](bool value) { settings.set_bricks(value); },
        "Whether bricks without the surface are left out (default true)");
}

void setIsosurfaces(v1::FrameRequest& request, const IsosurfaceOptions& options) {
    for (const std::string& layer : options.layers) setLayer(*request.mutable_scene()->add_layers(), layer);
    if (options.settings.ByteSizeLong() > 0) *request.mutable_quality()->mutable_isosurface() = options.settings;
}

}  // namespace radiata::client
