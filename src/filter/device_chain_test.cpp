// SPDX-License-Identifier: Apache-2.0
#include "filter/device_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "filter/test_depth.h"

namespace theatron::filter {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Size size{64, 48};
constexpr Duration gap = std::chrono::microseconds(33'333);

// A GPU that takes `took` for a frame on the test's clock and fails after `lasts` frames.
struct SimulatedGpu {
    TimePoint now{};
    Duration took{}, took_of_processor{};
    int lasts = 1'000'000, made = 0;
    std::string problem;  // not empty: none answers

    DeviceChain::MakeGpuChain maker() {
        class OnProcessor final : public CudaChain {
        public:
            OnProcessor(SimulatedGpu& gpu, const ChainSettings& settings, const ChainCamera& camera)
                : gpu_(gpu), chain_(settings, camera) {}
            std::optional<DepthView> apply(DepthView in, Duration since) override {
                gpu_.now += gpu_.took;
                if (gpu_.lasts-- <= 0)
                    return std::nullopt;
                return chain_.apply(in, since);
            }
            std::string device() const override { return "GPU of a test"; }

        private:
            SimulatedGpu& gpu_;
            Chain chain_;
        };
        return [this](const ChainSettings& settings, const ChainCamera& camera,
                      std::string& why) -> std::unique_ptr<CudaChain> {
            ++made;
            why = problem;
            return problem.empty() ? std::make_unique<OnProcessor>(*this, settings, camera)
                                   : nullptr;
        };
    }
    // A frame on the processor takes its time between two looks at the clock.
    std::function<TimePoint()> clock() {
        return [this] { return now += took_of_processor; };
    }
};

ChainSettings settings_of(const char* text) {
    const ParsedChain parsed = parse_chain(text);
    EXPECT_EQ(parsed.problem, "");
    return parsed.settings;
}

DeviceChain chain_on(SimulatedGpu& gpu, const char* text) {
    return DeviceChain(settings_of(text), {.size = size}, gpu.clock(), gpu.maker());
}

// All frames equal those of a plain chain.
void expect_plain_frames(DeviceChain& chain, int from = 0) {
    Chain plain(settings_of("default"), {.size = size});
    for (int i = from; i < from + 6; ++i) {
        const DepthImage image = two_walls(size, i / 3, 3, i % 2 ? 30 : 12);
        ASSERT_EQ(copy_of(chain.apply(image.view(), gap)), copy_of(plain.apply(image.view(), gap)))
            << i;
    }
}

TEST(DeviceChain, UsesTheProcessorWithoutAskingForAGpu) {
    SimulatedGpu gpu;
    DeviceChain chain = chain_on(gpu, "default");
    expect_plain_frames(chain);
    EXPECT_EQ(gpu.made, 0);
    EXPECT_EQ(chain.device(), "cpu");
    EXPECT_EQ(chain.take_remark(), "");
}

TEST(DeviceChain, UsesTheGpuThatIsChosen) {
    SimulatedGpu gpu;
    DeviceChain chain = chain_on(gpu, "default@cuda");
    expect_plain_frames(chain);
    EXPECT_EQ(chain.device(), "GPU of a test");
    EXPECT_EQ(chain.take_remark(), "");
}

TEST(DeviceChain, SaysOnceWhyTheProcessorFilters) {
    SimulatedGpu gpu;
    gpu.problem = "The GPU of a test is full.";
    for (const char* text : {"default@cuda", "default@auto"}) {
        DeviceChain chain = chain_on(gpu, text);
        expect_plain_frames(chain);
        EXPECT_EQ(chain.device(), "cpu");
        EXPECT_EQ(chain.take_remark(),
                  "The GPU of a test is full. The filters run on the processor, with the same "
                  "result.")
            << text;
        EXPECT_EQ(chain.take_remark(), "") << text;
    }
}

TEST(DeviceChain, LeavesWhatAllCamerasLackToTheProgram) {
    if (missing_gpu().empty())
        GTEST_SKIP() << "This machine has a GPU; the test is about those without.";
    DeviceChain chain(settings_of("default@cuda"), {.size = size}, [] { return TimePoint{}; });
    expect_plain_frames(chain);
    EXPECT_EQ(chain.device(), "cpu");
    EXPECT_EQ(chain.take_remark(), "");
}

TEST(DeviceChain, GoesOnWhenTheGpuFails) {
    SimulatedGpu gpu;
    gpu.lasts = 2;
    DeviceChain chain = chain_on(gpu, "default@cuda");
    const DepthImage image = two_walls(size, 1, 3, 12);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(chain.apply(image.view(), gap).size, size);
    EXPECT_EQ(chain.device(), "cpu");
    EXPECT_THAT(chain.take_remark(), HasSubstr("GPU of a test failed"));
}

TEST(DeviceChain, TheQuickerDeviceIsKeptAndSeesEachFrameOnce) {
    SimulatedGpu gpu;
    gpu.took = std::chrono::microseconds(300);
    gpu.took_of_processor = std::chrono::microseconds(900);
    {
        // Each look at the clock takes longer here than the GPU's frame, so compare the sums.
        DeviceChain chain = chain_on(gpu, "default@auto");
        expect_plain_frames(chain);
        EXPECT_EQ(chain.device(), "cpu");
        EXPECT_THAT(chain.take_remark(),
                    AllOf(HasSubstr("on the processor: 0.90 ms"), HasSubstr("1.20 ms on the GPU")));
    }
    gpu.took = std::chrono::microseconds(-300);  // quicker by that than the processor
    DeviceChain chain = chain_on(gpu, "default@auto");
    expect_plain_frames(chain);
    EXPECT_EQ(chain.device(), "GPU of a test");
    EXPECT_THAT(chain.take_remark(),
                AllOf(HasSubstr("on GPU of a test: 0.60 ms"), HasSubstr("0.90 ms on the proc")));
}

TEST(DeviceChain, AGpuThatFailsAtOnceIsNotKept) {
    SimulatedGpu gpu;
    gpu.lasts = 0;
    DeviceChain chain = chain_on(gpu, "default@auto");
    expect_plain_frames(chain);
    EXPECT_EQ(chain.device(), "cpu");
    EXPECT_THAT(chain.take_remark(), HasSubstr("failed"));
}

}  // namespace
}  // namespace theatron::filter
