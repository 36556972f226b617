// Real images, in the folder that RADIATA_DATA names: one crop in several encodings gives one picture; a whole slice is drawn
// alike by every traversal. Without the folder the same holds for the phantom and its copies in other storage orders.
#include <cstdio>

#include "image/fixture.h"
#include "io/sh_image.h"
#include "store/glyph_dataset.h"

namespace radiata::test {
namespace {

class RealData : public ImageTest {
protected:
    /// Pictures of two datasets from the same places. Their affines may differ by the decimals of a header, which moves colours
    /// that lie on the border of two steps.
    void holdEqual(const std::string& a, const std::string& b) {
        for (const glm::dvec3& towards : {glm::dvec3(0, 0, -1), glm::dvec3(1, -2, 1)}) {
            model::FrameRequest request = requestOf(a, 200, 150, 1);
            request.scene.layers[0].glyphs().scale = {};
            request.camera = cameraAround(store.glyphs(a)->image(), towards, towards.x > 0);
            const model::Frame first = draw(request);
            request.scene.layers[0].glyphs().dataset_id = b;
            const model::Frame second = draw(request);
            int other = 0, worst = 0, silhouettes = 0;
            for (std::size_t at = 0; at < first.pixels.rgba.size(); ++at) {
                const int step = std::abs(first.pixels.rgba[at] - second.pixels.rgba[at]);
                worst = std::max(worst, step);
                other += step > 0;
                silhouettes += at % 4 == 0 && (first.pixels.id[at] < 0) != (second.pixels.id[at] < 0);
            }
            std::printf("%s and %s: %llu hits, %d colour channels differ, by at most %d; %d at silhouettes\n", a.c_str(),
                        b.c_str(), static_cast<unsigned long long>(first.info.hit_pixels), other, worst, silhouettes);
            EXPECT_GT(first.info.hit_pixels, 1000U);
            EXPECT_EQ(silhouettes, 0);
            EXPECT_LE(worst, 1);
            EXPECT_LE(other, 10);
        }
    }

    /// Equal ids and depths by every traversal and with the table, on an axial slice as people first see it.
    void holdSlice(const std::string& id, std::uint64_t glyphs, std::uint64_t hits) {
        model::FrameRequest request = requestOf(id, 320, 240, 1);
        request.scene.layers[0].glyphs().scale = {};
        request.scene.layers[0].glyphs().selection.region = model::Region::kSlice;
        request.camera =
            renderer.fitCamera(id, request.scene.layers[0].glyphs().selection, model::Convention::kRadiological, 4.0 / 3);
        model::Frame first;
        for (const model::Traversal traversal :
             {model::Traversal::kTiles, model::Traversal::kBvh, model::Traversal::kRayQuery}) {
            for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
                request.quality.traversal = traversal;
                request.quality.pole_table = table;
                const model::Frame frame = draw(request);
                if (first.pixels.id.empty()) first = frame;
                const Agreement agreement = compareSurfaces(first, frame);
                std::printf("%s: %llu glyphs, %d hits, %d other ids, depth %.2g mm\n", id.c_str(),
                            static_cast<unsigned long long>(frame.info.glyphs), agreement.hits, agreement.other_ids,
                            agreement.worst_depth);
                EXPECT_GE(frame.info.glyphs, glyphs);
                EXPECT_GT(frame.info.hit_pixels, hits);
                EXPECT_EQ(agreement.other_ids, 0);
                EXPECT_LE(agreement.worst_depth, 2e-5);  // of glyphs about 1 mm in radius
                EXPECT_EQ(frame.info.capped_rays, 0U);
            }
        }
    }
};

TEST_F(RealData, InSeveralEncodingsIsOnePicture) {
    const model::ShImage image = phantomImage(14, 4);
    store.add("plain", image);
    store.add("reversed", reversedStorage(image));
    holdEqual("plain", "reversed");
    const auto folder = dataFolder();
    if (!folder) return;
    store.add("xa20", io::readShImage(*folder / "sh" / "xa20_fod4.nii.gz"));
    for (const std::string name : {"xa20_fod4_LPS.nii.gz", "xa20_fod4_n2.nii", "xa20_fod4_f64be.mif", "xa20_fod4.mih"}) {
        const std::string id =
            "other-" + std::filesystem::path(name).extension().string().substr(1) + std::to_string(name.size());
        store.add(id, io::readShImage(*folder / "sh" / name));
        holdEqual("xa20", id);
    }
}

TEST_F(RealData, OfAWholeSliceIsDrawnAlikeByEveryTraversal) {
    store.add("brain", phantomImage(40, 8));
    holdSlice("brain", 200, 1000);
    const auto folder = dataFolder();
    if (!folder) return;
    store.add("xa140", io::readShImage(*folder / "sh" / "xa140_fod8.nii.gz"));
    holdSlice("xa140", 7000, 3500);
}

}  // namespace
}  // namespace radiata::test
