// Tractograms beyond the memory budget: pages of a file by request of the cull pass, a subset of fibres in place of what is not
// there, and pictures that come to be those of the whole in every pixel.
#include <cmath>
#include <filesystem>

#include <unistd.h>

#include "build/fiblet_subset.h"
#include "image/fibre_scenes.h"
#include "image/fixture.h"
#include "io/fiblet_file.h"
#include "render/fiblet/fiblet_residency.h"

namespace radiata::test {
namespace {

constexpr std::size_t kBundles = 80, kFibresEach = 30;

glm::dvec3 bundleCentre(std::size_t bundle) { return {30.0 * static_cast<double>(bundle), 3, -8}; }

/// Bundles side by side, of which a view may show a few, so that what it shows fits a tenth of them all.
const model::FibletSet& bundles() {
    static const model::FibletSet set = [] {
        std::mt19937 random(11);
        Fibres made;
        for (std::size_t f = 0; f < kBundles * kFibresEach; ++f) {
            std::vector<glm::vec3> fibre = randomFibre(random, 2 + random() % 400, 0.1, 0.2, 6);
            for (glm::vec3& point : fibre) point += glm::vec3(bundleCentre(f / kFibresEach));
            made.add(fibre);
        }
        return encodeFiblets(made.points, made.offsets, {});
    }();
    return set;
}

model::Limits tenth() {
    model::Limits limits;
    limits.tract_memory_bytes = render::FibletResidency::wholeBytes(bundles()) / 10;
    return limits;
}

class FibreStreaming : public ImageTest {
protected:
    FibreStreaming() {
        std::filesystem::create_directories(folder);
        io::writeFiblets(bundles(), folder / "fibres.fiblet");
        store.add("fibres", bundles());
        paged_store.add(folder / "fibres.fiblet");
    }
    ~FibreStreaming() override { std::filesystem::remove_all(folder); }

    static model::FrameRequest looking(std::size_t bundle, double height_mm, bool perspective, int samples = 1) {
        model::FrameRequest request = fibreRequest("fibres", 160, 120, samples);
        request.camera.perspective = perspective;
        request.camera.target_mm = bundleCentre(bundle);
        request.camera.eye_mm = bundleCentre(bundle) + glm::dvec3(0, -60, 20);
        request.camera.height_mm = height_mm;
        request.camera.field_of_view_deg = 2 * 57.29578 * std::atan(0.5 * height_mm / 63.2);
        return request;
    }
    /// All bundles side by side.
    static model::FrameRequest wide() {
        model::FrameRequest request = looking(kBundles / 2, 256, false);
        request.width = 640;
        request.height = 64;
        return request;
    }
    model::Frame drawPaged(const model::FrameRequest& request) { return paged.renderAll(request, everything()); }
    void expectSame(const model::FrameRequest& request) {
        const model::Frame all = draw(request), some = drawPaged(request);
        EXPECT_GT(some.info.fiblet_pages_wanted, 0U);
        EXPECT_EQ(some.info.fiblet_pages_resident, some.info.fiblet_pages_wanted);
        EXPECT_EQ(some.info.state, model::FrameState::kConverged);
        EXPECT_TRUE(some.info.left_out.empty());
        EXPECT_GT(some.info.hit_pixels, 200U);
        EXPECT_EQ(some.pixels.id, all.pixels.id);
        EXPECT_EQ(some.pixels.depth, all.pixels.depth);
        EXPECT_EQ(some.pixels.rgba, all.pixels.rgba);
    }
    /// Shows nothing that is not there, and nothing through what is.
    static void expectPart(const model::Frame& part, const model::Frame& all) {
        for (std::size_t at = 0; at < all.pixels.depth.size(); ++at) EXPECT_GE(part.pixels.depth[at], all.pixels.depth[at]);
    }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("radiata-streaming-" + std::to_string(::getpid()));
    store::Store paged_store{device, {}};
    render::Renderer paged{device, paged_store, tenth()};
};

/// With a tenth of the bytes; every pixel, after any jump, and the device never has more than the budget.
TEST_F(FibreStreaming, PicturesOfWhatFitsAreThoseOfTheWhole) {
    for (const std::size_t bundle : {3, 30, 4}) {
        for (const bool perspective : {false, true}) expectSame(looking(bundle, 18, perspective, 2));
    }
    const model::DatasetInfo info = paged_store.info("fibres");
    EXPECT_LE(info.gpu_bytes, tenth().tract_memory_bytes);
    EXPECT_GT(info.gpu_bytes, tenth().tract_memory_bytes / 2);
    EXPECT_LT(info.resident_pages, info.fiblet_pages);
    const model::Frame again = drawPaged(looking(4, 18, true, 2));
    EXPECT_EQ(again.info.fiblet_bytes_read, 0U) << "what is there is not read again";
}

/// The first picture waits for nothing and shows the subset at least; later ones come to be that of the whole.
TEST_F(FibreStreaming, ViewsRefineUntilTheyAreThatOfTheWhole) {
    // A bundle with a fibre of the subset, which a larger budget only adds to.
    const std::size_t bundle = fibletSubset(bundles(), 2000).heads.at(0).fibre / kFibresEach;
    const model::FrameRequest request = looking(bundle, 18, true, 4);
    const model::Frame all = draw(request);
    render::Target target;
    model::Frame frame = paged.render(target, request, 0, 1);
    EXPECT_EQ(frame.info.state, model::FrameState::kInteractive);
    EXPECT_GT(frame.info.hit_pixels, 0U) << "never empty";
    EXPECT_LE(frame.info.hit_pixels, all.info.hit_pixels);
    int steps = 0;
    while (frame.info.state != model::FrameState::kConverged && ++steps < 1000) {
        frame = paged.render(target, request, frame.info.samples, 1);
        EXPECT_EQ(frame.info.state, frame.info.samples < 4 ? model::FrameState::kRefining : model::FrameState::kConverged);
    }
    EXPECT_EQ(frame.info.hit_pixels, all.info.hit_pixels);
    EXPECT_EQ(frame.pixels.rgba, all.pixels.rgba);
}

/// Nearest pages in full, of the others the subset: the frame says so, shows bundles all over, and does not depend on what was
/// drawn before.
TEST_F(FibreStreaming, PicturesOfTooMuchSayWhatIsLeftOutAndAreRepeatable) {
    const model::Frame all = draw(wide()), some = drawPaged(wide());
    EXPECT_EQ(some.info.state, model::FrameState::kConverged);
    EXPECT_GT(some.info.fiblet_pages_left_out, 0U);
    EXPECT_EQ(some.info.fiblet_pages_resident + some.info.fiblet_pages_left_out, some.info.fiblet_pages_wanted);
    EXPECT_EQ(some.info.left_out, (std::vector<model::LeftOut>{{.fiblet_pages = some.info.fiblet_pages_wanted,
                                                                .fiblet_pages_left_out = some.info.fiblet_pages_left_out}}));
    EXPECT_LT(some.info.hit_pixels, all.info.hit_pixels);
    expectPart(some, all);
    std::vector<int> hits(kBundles);
    for (std::size_t at = 0; at < some.pixels.depth.size(); ++at) {
        if (some.pixels.id[4 * at] >= 0) ++hits[static_cast<std::size_t>(some.pixels.id[4 * at + 1]) / kFibresEach];
    }
    // Of the 30 fibres of a bundle less than one is in the subset on average.
    EXPECT_GE(std::ranges::count_if(hits, [](int count) { return count > 0; }), 30);
    drawPaged(looking(35, 18, false));
    const model::Frame again = drawPaged(wide());
    EXPECT_EQ(again.pixels.id, some.pixels.id);
    EXPECT_EQ(again.pixels.rgba, some.pixels.rgba);
    EXPECT_EQ(again.info.fiblet_pages_left_out, some.info.fiblet_pages_left_out);
}

/// Tubes of a selection, colours of fibres, cuts, transparency, groups of segments as lines, and two layers of one tractogram.
TEST_F(FibreStreaming, LooksAndSelectionsAreThoseOfTheWhole) {
    model::FrameRequest request = looking(12, 18, true);
    model::TractogramLayer& layer = request.scene.layers[0].tracts();
    layer.selected.emplace().length_min_mm = 10.0F;
    layer.tube_radius_mm = 0.2F;
    layer.colour.mode = model::FibreColourMode::kFibre;
    expectSame(request);
    layer.cuts.push_back({bundleCentre(12), {1, 0.2, 0}});
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].tracts().colour.mode = model::FibreColourMode::kLength;
    request.scene.layers[1].tracts().cuts[0].normal *= -1;
    expectSame(request);
    request = looking(12, 18, false);
    request.scene.layers[0].opacity = 0.5F;
    const model::Frame all = draw(request), some = drawPaged(request);
    EXPECT_EQ(some.pixels.rgba, all.pixels.rgba);
    EXPECT_EQ(some.info.fiblet_pages_left_out, 0U);
}

/// Of any place of a picture, also where it shows the subset: picks know the whole.
TEST_F(FibreStreaming, PicksAnswerFromTheWhole) {
    const model::FrameRequest request = wide();
    int fibres = 0;
    for (int x = 5; x < request.width; x += 30) {
        const auto all = renderer.pick(request, x, 30, 3), some = paged.pick(request, x, 30, 3);
        ASSERT_EQ(all.has_value(), some.has_value());
        if (!all) continue;
        ++fibres;
        const auto &a = std::get<model::PickedFibre>(*all), &b = std::get<model::PickedFibre>(*some);
        EXPECT_EQ(a.fibre, b.fibre);
        EXPECT_EQ(a.point, b.point);
        EXPECT_EQ(a.position_mm, b.position_mm);
    }
    EXPECT_GT(fibres, 10);
    const std::vector<glm::dvec2> outline = {{100, 10}, {500, 12}, {480, 50}, {90, 40}};
    for (const bool through : {false, true}) {
        const auto all = renderer.pickFibres(request, outline, through), some = paged.pickFibres(request, outline, through);
        EXPECT_GT(all[0].fibres.size(), 100U);
        EXPECT_EQ(some[0].fibres, all[0].fibres);
    }
}

/// What needs all at once is refused, so is a budget that holds nothing; a file that was cut off or changed is named.
TEST_F(FibreStreaming, RefusalsSayWhatIsWrong) {
    model::FrameRequest request = looking(20, 18, true);
    request.quality.fiblet_pipeline = model::FibletPipeline::kPoints;
    EXPECT_EQ(codeOf([&] { drawPaged(request); }), Code::kUnsupported);
    request.quality = {};
    request.quality.fiblet_culling = model::FibletCulling::kNone;
    EXPECT_EQ(codeOf([&] { drawPaged(request); }), Code::kUnsupported);
    model::Limits little;
    little.tract_memory_bytes = 10'000;
    render::Renderer poor(device, paged_store, little);
    EXPECT_EQ(codeOf([&] { poor.renderAll(looking(20, 18, true)); }), Code::kResourceExhausted);
    const std::filesystem::path file = folder / "fibres.fiblet";
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 8);
    EXPECT_EQ(codeOf([&] { drawPaged(looking(33, 18, true)); }), Code::kUnavailable);
}

/// A tractogram that fits has the pipelines and bytes that it has without a budget, and so has one beside it in its frames.
TEST_F(FibreStreaming, WhatFitsPaysNothing) {
    model::Limits enough;
    enough.tract_memory_bytes = render::FibletResidency::wholeBytes(bundles());
    const auto cost = [&](const model::Limits& limits) {
        const std::uint64_t before = device.allocatedBytes();
        render::Renderer own(device, store, limits);
        const model::Frame frame = own.renderAll(looking(9, 18, true));
        EXPECT_EQ(frame.info.fiblet_pages_wanted, 0U);
        return std::pair(own.pipelineCount(), device.allocatedBytes() - before);
    };
    EXPECT_EQ(cost(enough), cost({}));
    EXPECT_EQ(store.info("fibres").resident_pages, store.info("fibres").fiblet_pages);
}

}  // namespace
}  // namespace radiata::test
