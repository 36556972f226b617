// Work on the device: dispatch, copy, fill, times.
#include "gpu/recorder.h"

#include <array>
#include <cstring>
#include <numeric>
#include <thread>
#include <vector>

#include "gpu/device/fixture.h"

namespace radiata::gpu {
namespace {

using RecorderTest = DeviceTest;
constexpr std::uint32_t kGroup = 64;

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

TEST_F(RecorderTest, SquaresAMillionNumbersExactly) {
    std::vector<float> numbers(1'000'000);
    std::iota(numbers.begin(), numbers.end(), -500'000.0F);
    const Buffer buffer(device, numbers.size() * sizeof(float), Memory::kDevice, "numbers");
    upload(device, buffer, 0, bytesOf(numbers));
    const ComputePipeline square = squarePipeline(device, kGroup);
    CommandRecorder recorder(device);
    const auto count = static_cast<std::uint32_t>(numbers.size());
    recorder.dispatch(square, "square", (count + kGroup - 1) / kGroup, 1, 1, SquarePush{buffer.address(), count});
    recorder.submitAndWait();
    std::vector<float> squared(numbers.size());
    download(device, buffer, 0, std::as_writable_bytes(std::span(squared)));
    for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(squared[i], numbers[i] * numbers[i]) << i;
}

TEST_F(RecorderTest, LaterWorkSeesEarlierWorkWithinOneSubmit) {
    constexpr std::uint32_t kCount = 4096;
    const Buffer first(device, kCount * 4, Memory::kDevice, "first");
    const Buffer second(device, kCount * 4, Memory::kDevice, "second");
    const Buffer result(device, kCount * 4, Memory::kReadback, "result");
    const ComputePipeline square = squarePipeline(device, kGroup);
    CommandRecorder recorder(device);
    const float three = 3;
    std::uint32_t word = 0;
    std::memcpy(&word, &three, 4);
    recorder.fill(first, 0, kCount * 4, word);
    recorder.dispatch(square, "square", kCount / kGroup, 1, 1, SquarePush{first.address(), kCount});
    recorder.copy(first, 0, second, 0, kCount * 4);
    recorder.dispatch(square, "square", kCount / kGroup, 1, 1, SquarePush{second.address(), kCount});
    recorder.dispatch(square, "once more", kCount / kGroup, 1, 1, SquarePush{second.address(), kCount});
    recorder.copy(second, 0, result, 0, kCount * 4);
    recorder.submitAndWait();
    for (const float value : result.as<float>()) ASSERT_EQ(value, 6561.0F);

    const std::vector<PassTiming> timings = recorder.takeTimings();
    ASSERT_EQ(timings.size(), 2U);
    EXPECT_EQ(timings[0].name, "square");
    EXPECT_EQ(timings[0].shader, "test_square");
    EXPECT_EQ(timings[1].name, "once more");
    for (const PassTiming& timing : timings) {
        EXPECT_GT(timing.time_ms, 0) << timing.name;
        EXPECT_LT(timing.time_ms, 10'000) << timing.name;
    }
    EXPECT_TRUE(recorder.takeTimings().empty());
}

TEST_F(RecorderTest, ManyDispatchesOutgrowNoQueryPool) {
    constexpr int kDispatches = 1300;  // more than two pools of queries
    const Buffer buffer(device, 4, Memory::kReadback, "one");
    buffer.as<float>()[0] = 1;
    const ComputePipeline square = squarePipeline(device, 1);
    CommandRecorder recorder(device);
    for (int i = 0; i < kDispatches; ++i) recorder.dispatch(square, "square", 1, 1, 1, SquarePush{buffer.address(), 1});
    recorder.submitAndWait();
    EXPECT_EQ(buffer.as<float>()[0], 1.0F);
    const auto timings = recorder.takeTimings();
    ASSERT_EQ(timings.size(), 1U);
    EXPECT_GT(timings[0].time_ms, 0);
}

TEST_F(RecorderTest, CopiesAndFillsPartsOfBuffers) {
    const Buffer source(device, 64, Memory::kUpload, "source");
    const Buffer target(device, 64, Memory::kReadback, "target");
    for (std::uint32_t i = 0; i < 16; ++i) source.as<std::uint32_t>()[i] = i;
    CommandRecorder recorder(device);
    recorder.fill(target, 0, 64, 99);
    recorder.copy(source, 8, target, 16, 12);
    recorder.fill(target, 60, 4, 7);
    recorder.submitAndWait();
    const std::array<std::uint32_t, 16> expected{99, 99, 99, 99, 2, 3, 4, 99, 99, 99, 99, 99, 99, 99, 99, 7};
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(target.as<std::uint32_t>()[i], expected[i]) << i;
}

TEST_F(RecorderTest, RefusesWhatDoesNotFit) {
    const Buffer buffer(device, 64, Memory::kDevice, "small");
    CommandRecorder recorder(device);
    EXPECT_EQ(errorOf([&] { recorder.copy(buffer, 60, buffer, 0, 8); }).code(), Code::kInternal);
    EXPECT_EQ(errorOf([&] { recorder.fill(buffer, ~0ULL - 3, 8, 0); }).code(), Code::kInternal);
    EXPECT_EQ(errorOf([&] { recorder.fill(buffer, 2, 4, 0); }).code(), Code::kInternal);
    EXPECT_EQ(errorOf([&] { recorder.fill(Buffer(), 0, 4, 0); }).code(), Code::kInternal);
    const std::vector<std::byte> bytes(65);
    const Error error = errorOf([&] { upload(device, buffer, 0, bytes); });
    EXPECT_NE(std::string(error.what()).find("'small' of 64 bytes"), std::string::npos) << error.what();
    const ComputePipeline square = squarePipeline(device, kGroup);
    EXPECT_NE(std::string(errorOf([&] {
                              recorder.dispatch(square, "vast", ~0U, ~0U, ~0U, SquarePush{buffer.address(), 1});
                          }).what())
                  .find("vast"),
              std::string::npos);
}

TEST_F(RecorderTest, DiscardForgetsWorkOnBuffersThatAreGone) {
    const ComputePipeline square = squarePipeline(device, kGroup);
    CommandRecorder recorder(device);
    {
        const Buffer gone(device, 4096, Memory::kDevice, "gone");
        recorder.dispatch(square, "lost", 16, 1, 1, SquarePush{gone.address(), 1024});
        recorder.discard();
    }
    const Buffer kept(device, 4, Memory::kReadback, "kept");
    recorder.fill(kept, 0, 4, 5);
    recorder.submitAndWait();
    EXPECT_EQ(kept.as<std::uint32_t>()[0], 5U);
    EXPECT_TRUE(recorder.takeTimings().empty());
}

TEST_F(RecorderTest, RecordersOfSeveralThreadsShareTheQueue) {
    constexpr int kThreads = 4;
    constexpr int kSubmits = 20;
    std::vector<float> results(kThreads);
    {
        std::vector<std::jthread> threads;
        for (int thread = 0; thread < kThreads; ++thread) {
            threads.emplace_back([this, thread, &results] {
                const Buffer buffer(device, 4, Memory::kReadback, "of a thread");
                const ComputePipeline square = squarePipeline(device, 1);
                CommandRecorder recorder(device);
                for (int i = 0; i < kSubmits; ++i) {
                    buffer.as<float>()[0] = static_cast<float>(thread + 2);
                    recorder.dispatch(square, "square", 1, 1, 1, SquarePush{buffer.address(), 1});
                    recorder.dispatch(square, "square", 1, 1, 1, SquarePush{buffer.address(), 1});
                    recorder.submitAndWait();
                }
                results[static_cast<std::size_t>(thread)] = buffer.as<float>()[0];
            });
        }
    }
    EXPECT_EQ(results, (std::vector<float>{16, 81, 256, 625}));
}

TEST_F(RecorderTest, EmptySubmitDoesNothing) {
    CommandRecorder recorder(device);
    recorder.submitAndWait();
    const ComputePipeline square = squarePipeline(device, kGroup);
    recorder.dispatch(square, "none", 0, 1, 1, SquarePush{0, 0});
    recorder.submitAndWait();
    EXPECT_TRUE(recorder.takeTimings().empty());
}

}  // namespace
}  // namespace radiata::gpu
