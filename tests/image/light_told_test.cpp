// What pictures tell of their global light: paths of all their samples, texels that ran out of samples, and that no layer takes
// it.
#include "build/folded_ball.h"
#include "image/fixture.h"

namespace radiata::test {
namespace {

class LightTold : public ImageTest {
protected:
    LightTold() { store.add("volume", foldedBall(24)); }

    static model::FrameRequest request() {
        model::FrameRequest request;
        request.width = 48;
        request.height = 40;
        request.quality.samples = 2;
        request.scene.layers.emplace_back().content =
            model::IsosurfaceLayer{.dataset_id = "volume", .isovalue = 30.0F, .colour = glm::vec3(0.7F)};
        request.scene.light.illumination.emplace().samples_max = 16;
        request.camera.eye_mm = {40, -70, 30};
        request.camera.up = {0, 0, 1};
        request.camera.perspective = false;
        request.camera.height_mm = 24;
        return request;
    }
};

/// Path after path is counted for the picture that it is followed for, and texels that ran out of samples are told apart.
TEST_F(LightTold, CountsPathsOfAllSamplesOfAPicture) {
    model::FrameRequest wanted = request();
    wanted.scene.light.illumination->relative_error = 0.001F;
    wanted.scene.light.illumination->samples_max = 16;
    render::Target target;
    model::IlluminationInfo before;
    for (int samples = 0; samples < 2;) {
        const model::Frame frame = renderer.render(target, wanted, samples, 1);
        const model::IlluminationInfo& info = *frame.info.illumination;
        EXPECT_GE(info.samples, before.samples);
        EXPECT_GE(info.seconds, before.seconds);
        before = info;
        samples = frame.info.samples;
    }
    EXPECT_GE(before.samples, 16 * before.texels_needed / 2);
    EXPECT_EQ(before.texels_done, before.texels_needed);
    EXPECT_GT(before.texels_out_of_samples, before.texels_needed / 2);
    EXPECT_LE(before.texels_out_of_samples, before.texels_done);
    EXPECT_EQ(renderer.renderAll(wanted).info.illumination->samples, 0u) << "they are there for the next picture";
}

TEST_F(LightTold, IsToldToBeLeftOutWhereNoLayerTakesIt) {
    model::FrameRequest wanted = request();
    EXPECT_TRUE(renderer.renderAll(wanted).info.left_out.empty());
    const std::vector<model::LeftOut> nothing{{.global_light = true}};
    wanted.scene.layers[0].opacity = 0.5F;
    EXPECT_EQ(renderer.renderAll(wanted).info.left_out, nothing);
    wanted.scene.layers[0].opacity = 1;
    wanted.scene.layers[0].surface().shading = model::SurfaceShading::kPhong;
    const model::Frame phong = renderer.renderAll(wanted);
    EXPECT_EQ(phong.info.left_out, nothing);
    EXPECT_FALSE(phong.info.illumination);
    wanted.scene.layers.push_back(request().scene.layers[0]);
    EXPECT_TRUE(renderer.renderAll(wanted).info.left_out.empty()) << "another layer takes it";
}

}  // namespace
}  // namespace radiata::test
