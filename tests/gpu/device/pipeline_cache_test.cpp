// The pipeline cache's file: written whole, read back, and ignored when it is damaged or someone else's.
#include "gpu/pipeline_cache.h"

#include <unistd.h>

#include <cstring>
#include <fstream>

#include "gpu/device/fixture.h"
#include "gpu/device_impl.h"

namespace radiata::gpu {
namespace {

class PipelineCacheTest : public ::testing::Test {
protected:
    void SetUp() override { std::filesystem::remove_all(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    /// A device that uses the file builds a pipeline cleanly.
    void expectDeviceWorks() const {
        Device device(DeviceOptions{.validation = true, .pipeline_cache = file});
        EXPECT_TRUE(DeviceTest::squarePipeline(device, 32));
        EXPECT_TRUE(device.takeValidationMessages().empty());
    }

    std::string bytes() const {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    void write(const std::string& text) const { std::ofstream(file, std::ios::binary | std::ios::trunc) << text; }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("radiata_pipeline_cache_" + std::to_string(::getpid()));
    const std::filesystem::path file = folder / "nested" / "pipelines.bin";
};

TEST_F(PipelineCacheTest, IsWrittenOnDestructionAndReadBack) {
    expectDeviceWorks();
    const Device device(DeviceOptions{});
    EXPECT_FALSE(readPipelineCache(file, device.impl().properties).empty());
    expectDeviceWorks();
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1) << "no temporary file is left";
}

TEST_F(PipelineCacheTest, DamagedFilesAreIgnoredAndReplaced) {
    expectDeviceWorks();
    const Device device(DeviceOptions{});
    const std::string good = bytes();
    ASSERT_GE(good.size(), 56U) << "our header and the driver's";
    std::string flipped = good;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    std::string boastful = good;
    std::memset(boastful.data() + 8, 0xff, 8);
    for (const std::string& bad : {std::string(), std::string("x"), good.substr(0, 20), good.substr(0, good.size() - 1),
                                   good + "tail", flipped, boastful, std::string(4096, '\0')}) {
        write(bad);
        EXPECT_TRUE(readPipelineCache(file, device.impl().properties).empty()) << bad.size() << " bytes";
        expectDeviceWorks();
        EXPECT_FALSE(readPipelineCache(file, device.impl().properties).empty());
    }
}

TEST_F(PipelineCacheTest, OfAnotherDriverIsIgnored) {
    expectDeviceWorks();
    vk::PhysicalDeviceProperties other = Device(DeviceOptions{}).impl().properties;
    EXPECT_FALSE(readPipelineCache(file, other).empty());
    other.pipelineCacheUUID[5] = static_cast<std::uint8_t>(other.pipelineCacheUUID[5] + 1);
    EXPECT_TRUE(readPipelineCache(file, other).empty());
}

TEST_F(PipelineCacheTest, PlaceThatCannotBeWrittenIsAnErrorWhenAskedForAndHarmlessAtTheEnd) {
    std::filesystem::create_directories(file);  // a folder stands where the file should be
    Device device(DeviceOptions{.pipeline_cache = file});
    const Error error = errorOf([&] { device.savePipelineCache(); });
    EXPECT_EQ(error.code(), Code::kUnavailable);
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
}

}  // namespace
}  // namespace radiata::gpu
