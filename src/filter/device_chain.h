// SPDX-License-Identifier: Apache-2.0
// The filters of one camera on the device that its settings choose: the processor, or a GPU, which
// gives the same pictures bit by bit. Where the GPU cannot be used, the processor takes its place.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "filter/chain.h"
#include "filter/cuda_chain.h"

namespace theatron::filter {

// Why no GPU of this machine can filter, one sentence; empty: one can. It looks at the first call
// alone, which takes up to a second where there is a GPU. From any thread.
const std::string& missing_gpu();
// That sentence, and that the processor takes its place.
std::string on_processor(const std::string& why);

// Not thread safe.
class DeviceChain {
public:
    using MakeGpuChain = std::function<std::unique_ptr<CudaChain>(
        const ChainSettings&, const ChainCamera&, std::string& problem)>;

    // `camera.background` must outlive this object. `now` is a steady clock, by which
    // Device::quickest compares.
    DeviceChain(ChainSettings settings, const ChainCamera& camera, std::function<TimePoint()> now,
                MakeGpuChain make_gpu_chain = &CudaChain::make);

    Size size() const { return camera_.size; }

    // As Chain::apply. With Device::quickest the first call filters its frame some times on both
    // devices, and the quicker one is kept.
    DepthView apply(DepthView in, Duration since_last_frame);

    // The device that filters now: "cpu", or the GPU's name.
    std::string device() const { return gpu_ ? gpu_->device() : "cpu"; }

    // One sentence for people about what happened since the last call: which device was found to
    // be quicker, or why the processor filters in place of a GPU, unless it is missing_gpu(), which
    // concerns all cameras. Empty: nothing.
    std::string take_remark() { return std::exchange(remark_, {}); }

private:
    void use_processor(const std::string& why);
    void choose(DepthView in);

    const ChainSettings settings_;
    const ChainCamera camera_;
    const std::function<TimePoint()> now_;
    const MakeGpuChain make_gpu_chain_;
    std::optional<Chain> processor_;  // while there is no gpu_
    std::unique_ptr<CudaChain> gpu_;
    bool must_choose_ = false;
    std::string remark_;
};

}  // namespace theatron::filter
