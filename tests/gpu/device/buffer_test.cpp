// Buffers: beyond the 128 MiB of a storage range, at their limits, and their accounts.
#include "gpu/buffer.h"

#include <array>
#include <cstring>
#include <utility>

#include "gpu/device/fixture.h"
#include "gpu/device_impl.h"
#include "gpu/recorder.h"

namespace radiata::gpu {
namespace {

using BufferTest = DeviceTest;

TEST_F(BufferTest, ShadersReachBothEndsOfABufferBeyondTheStorageRange) {
    const std::uint64_t size = (160ULL << 20) + 4 * sizeof(float);
    const Buffer buffer(device, size, Memory::kDevice, "large");
    const ComputePipeline square = squarePipeline(device, 4);
    CommandRecorder recorder(device);
    const std::array<float, 4> first{1, 2, 3, 4};
    const std::array<float, 4> last{5, 6, 7, 8};
    const std::uint64_t tail = size - sizeof last;
    upload(device, buffer, 0, std::as_bytes(std::span(first)));
    upload(device, buffer, tail, std::as_bytes(std::span(last)));
    for (const std::uint64_t offset : {std::uint64_t{0}, tail}) {
        recorder.dispatch(square, "square", 1, 1, 1, SquarePush{buffer.address() + offset, 4});
    }
    recorder.submitAndWait();
    std::array<float, 4> values{};
    download(device, buffer, 0, std::as_writable_bytes(std::span(values)));
    EXPECT_EQ(values, (std::array<float, 4>{1, 4, 9, 16}));
    download(device, buffer, tail, std::as_writable_bytes(std::span(values)));
    EXPECT_EQ(values, (std::array<float, 4>{25, 36, 49, 64}));
}

TEST_F(BufferTest, UploadsAndDownloadsOfSeveralPiecesKeepEveryByte) {
    std::vector<std::uint32_t> words((40ULL << 20) / 4 + 3);  // two full pieces of staging memory and a rest
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint32_t>(i * 2654435761U);
    const std::uint64_t offset = 20;
    const Buffer buffer(device, words.size() * 4 + 64, Memory::kDevice, "pieces");
    upload(device, buffer, offset, std::as_bytes(std::span(words)));
    std::vector<std::uint32_t> back(words.size());
    download(device, buffer, offset, std::as_writable_bytes(std::span(back)));
    EXPECT_TRUE(back == words);
}

TEST_F(BufferTest, RefusesWhatIsLargerThanTheDeviceAllows) {
    const std::uint64_t before = device.allocatedBytes();
    for (const std::uint64_t size : {std::uint64_t{1} << 62, ~std::uint64_t{0}, device.impl().allocation_size_max + 1}) {
        const Error error = errorOf([&] { Buffer(device, size, Memory::kDevice, "vast"); });
        EXPECT_EQ(error.code(), Code::kResourceExhausted) << size;
        EXPECT_NE(std::string(error.what()).find("'vast' needs "), std::string::npos) << error.what();
    }
    EXPECT_EQ(errorOf([&] { Buffer(device, 0, Memory::kDevice, "none"); }).code(), Code::kInternal);
    EXPECT_EQ(device.allocatedBytes(), before);
}

TEST_F(BufferTest, RefusesTheBufferThatWouldOverfillTheHeap) {
    // The account is filled, not the memory: what is refused must be refused before the driver is asked.
    auto& heap = device.impl().heap_bytes;
    for (auto& bytes : heap) bytes = device.info().memory_bytes + (1ULL << 50);
    const Error error = errorOf([&] { Buffer(device, 4096, Memory::kDevice, "one too many"); });
    EXPECT_EQ(error.code(), Code::kResourceExhausted);
    EXPECT_NE(std::string(error.what()).find("'one too many' needs 4096 bytes"), std::string::npos) << error.what();
    for (auto& bytes : heap) bytes = 0;
    EXPECT_TRUE(Buffer(device, 4096, Memory::kDevice, "fits again"));
}

TEST_F(BufferTest, AccountsForMovesAndDeath) {
    {
        Buffer first(device, 1000, Memory::kUpload, "first");
        const std::uint64_t one = device.allocatedBytes();
        EXPECT_GE(one, 1000U);
        const std::uint64_t address = first.address();
        Buffer second(std::move(first));
        EXPECT_FALSE(first);
        EXPECT_EQ(first.sizeBytes(), 0U);
        EXPECT_TRUE(first.mapped().empty());
        EXPECT_EQ(second.address(), address);
        EXPECT_EQ(second.sizeBytes(), 1000U);
        EXPECT_EQ(second.mapped().size(), 1000U);
        EXPECT_EQ(second.as<double>().size(), 125U);
        EXPECT_EQ(device.allocatedBytes(), one);
        second = Buffer(device, 5000, Memory::kReadback, "third");
        EXPECT_GE(device.allocatedBytes(), 5000U);
    }
    EXPECT_EQ(device.allocatedBytes(), 0U);
}

TEST_F(BufferTest, DeviceMemoryIsNotMapped) {
    const Buffer buffer(device, 16, Memory::kDevice, "hidden");
    EXPECT_TRUE(buffer.mapped().empty());
    EXPECT_NE(buffer.address(), 0U);
}

}  // namespace
}  // namespace radiata::gpu
