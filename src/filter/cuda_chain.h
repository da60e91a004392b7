// SPDX-License-Identifier: Apache-2.0
// The filters of one camera on an NVIDIA GPU; its results equal those of chain.h.
//
// make() fails in builds without CUDA and if no device responds; the caller then uses Chain.
#pragma once

#include <memory>

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

    // As Chain::apply. False if the device failed: discard the chain.
    virtual bool apply(DepthView in, MutableDepthView out, Duration since_last_frame) = 0;
};

}  // namespace theatron::filter
