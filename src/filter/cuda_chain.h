// SPDX-License-Identifier: Apache-2.0
// The filters of one camera on an NVIDIA GPU; its results equal those of chain.h.
//
// make() fails in builds without CUDA and if no device responds; DeviceChain then uses Chain.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "filter/chain_camera.h"
#include "filter/chain_settings.h"
#include "image/view.h"

namespace theatron::filter {

class CudaChain {
public:
    // On failure: null, and one sentence in `problem`.
    static std::unique_ptr<CudaChain> make(const ChainSettings& settings, const ChainCamera& camera,
                                           std::string& problem);
    virtual ~CudaChain() = default;

    // As Chain::apply. Nullopt if the device failed: discard the chain.
    virtual std::optional<DepthView> apply(DepthView in, Duration since_last_frame) = 0;
    // The name of the device, as its driver tells it.
    virtual std::string device() const = 0;
};

}  // namespace theatron::filter
