// SPDX-License-Identifier: Apache-2.0
// The filters of one camera on an NVIDIA GPU, pixel for pixel those of chain.h.
//
// In builds without CUDA, and where no device answers, there is none; the caller
// then uses Chain.
#pragma once

#include <memory>

#include "base/time.h"
#include "filter/chain_camera.h"
#include "filter/chain_settings.h"
#include "image/view.h"

namespace theatron::filter {

class CudaChain {
public:
    // Null, and one sentence in `problem`, where that cannot be.
    static std::unique_ptr<CudaChain> make(const ChainSettings& settings, const ChainCamera& camera,
                                           std::string& problem);
    virtual ~CudaChain() = default;

    // As Chain::apply. False if the device failed: the chain is of no use any more.
    virtual bool apply(DepthView in, MutableDepthView out, Duration since_last_frame) = 0;
};

}  // namespace theatron::filter
