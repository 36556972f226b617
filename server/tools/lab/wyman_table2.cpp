// wyman-table2: frames with ready texels beside frames without shadows and with shadow rays, and the memory of each.
// Source: Wyman et al. 2006, Table 2.
#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"

namespace radiata::lab {

Report wymanTable2(gpu::Device& device, const Options& options) {
    ReadyFrames bench(device, options, "wyman-table2", "folded ball of 96^3 voxels, texels ready");
    Report& report = bench.report;
    const model::FrameRequest lit = bench.lit(1, 32), plain = ReadyFrames::local(lit);
    model::FrameRequest transfer = lit;
    ReadyFrames::lightOf(transfer).payload = model::TexelPayload::kTransfer;
    ReadyFrames::lightOf(transfer).orders = {5, 5, 5, 5, 5};
    model::FrameRequest own = lit;
    ReadyFrames::lightOf(own).project = false;
    const std::vector<Measured> measured = bench.measureAll({{"no shadows", "local", plain},
                                                             {"hard shadows", "local", ReadyFrames::shadowed(plain)},
                                                             {"irradiance", "texels", own},
                                                             {"irradiance on the shown surface", "texels", lit},
                                                             {"transfer of order 5", "texels", transfer}});
    Table table{"frames with ready texels", {"shading", "ms", "of no shadows", "texels needed", "MiB of texels"}, {}};
    const double base = measured[0].time.median();
    for (const Measured& method : measured) {
        const auto& light = method.info.illumination;
        table.rows.push_back({method.name, shortNumber(method.time.median()), shortNumber(method.time.median() / base),
                              light ? std::to_string(light->texels_needed) : "-",
                              light ? shortNumber(static_cast<double>(light->bytes) / 1048576) : "0"});
    }
    report.tables.push_back(table);
    report.checks.push_back({"irradiance / no shadows", measured[2].time.median() / base, "<=", 1.15});
    report.checks.push_back({"irradiance / hard shadows", measured[2].time.median() / measured[1].time.median(), "<=", 1});
    report.checks.push_back({"transfer of order 5 / no shadows", measured[4].time.median() / base, "<=", 1.2});
    report.notes.push_back(
        "times are those of all passes on the device; the paper has 1.09 and 1.45 of no shadows for irradiance "
        "and transfer, and 1.9 for shadow rays");
    return std::move(report);
}

}  // namespace radiata::lab
