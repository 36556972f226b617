// Every way to find the glyphs along a ray, with the pole-frame table and without, shows the same glyphs at the same depths.
#include <algorithm>
#include <cstdio>

#include "image/fixture.h"
#include "store/glyph_dataset.h"

namespace radiata::test {
namespace {

constexpr model::Traversal kTraversals[] = {model::Traversal::kTiles, model::Traversal::kBvh, model::Traversal::kRayQuery};
const char* const kNames[] = {"tiles", "bvh", "ray_query"};

class Traversals : public ImageTest {
protected:
    /// Largest radius of the glyphs of a dataset, as its boxes have it, in units of amplitude.
    double largestRadius(const std::string& id) {
        const auto dataset = store.glyphs(id);
        std::vector<std::uint32_t> slots(dataset->image().voxels.size());
        for (std::uint32_t i = 0; i < slots.size(); ++i) slots[i] = i;
        double largest = 0;
        for (const GlyphBounds& bounds : dataset->bounds(slots, dataset->image().layout.lmax, false)) {
            largest = std::max(largest, static_cast<double>(bounds.radius));
        }
        return largest;
    }

    /// Traversals give the same floats for the same ray, so nothing may differ between them. The table rounds differently: it
    /// may move a hit by 2e-5 radii, across the surface where it is seen at a grazing angle. Ids are equal in every pixel.
    void holdAgreement(model::FrameRequest request, double radius_mm) {
        ASSERT_EQ(renderer.traversals(), (std::vector<std::string>{"ray_query", "bvh", "tiles", "raster_boxes"}));
        model::Frame first;
        for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
            model::Frame of_table;
            for (std::size_t i = 0; i < 3; ++i) {
                request.quality.pole_table = table;
                request.quality.traversal = kTraversals[i];
                const model::Frame frame = draw(request);
                EXPECT_EQ(frame.info.pole_table_used, table == model::PoleTable::kOn);
                EXPECT_EQ(frame.info.capped_rays, 0U);
                if (i == 0) of_table = frame;
                if (first.pixels.id.empty()) first = frame;
                const Agreement among = compareSurfaces(of_table, frame);
                const Agreement all = compareSurfaces(first, frame);
                std::printf("%9s, table %s: %d hits; against tiles %d other ids, depth %.2g radii; against no table %d, %.2g\n",
                            kNames[i], frame.info.pole_table_used ? "on " : "off", all.hits, among.other_ids,
                            among.worst_depth / radius_mm, all.other_ids, all.worst_depth / radius_mm);
                EXPECT_GT(all.hits, 800);
                EXPECT_EQ(among.other_ids, 0);
                EXPECT_LE(among.worst_depth, 1e-6 * radius_mm);
                EXPECT_EQ(frame.pixels.rgba, of_table.pixels.rgba) << "the pictures of the traversals are equal";
                EXPECT_EQ(all.other_ids, 0);
                EXPECT_LE(all.worst_depth, 2e-5 * radius_mm);
                EXPECT_LE(all.worst_apart, 2e-5 * radius_mm);
            }
        }
    }
};

TEST_F(Traversals, AgreeOnAnAxialSlice) {
    const model::ShImage image = phantomImage(24, 8);
    store.add("brain", image);
    model::FrameRequest request = requestOf("brain", 200, 150, 1);
    model::VoxelSelection& selection = request.scene.layers[0].glyphs().selection;
    selection.region = model::Region::kSlice;
    const double voxel = glm::length(glm::dvec3(image.voxel_to_world[0]));
    const float mm = static_cast<float>(0.5 * voxel / store.info("brain").amplitude_typical);
    request.scene.layers[0].glyphs().scale.factor = mm;
    request.camera = renderer.fitCamera("brain", selection, model::Convention::kRadiological, 4.0 / 3);
    holdAgreement(request, largestRadius("brain") * mm);
}

TEST_F(Traversals, AgreeOnAWholeVolumeInPerspective) {
    const model::ShImage image = phantomImage(20, 6);
    store.add("brain", image);
    const double voxel = glm::length(glm::dvec3(image.voxel_to_world[0]));
    const float mm = static_cast<float>(0.5 * voxel / store.info("brain").amplitude_typical);
    model::FrameRequest request = requestOf("brain", 160, 120, mm);
    request.camera = cameraAround(image, {2, -3, 1.5}, true);
    holdAgreement(request, largestRadius("brain") * mm);
}

TEST_F(Traversals, AgreeOnAWholeVolumeSeenInParallel) {
    const model::ShImage image = phantomImage(20, 6);
    store.add("brain", image);
    const double voxel = glm::length(glm::dvec3(image.voxel_to_world[0]));
    const float mm = static_cast<float>(0.5 * voxel / store.info("brain").amplitude_typical);
    model::FrameRequest request = requestOf("brain", 160, 120, mm);
    request.camera = cameraAround(image, {0, 0, -1}, false);
    holdAgreement(request, largestRadius("brain") * mm);
}

/// The second method with its safe stopping rule against the march: float32 roots of a polynomial of degree 4 and 8.
TEST_F(Traversals, AgreeWhenTheyIntersectByPolynomial) {
    for (const int lmax : {4, 8}) {
        const std::string id = "field" + std::to_string(lmax);
        const model::ShImage image = randomField({lmax, false}, {4, 3, 3}, 4, obliqueAffine());
        store.add(id, image);
        model::FrameRequest request = requestOf(id, 160, 120, 2);
        request.camera = cameraAround(image, {1, 2, 2}, true);
        const model::Frame march = draw(request);
        request.quality.intersection = model::Intersection::kPolynomial;
        model::Frame first;
        for (const model::Traversal traversal : kTraversals) {
            request.quality.traversal = traversal;
            const model::Frame frame = draw(request);
            if (first.pixels.id.empty()) first = frame;
            EXPECT_EQ(frame.pixels.rgba, first.pixels.rgba);
            const Agreement agreement = compareSurfaces(march, frame);
            std::printf("lmax %d: %d hits, %d other ids, depth %.2g radii, %.2g along the normal\n", lmax, agreement.hits,
                        agreement.other_ids, agreement.worst_depth / largestRadius(id) / 2,
                        agreement.worst_apart / largestRadius(id) / 2);
            EXPECT_LE(agreement.other_ids, 2);
            EXPECT_LE(agreement.worst_apart, 2e-5 * largestRadius(id) * 2);
        }
    }
}

TEST_F(Traversals, AgreeOnFullBandsBetweenClipPlanes) {
    const model::ShImage image = randomField({7, true}, {5, 4, 3}, 3, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {-1, 2, 1}, true);
    const double distance = glm::length(request.camera.target_mm - request.camera.eye_mm);
    request.camera.clip = model::Clip{distance - 0.7, distance + 1.5};
    holdAgreement(request, largestRadius("field") * 2);
}

}  // namespace
}  // namespace radiata::test
