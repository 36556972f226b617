// Light that pictures share: texels of one brick that two views need one after the other, and views' texels in a whole lattice.
#include "build/folded_ball.h"
#include "image/fixture.h"

namespace radiata::test {
namespace {

class TexelRows : public ImageTest {
protected:
    static model::FrameRequest request(const glm::dvec3& eye_mm) {
        model::FrameRequest request;
        request.width = 64;
        request.height = 48;
        request.quality.samples = 1;
        request.scene.layers.emplace_back().content =
            model::IsosurfaceLayer{.dataset_id = "volume", .isovalue = 30.0F, .colour = glm::vec3(0.7F)};
        model::Illumination& light = request.scene.light.illumination.emplace();
        light.payload = model::TexelPayload::kTransfer;
        light.project = false;
        light.bounces = 1;
        light.samples_max = 16;
        request.camera.eye_mm = eye_mm;
        request.camera.up = {0, 0, 1};
        request.camera.perspective = false;
        request.camera.height_mm = 16;
        return request;
    }
    const glm::dvec3 here_{40, -70, 30}, beside_{55, -60, 25};
};

TEST_F(TexelRows, TexelsKeepTheirLightWhileMoreOfTheirBricksAreLit) {
    store.add("volume", foldedBall(16));
    const model::FrameRequest one = request(here_), other = request(beside_);
    const model::Frame first = renderer.renderAll(one), second = renderer.renderAll(other);
    EXPECT_GT(second.info.illumination->samples, 0u);
    EXPECT_LT(second.info.illumination->samples, 16 * second.info.illumination->texels_needed) << "some were there";
    const model::Frame again = renderer.renderAll(one);
    EXPECT_EQ(again.info.illumination->samples, 0u);
    EXPECT_EQ(again.pixels.rgba, first.pixels.rgba);
    render::Renderer fresh(device, store);
    EXPECT_EQ(fresh.renderAll(other).pixels.rgba, second.pixels.rgba) << "whoever lit the texels that both need";
    // Light for needed texels alone, in pools that are at most an eighth larger.
    const std::uint64_t row = 2 * 34, needed = first.info.illumination->texels_needed;
    const std::uint64_t kept = again.info.illumination->payload_bytes;
    EXPECT_GT(kept, row * needed);
    EXPECT_LE(kept, row * (needed + second.info.illumination->texels_needed) * 9 / 8);
}

TEST_F(TexelRows, WholeLatticesTakeOverWhatPicturesLit) {
    store.add("volume", foldedBall(16));
    model::FrameRequest lazy = request(here_), whole = lazy;
    whole.scene.light.illumination->full = true;
    const model::Frame picture = renderer.renderAll(lazy), after = renderer.renderAll(whole);
    const model::IlluminationInfo &before = *picture.info.illumination, &all = *after.info.illumination;
    EXPECT_EQ(all.texels_done, 4096u);
    EXPECT_EQ(after.pixels.rgba, picture.pixels.rgba);
    EXPECT_LE(all.samples, 16 * (4096 - before.texels_needed)) << "those of the others";
    // 64 bricks of 64 texels: bricks' numbers and slots, then all of each texel's, which says nowhere whose it is.
    EXPECT_EQ(all.bytes, 64 * (8 + 64 * (2 * 34 + 4 + 8)));
    render::Renderer fresh(device, store);
    const model::Frame at_once = fresh.renderAll(whole);
    EXPECT_EQ(at_once.pixels.rgba, picture.pixels.rgba);
    EXPECT_EQ(at_once.info.illumination->bytes, all.bytes);
}

}  // namespace
}  // namespace radiata::test
