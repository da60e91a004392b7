// SPDX-License-Identifier: Apache-2.0
// CudaChain in builds without CUDA.
#ifndef THEATRON_HAS_CUDA

#include <string>

#include "filter/cuda_chain.h"

namespace theatron::filter {

std::unique_ptr<CudaChain> CudaChain::make(const ChainSettings&, const ChainCamera&,
                                           std::string& problem) {
    problem = "This build has no CUDA.";
    return nullptr;
}

}  // namespace theatron::filter

#endif
