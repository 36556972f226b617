#include "common/uncertainty_options.h"

#include "common/client_error.h"

namespace radiata::client {

void addUncertaintyOptions(CLI::App& app, UncertaintyOptions& options) {
    app.add_option("--uncertainty", options.glyphs, "Show uncertainty: catalogue id of an image of second, outer glyphs")
        ->type_name("ID");
    app.add_option("--deviations", options.deviations,
                   "Show uncertainty: catalogue id of an image of standard deviations of the coefficients")
        ->type_name("ID");
    app.add_option("--deviation-count", options.deviation_count,
                   "How many standard deviations the outer surface is away, above 0, up to 100 (default 1)");
    app.add_option("--extinction", options.extinction_per_mm,
                   "Extinction inside of the outer glyphs per mm, above 0, up to 1e6");
    app.add_option("--emission", options.emission, "Emission inside of the outer glyphs, linear RGB 0 to 1 (default: grey)")
        ->delimiter(',')
        ->expected(3)
        ->type_name("R,G,B");
}

void setUncertainty(v1::GlyphLayer& glyphs, const UncertaintyOptions& options) {
    const auto refuse = [](const std::string& sentence) { throw ClientError(ExitCode::kUsage, sentence); };
    if (!options.glyphs.empty() && !options.deviations.empty()) {
        refuse("--uncertainty and --deviations exclude each other; both name the image that says how uncertain glyphs are");
    }
    if (options.glyphs.empty() && options.deviations.empty()) {
        if (options.extinction_per_mm || !options.emission.empty()) {
            refuse("--extinction and --emission go with --uncertainty or --deviations only");
        }
        if (options.deviation_count) refuse("--deviation-count goes with --deviations only");
        return;
    }
    v1::Uncertainty& uncertainty = *glyphs.mutable_uncertainty();
    if (options.glyphs.empty()) {
        uncertainty.set_dataset_id(options.deviations);
        uncertainty.set_kind(v1::Uncertainty::KIND_DEVIATIONS);
        if (options.deviation_count) uncertainty.set_deviations(*options.deviation_count);
    } else {
        if (options.deviation_count) refuse("--deviation-count goes with --deviations only");
        uncertainty.set_dataset_id(options.glyphs);
        uncertainty.set_kind(v1::Uncertainty::KIND_GLYPHS);
    }
    if (options.extinction_per_mm) uncertainty.set_extinction_per_mm(*options.extinction_per_mm);
    if (!options.emission.empty()) {
        v1::Vec3& emission = *uncertainty.mutable_emission();
        emission.set_x(options.emission[0]);
        emission.set_y(options.emission[1]);
        emission.set_z(options.emission[2]);
    }
}

}  // namespace radiata::client
