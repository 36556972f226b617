// Volumes for isosurfaces behind gRPC: bad ones are refused in one sentence while other views go on, and what is slow about
// good ones is done beside the render thread.
#include <filesystem>
#include <fstream>
#include <limits>

#include <unistd.h>

#include <gmock/gmock.h>

#include "build/fiblet_encode.h"
#include "build/folded_ball.h"
#include "gpu/device.h"
#include "io/nifti_write.h"
#include "service/service_fixture.h"
#include "session/vulkan_backend.h"
#include "store/surface_triangles.h"
#include "store/volume_dataset.h"
#include "support/random_fibres.h"

namespace radiata::service::testing {
namespace {

using ::testing::HasSubstr;

class Volumes : public ::testing::Test {
protected:
    Volumes() { std::filesystem::create_directories(folder); }
    ~Volumes() override { std::filesystem::remove_all(folder); }

    std::filesystem::path write(const std::string& name, const model::ScalarImage& image) const {
        io::Volume volume;
        volume.size = {image.size.x, image.size.y, image.size.z, 1};
        volume.voxel_to_world = image.voxel_to_world;
        volume.data = image.values;
        io::writeNifti(volume, folder / name);
        return folder / name;
    }
    static model::ScalarImage even(const glm::ivec3& size, float value) {
        model::ScalarImage image;
        image.size = size;
        image.values.assign(static_cast<std::size_t>(size.x * size.y * size.z), value);
        return image;
    }
    static model::FrameRequest surfaceOf(const std::string& id) {
        model::FrameRequest request;
        request.width = 24;
        request.height = 16;
        request.quality.samples = 1;
        model::IsosurfaceLayer layer;
        layer.dataset_id = id;
        request.scene.layers.emplace_back().content = layer;
        request.camera.eye_mm = {60, -80, 40};
        return request;
    }

    std::filesystem::path folder = std::filesystem::temp_directory_path() / ("radiata-volumes-" + std::to_string(::getpid()));
    gpu::Device device{gpu::DeviceOptions{}};
    store::Store store{device, {}};
    render::Renderer renderer{device, store};
};

TEST_F(Volumes, BadOnesAreRefusedInWordsWhileAnotherViewGoesOn) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    store.add("ball", foldedBall(16));
    store.add(write("voxel.nii", even(glm::ivec3(1), 1)));
    store.add(write("slice.nii", even({8, 8, 1}, 1)));
    store.add(write("nothing.nii", even(glm::ivec3(4), kNan)));
    store.add(write("even.nii", even(glm::ivec3(4), 3)));
    write("cut.nii", even(glm::ivec3(8), 1));
    std::filesystem::resize_file(folder / "cut.nii", 1000);
    store.add(folder / "cut.nii");
    std::ofstream(folder / "climbs.nhdr") << "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 4 4\nendian: little\n"
                                             "encoding: raw\ndata file: ../../etc/passwd\n";
    store.add(folder / "climbs.nhdr");
    std::ofstream(folder / "sky.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n\x02\x02";
    store.add(folder / "sky.hdr");

    Rig rig(session::vulkanBackend(renderer, store));
    const auto channel = rig.channel();
    v1::FrameRequest good = frameRequest();
    good.mutable_scene()->mutable_layers(0)->mutable_isosurface()->set_dataset_id("ball");
    good.mutable_quality()->set_samples(1);
    Viewer viewer(channel, good);
    ASSERT_TRUE(viewer.waitFor([](const v1::Frame&) { return true; }));
    struct Case {
        std::string id;
        std::optional<float> isovalue;
        grpc::StatusCode code;
        std::string words;
        bool sky = false;
    };
    const Case cases[] = {
        {"ball", 1e6F, grpc::StatusCode::INVALID_ARGUMENT, "isovalue is 1e+06; 'ball' has values from "},
        {"ball", kNan, grpc::StatusCode::INVALID_ARGUMENT, "isovalue is nan; it must be a finite value"},
        {"voxel", 1, grpc::StatusCode::INVALID_ARGUMENT, "1 x 1 x 1 voxels; an isosurface needs at least 2 along each axis"},
        {"slice", 1, grpc::StatusCode::INVALID_ARGUMENT, "8 x 8 x 1 voxels"},
        {"nothing", {}, grpc::StatusCode::INVALID_ARGUMENT, "none of the 64 voxels is a finite number"},
        {"even", 1, grpc::StatusCode::INVALID_ARGUMENT, "'even' has the value 3 everywhere"},
        {"even", 3, grpc::StatusCode::INVALID_ARGUMENT, "'even' has the value 3 everywhere"},
        {"cut", {}, grpc::StatusCode::DATA_LOSS, "the file has 1000"},
        {"climbs", {}, grpc::StatusCode::INVALID_ARGUMENT, "is not inside the header's folder"},
        {"ball", {}, grpc::StatusCode::DATA_LOSS, "it ends before its last pixel", true},
        {"../ball", {}, grpc::StatusCode::NOT_FOUND, "there is no dataset"},
    };
    std::uint64_t sequence = 0;
    for (const Case& bad : cases) {
        v1::FrameRequest request = good;
        v1::IsosurfaceLayer& layer = *request.mutable_scene()->mutable_layers(0)->mutable_isosurface();
        layer.set_dataset_id(bad.id);
        if (bad.isovalue) layer.set_isovalue(*bad.isovalue);
        if (bad.sky) {
            request.mutable_scene()->mutable_light()->mutable_illumination()->mutable_environment()->set_id("sky");
        }
        grpc::ClientContext context;
        context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
        v1::RenderRequest wanted;
        *wanted.mutable_frame() = request;
        v1::RenderResponse none;
        const grpc::Status status = v1::RenderService::NewStub(channel)->Render(&context, wanted, &none);
        EXPECT_EQ(status.error_code(), bad.code) << bad.id << ": " << status.error_message();
        EXPECT_THAT(status.error_message(), HasSubstr(bad.words));
        Viewer ended(channel, request);
        EXPECT_EQ(ended.end().error_code(), bad.code) << bad.id;
        ++sequence;
        ASSERT_TRUE(viewer.move(sequence, 0.01 * static_cast<double>(sequence)).ok());
        EXPECT_TRUE(viewer.waitFor([&](const v1::Frame& frame) { return frame.camera_sequence() == sequence; })) << bad.id;
    }
    grpc::ClientContext context;
    v1::GetDatasetRequest request;
    request.set_id("nothing");
    v1::GetDatasetResponse info;
    ASSERT_TRUE(v1::CatalogService::NewStub(channel)->GetDataset(&context, request, &info).ok());
    EXPECT_EQ(info.dataset().rejected_voxels(), 64U) << "voxels that are no number are counted";
}

TEST_F(Volumes, AllThatAPictureNeedsIsBroughtBesideTheRenderThread) {
    store.add(write("ball.nii", foldedBall(16)));
    store.add(write("colours.nii", foldedBall(8)));
    store.add(write("mask.nii", even(glm::ivec3(4), 1)));
    store.add(write("region.nii", even(glm::ivec3(4), 1)));
    std::ofstream(folder / "tissue.obj") << "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    store.add(folder / "tissue.obj");
    const test::Fibres fibres = test::randomFibres(1, 20, 20, 1.0, 0.2);
    store.add("tracts", encodeFiblets(fibres.points, fibres.offsets, {}));
    const session::Backend backend = session::vulkanBackend(renderer, store);

    model::FrameRequest surface = surfaceOf("ball");
    EXPECT_FALSE(backend.resident(surface));
    EXPECT_GT(store.info("ball").size.x, 0) << "samples alone";
    EXPECT_FALSE(backend.resident(surface)) << "no bricks yet";
    backend.load(surface);
    EXPECT_TRUE(backend.resident(surface));
    model::VolumeColour colours;
    colours.image_id = "colours";
    surface.scene.layers[0].surface().colour_by = colours;
    EXPECT_FALSE(backend.resident(surface));
    backend.load(surface);
    EXPECT_TRUE(backend.resident(surface));
    surface.quality.isosurface.method = model::SurfaceMethod::kMarchingCubes;
    EXPECT_FALSE(backend.resident(surface)) << "no triangles yet";
    backend.load(surface);
    EXPECT_TRUE(backend.resident(surface));
    const auto made = store.triangles("ball", {});
    EXPECT_FALSE(made->pieces.empty());
    renderer.renderAll(surface);
    EXPECT_EQ(store.triangles("ball", {}), made) << "the picture is of those that were brought";
    surface.scene.layers[0].surface().isovalue = store.volume("ball")->valueSplit() * 1.01F;
    EXPECT_FALSE(backend.resident(surface)) << "another isovalue has other triangles";

    model::FrameRequest tracts;
    model::TractogramLayer layer;
    layer.dataset_id = "tracts";
    layer.shown.selection = "any mask(mask) or not length(0, 5)";
    layer.region_cuts.push_back({.region = "mesh(tissue)"});
    layer.colour.mode = model::FibreColourMode::kDistance;
    layer.colour.region = "mask(region)";
    tracts.scene.layers.emplace_back().content = layer;
    EXPECT_FALSE(backend.resident(tracts));
    backend.load(tracts);
    for (const char* id : {"mask", "tissue", "region"}) EXPECT_TRUE(store.resident(id)) << id;
    EXPECT_TRUE(backend.resident(tracts));
    EXPECT_FALSE(backend.made(tracts));
    backend.make(tracts);
    EXPECT_TRUE(backend.made(tracts));
    layer.line_width_px = 2;
    tracts.scene.layers[0].content = layer;
    EXPECT_TRUE(backend.made(tracts)) << "a line's width changes nothing about which fibres there are";
    layer.shown.selection = "any sphere(0, 0, 0, 5)";
    tracts.scene.layers[0].content = layer;
    EXPECT_TRUE(backend.resident(tracts));
    EXPECT_FALSE(backend.made(tracts)) << "fibres are decoded for another region";
    backend.make(tracts);
    EXPECT_TRUE(backend.made(tracts));
    layer.shown.selection = "column(nothing, 0, 1)";
    tracts.scene.layers[0].content = layer;
    EXPECT_THROW(backend.make(tracts), Error);
    layer.region_cuts[0].region = "mesh(nobody)";
    tracts.scene.layers[0].content = layer;
    EXPECT_THROW(backend.resident(tracts), Error);
}

TEST_F(Volumes, SavedLatticesAreReadBesideTheRenderThread) {
    const std::filesystem::path file = write("ball.nii", foldedBall(16));
    store.add(file);
    model::FrameRequest lit = surfaceOf("ball");
    lit.scene.layers[0].surface().isovalue = 30.0F;
    model::Illumination& light = lit.scene.light.illumination.emplace();
    light.full = true;
    light.samples_max = 4;
    light.project = false;
    const model::Frame first = renderer.renderAll(lit);
    ASSERT_THAT(first.info.illumination->saved, ::testing::EndsWith(".lattice"));

    store::Store next_store(device, {});
    next_store.add(file);
    render::Renderer next(device, next_store);
    const session::Backend backend = session::vulkanBackend(next, next_store);
    EXPECT_EQ(next_store.volume("ball")->valueMin(), store.volume("ball")->valueMin());
    EXPECT_FALSE(backend.resident(lit)) << "its texels are not read";
    backend.load(lit);
    EXPECT_TRUE(backend.resident(lit));
    std::filesystem::resize_file(folder / first.info.illumination->saved, 100);
    const model::Frame again = next.renderAll(lit);
    EXPECT_EQ(again.info.illumination->texels_read, 16u * 16 * 16) << "what was read is what is shown";
    EXPECT_EQ(again.pixels.rgba, first.pixels.rgba);
    EXPECT_TRUE(backend.resident(lit)) << "they are on the device";
    light.sky.radiance = glm::vec3(0.3F);
    EXPECT_TRUE(backend.resident(lit)) << "of this light nothing was saved";
}

}  // namespace
}  // namespace radiata::service::testing
