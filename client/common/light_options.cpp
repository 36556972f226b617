#include "common/light_options.h"

#include "common/client_error.h"

namespace radiata::client {
namespace {

/// Of --shading lambert-fog, at the far end.
constexpr float kFog = 0.9F;

[[noreturn]] void refuse(const std::string& message) { throw ClientError(ExitCode::kUsage, message); }

void setVector(v1::Vec3& vector, const std::vector<double>& values) {
    vector.set_x(values[0]);
    vector.set_y(values[1]);
    vector.set_z(values[2]);
}

void addVector(CLI::App& app, const std::string& name, std::vector<double>& values, const std::string& what) {
    app.add_option(name, values, what)->delimiter(',')->expected(3)->type_name("X,Y,Z");
}

}  // namespace

void addLightOptions(CLI::App& app, LightOptions& options) {
    addVector(app, "--light", options.direction_camera, "Direction towards the light: right, up, towards the viewer");
    addVector(app, "--light-world", options.direction_world, "Direction towards the light in world axes, in place of --light");
    app.add_option("--irradiance", options.irradiance, "Irradiance of the light, linear (pi lights white to 1)");
    app.add_option("--ambient", options.ambient, "Radiance of the constant ambient light, linear");
    app.add_option("--shadow", options.shadow, "Shadows among all glyphs (default none)")
        ->check(CLI::IsMember({"none", "hard", "soft"}));
    app.add_option("--light-radius", options.angular_radius_deg,
                   "Half the angle under which the light of soft shadows is seen, degrees (default 5)");
    app.add_option("--shadow-rays", options.shadow_rays, "Rays towards the light of soft shadows, per sample (default 16)");
    app.add_option(
           "--shading", options.shading,
           "How isosurfaces are lit, those of Wyman et al.'s Fig. 9: lambert, lambert-fog and phong by local light, vicinity "
           "as --vicinity, full as --global-light irradiance (default scene)")
        ->check(CLI::IsMember({"scene", "lambert", "lambert-fog", "phong", "vicinity", "full"}));
    addIlluminationOptions(app, options.illumination);
    app.add_option("--ambient-occlusion", options.occlusion_rays, "Weaken the ambient light by so many rays per sample")
        ->type_name("RAYS");
    app.add_option("--occlusion-radius", options.occlusion_radius_mm,
                   "How far away a glyph still takes ambient light, mm (default: two voxel edges)");
}

void setLight(v1::Light& light, const LightOptions& options) {
    const bool soft = options.shadow == "soft";
    if (!options.direction_camera.empty() && !options.direction_world.empty()) {
        refuse("--light and --light-world exclude each other");
    }
    if (options.angular_radius_deg && !soft) refuse("--light-radius goes with --shadow soft only");
    if (options.shadow_rays && !soft) refuse("--shadow-rays goes with --shadow soft only");
    if (options.occlusion_radius_mm && !options.occlusion_rays) refuse("--occlusion-radius goes with --ambient-occlusion only");
    if (!options.direction_camera.empty()) setVector(*light.mutable_direction_camera(), options.direction_camera);
    if (!options.direction_world.empty()) setVector(*light.mutable_direction_world(), options.direction_world);
    IlluminationOptions illumination = options.illumination;
    const bool local = options.shading.starts_with("lambert") || options.shading == "phong";
    if (local && (illumination.vicinity || !illumination.payload.empty())) {
        refuse("--shading " + options.shading + " is local light, so no surface would take " +
               (illumination.vicinity ? "--vicinity" : "--global-light") + "; leave one of them out");
    }
    if (options.shading == "full" && illumination.vicinity) {
        refuse("--shading full and --vicinity are two kinds of light; leave one of them out");
    }
    if (options.shading == "vicinity") illumination.vicinity = true;
    if (options.shading == "full" && illumination.payload.empty()) illumination.payload = "irradiance";
    setIllumination(light, illumination);
    if (options.irradiance) light.set_irradiance(*options.irradiance);
    if (options.ambient) light.set_ambient(*options.ambient);
    if (options.shadow == "none") light.set_shadow(v1::SHADOW_NONE);
    if (options.shadow == "hard") light.set_shadow(v1::SHADOW_HARD);
    if (soft) light.set_shadow(v1::SHADOW_SOFT);
    if (options.angular_radius_deg) light.set_angular_radius_deg(*options.angular_radius_deg);
    if (options.shadow_rays) light.set_shadow_rays(*options.shadow_rays);
    if (options.occlusion_rays) light.mutable_ambient_occlusion()->set_rays(*options.occlusion_rays);
    if (options.occlusion_radius_mm) light.mutable_ambient_occlusion()->set_radius_mm(*options.occlusion_radius_mm);
}

void setShading(v1::Scene& scene, const LightOptions& options) {
    const bool lambert = options.shading.starts_with("lambert"), fog = options.shading == "lambert-fog";
    if (!lambert && options.shading != "phong") return;
    for (v1::Layer& layer : *scene.mutable_layers()) {
        if (!layer.has_isosurface()) continue;
        v1::IsosurfaceLayer& surface = *layer.mutable_isosurface();
        if (surface.shading() == v1::SURFACE_SHADING_UNSPECIFIED) {
            surface.set_shading(lambert ? v1::SURFACE_SHADING_LAMBERT : v1::SURFACE_SHADING_PHONG);
        }
        if (fog && !surface.has_fog()) surface.set_fog(kFog);
    }
}

}  // namespace radiata::client
