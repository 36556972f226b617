#include "tools/lab/measure.h"

#include <algorithm>

#include "tools/lab/experiment.h"

namespace radiata::lab {

double passTime(const model::FrameInfo& info, const std::vector<std::string>& beginnings) {
    double total = 0;
    for (const model::PassTime& pass : info.passes) {
        const bool counts = std::any_of(beginnings.begin(), beginnings.end(),
                                        [&pass](const std::string& beginning) { return pass.name.starts_with(beginning); });
        if (beginnings.empty() || counts) total += pass.time_ms;
    }
    return total;
}

std::vector<Measured> measure(render::Renderer& renderer, const std::vector<Candidate>& candidates, int repeats,
                              const std::vector<std::string>& passes) {
    std::vector<Measured> results(candidates.size());
    std::vector<render::Target> targets(candidates.size());
    std::vector<std::function<void()>> measurements;
    bool warm = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        results[i].name = candidates[i].name;
        results[i].family = candidates[i].family;
        results[i].time = {candidates[i].name, "ms", {}};
        results[i].frame_time = {candidates[i].name + ", all passes", "ms", {}};
        measurements.push_back([&, i] {
            model::Outputs outputs;
            outputs.depth = outputs.normal = !warm;
            model::Frame frame = renderer.render(targets[i], candidates[i].request, 0, 1, outputs);
            results[i].info = frame.info;
            if (!warm) {
                results[i].depth = std::move(frame.pixels.depth);
                results[i].normal = std::move(frame.pixels.normal);
                return;
            }
            results[i].time.values.push_back(passTime(frame.info, passes));
            results[i].frame_time.values.push_back(passTime(frame.info, {}));
        });
    }
    interleave(1, measurements);
    warm = true;
    interleave(repeats, measurements);
    return results;
}

}  // namespace radiata::lab
