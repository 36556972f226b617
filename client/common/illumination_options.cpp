#include "common/illumination_options.h"

#include <cstdio>
#include <map>

#include "common/client_error.h"

namespace radiata::client {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw ClientError(ExitCode::kUsage, message); }

v1::Vec3 vectorOf(const std::vector<double>& values, std::size_t first = 0) {
    v1::Vec3 vector;
    vector.set_x(values[first]);
    vector.set_y(values[first + 1]);
    vector.set_z(values[first + 2]);
    return vector;
}

void addVector(CLI::App& app, const std::string& name, std::vector<double>& values, const std::string& what, const char* type) {
    app.add_option(name, values, what)->delimiter(',')->expected(3)->type_name(type);
}

/// Each use of the option is one list of seven numbers.
void addLists(CLI::App& app, const std::string& name, std::vector<std::vector<double>>& lists, const std::string& what,
              const char* type) {
    app.add_option_function<std::vector<std::string>>(
           name,
           [&lists, name](const std::vector<std::string>& words) {
               for (const std::string& word : words) {
                   std::vector<double> values;
                   for (const std::string& number : CLI::detail::split(word, ',')) {
                       double value = 0;
                       if (!CLI::detail::lexical_cast(number, value))
                           throw CLI::ValidationError(name, "'" + number + "' is no number");
                       values.push_back(value);
                   }
                   if (values.size() != 7) throw CLI::ValidationError(name, "'" + word + "' has not seven numbers");
                   lists.push_back(values);
               }
           },
           what)
        ->type_name(type)
        ->expected(1, 16);
}

template <typename Word>
Word wordOf(const std::map<std::string, Word>& words, const std::string& word) {
    return words.at(word);
}

void setTexels(v1::Illumination& light, const IlluminationOptions& options) {
    if (options.method == "path-tracing") light.set_method(v1::ILLUMINATION_METHOD_PATH_TRACING);
    light.set_payload(options.payload == "transfer" ? v1::TEXEL_PAYLOAD_TRANSFER : v1::TEXEL_PAYLOAD_IRRADIANCE);
    if (options.storage == "float32") light.set_storage(v1::TEXEL_STORAGE_FLOAT32);
    if (options.storage == "rgb8") light.set_storage(v1::TEXEL_STORAGE_RGB8);
    if (options.random_paths) light.set_sampling(v1::TEXEL_SAMPLING_RANDOM);
    light.set_full(options.full);
    if (!options.interpolation.empty()) {
        light.set_interpolation(wordOf<v1::TexelInterpolation>({{"own-isovalue", v1::TEXEL_INTERPOLATION_OWN_ISOVALUE},
                                                                {"nearest", v1::TEXEL_INTERPOLATION_NEAREST},
                                                                {"trilinear", v1::TEXEL_INTERPOLATION_TRILINEAR},
                                                                {"tricubic", v1::TEXEL_INTERPOLATION_TRICUBIC}},
                                                               options.interpolation));
    }
    if (!options.resolution.empty()) {
        light.set_resolution(wordOf<v1::LatticeResolution>(
            {{"1/8", v1::LATTICE_RESOLUTION_EIGHTH}, {"1", v1::LATTICE_RESOLUTION_ONE}, {"8", v1::LATTICE_RESOLUTION_EIGHT}},
            options.resolution));
    }
    if (options.bounces) light.set_bounces(*options.bounces);
    for (const std::uint32_t order : options.orders) light.add_orders(order);
    if (options.on_own_level_sets) light.set_project(false);
    if (options.relative_error) light.set_relative_error(*options.relative_error);
    if (options.samples_max) light.set_samples_max(*options.samples_max);
    if (options.budget_mib) light.set_budget_mib(*options.budget_mib);
}

}  // namespace

void addIlluminationOptions(CLI::App& app, IlluminationOptions& options) {
    app.add_option("--global-light", options.payload,
                   "Light opaque isosurfaces with shadows and bounces: texels keep the irradiance of this light, or the "
                   "transfer of any")
        ->check(CLI::IsMember({"irradiance", "transfer"}));
    app.add_option(
           "--light-method", options.method,
           "How global light is found: texels beside the volume, or paths from each pixel, to compare with (default lattice)")
        ->check(CLI::IsMember({"lattice", "path-tracing"}));
    app.add_flag("--vicinity", options.vicinity, "Vicinity shading: global light of no bounces under a constant sky of 1");
    addVector(app, "--sky", options.sky, "Radiance of the sky, linear RGB (default 0.8 each)", "R,G,B");
    addVector(app, "--sky-gradient", options.sky_gradient, "Added to it, times the cosine with its upward direction", "R,G,B");
    addVector(app, "--sky-up", options.sky_up, "That direction, world axes (default 0,0,1)", "X,Y,Z");
    app.add_option("--environment", options.environment, "Environment map in place of the sky, by its name in the catalogue")
        ->type_name("ID");
    app.add_option("--environment-scale", options.environment_scale, "Times the map's radiance (default 1)");
    addLists(app, "--sun", options.suns,
             "A distant disc: direction towards it, angular radius in degrees, irradiance; may be repeated", "X,Y,Z,DEG,R,G,B");
    addLists(app, "--lamp", options.lamps,
             "A light in the scene: position in mm, radius in mm (0: a point), intensity in mm^2; may be repeated",
             "X,Y,Z,MM,R,G,B");
    app.add_option("--turn-light", options.rotation, "Turns sky, environment and suns: quaternion")
        ->delimiter(',')
        ->expected(4)
        ->type_name("W,X,Y,Z");
    app.add_option("--bounces", options.bounces, "How often light bounces, 0 to 4 (default 3)");
    app.add_option("--transfer-orders", options.orders, "Orders of spherical harmonics by bounce, 1 to 5 (default 5,3,2,2,2)")
        ->delimiter(',')
        ->expected(1, 5);
    app.add_option("--texel-storage", options.storage, "How texels are kept (default float16)")
        ->check(CLI::IsMember({"float16", "float32", "rgb8"}));
    app.add_option("--texel-interpolation", options.interpolation, "Which texels light a point (default trilinear)")
        ->check(CLI::IsMember({"own-isovalue", "nearest", "trilinear", "tricubic"}));
    app.add_option("--texels-per-voxel", options.resolution, "Resolution of the lattice (default 1)")
        ->check(CLI::IsMember({"1/8", "1", "8"}));
    app.add_flag("--own-level-sets", options.on_own_level_sets,
                 "Texels are lit on their own level sets at rest too, as in the paper, and not on the shown surface");
    app.add_flag("--full", options.full,
                 "All texels of the volume, not only those that the picture needs, with progress; the server saves them beside "
                 "the dataset for its next start");
    app.add_flag("--random-paths", options.random_paths,
                 "Independent random paths in place of low-discrepancy ones, for comparison");
    app.add_option("--light-error", options.relative_error, "Relative standard error at which a texel is done (default 0.02)");
    app.add_option("--light-samples", options.samples_max, "Samples per texel at most, a power of two (default 1024)");
    app.add_option("--light-budget", options.budget_mib, "Device memory for texels, MiB (default 1024)");
}

void setIllumination(v1::Light& light, const IlluminationOptions& options) {
    if (options.payload.empty() && !options.vicinity) {
        if (!options.method.empty()) refuse("--light-method goes with --global-light or --vicinity");
        if (!options.suns.empty() || !options.lamps.empty() || !options.sky.empty() || !options.sky_gradient.empty() ||
            !options.environment.empty() || options.full) {
            refuse("--sky, --environment, --sun, --lamp and --full go with --global-light irradiance or transfer");
        }
        return;
    }
    v1::Illumination& global = *light.mutable_illumination();
    setTexels(global, options);
    if (!options.sky.empty()) *global.mutable_sky()->mutable_radiance() = vectorOf(options.sky);
    if (!options.sky_gradient.empty()) *global.mutable_sky()->mutable_gradient() = vectorOf(options.sky_gradient);
    if (!options.sky_up.empty()) *global.mutable_sky()->mutable_up() = vectorOf(options.sky_up);
    if (!options.environment.empty()) {
        if (!options.sky.empty() || !options.sky_gradient.empty())
            refuse("--environment takes the place of --sky; give one of them");
        global.mutable_environment()->set_id(options.environment);
        if (options.environment_scale) global.mutable_environment()->set_scale(*options.environment_scale);
    } else if (options.environment_scale) {
        refuse("--environment-scale goes with --environment");
    }
    for (const std::vector<double>& values : options.suns) {
        v1::SunDisc* sun = global.add_suns();
        *sun->mutable_direction() = vectorOf(values);
        sun->set_angular_radius_deg(static_cast<float>(values[3]));
        *sun->mutable_irradiance() = vectorOf(values, 4);
    }
    for (const std::vector<double>& values : options.lamps) {
        v1::SphereLight* lamp = global.add_lights();
        *lamp->mutable_position_mm() = vectorOf(values);
        lamp->set_radius_mm(static_cast<float>(values[3]));
        *lamp->mutable_intensity() = vectorOf(values, 4);
    }
    for (const double number : options.rotation) global.add_rotation(number);
    if (!options.vicinity) return;
    if (!options.suns.empty() || !options.lamps.empty() || !options.sky.empty() || !options.sky_gradient.empty() ||
        !options.environment.empty() || options.bounces) {
        refuse("--vicinity is a constant sky of 1 and no bounces; it takes no other light");
    }
    global.set_bounces(0);
    *global.mutable_sky()->mutable_radiance() = vectorOf({1, 1, 1});
}

std::string describe(const v1::IlluminationProgress& progress, const v1::Illumination& light) {
    const bool traced = light.method() == v1::ILLUMINATION_METHOD_PATH_TRACING;
    const auto count = [](std::uint64_t number) { return std::to_string(number); };
    std::string line = "global light: " + count(progress.texels_done()) + " of " + count(progress.texels_needed()) +
                       (traced ? " lit pixels done (picture of " : " texels done (lattice of ") + count(progress.texels()) +
                       ")";
    if (progress.texels_out_of_samples() > 0) {
        line += ", " + count(progress.texels_out_of_samples()) +
                " of them by the most samples they may have, not known to be as exact as asked for";
    }
    char text[128];
    std::snprintf(text, sizeof text, ", standard error %.2g %% (95th percentile %.2g %%), %.2f s", 100 * progress.mean_error(),
                  100 * progress.p95_error(), progress.seconds());
    line += text;
    if (progress.bricks_left_out() > 0) {
        line += "; the budget had no room for " + std::to_string(progress.bricks_left_out()) + " bricks of texels, lit locally";
    }
    if (progress.texels_read() > 0) line += "; read from a saved lattice";
    if (!progress.saved().empty()) line += "; saved lattice: " + progress.saved();
    return line;
}

}  // namespace radiata::client
