// SPDX-License-Identifier: Apache-2.0
// The bytes and the processor time of a method's pictures.
#pragma once

#include <cstddef>
#include <vector>

#include "compare.h"

namespace theatron::bench {

// Processor time of all threads of this process since its start.
double processor_ms();

template <class Work>
double processor_ms_of(const Work& work) {
    const double begin = processor_ms();
    work();
    return processor_ms() - begin;
}

struct PictureCost {
    std::size_t bytes = 0;
    double sender_ms = 0, receiver_ms = 0;
};

// Shares the processor times of moments, in which all cameras worked at once, out to the cameras:
// in proportion to what each needed alone. All have equal numbers of pictures. Bytes are those of
// `cameras`, times those of `moments`.
void share_out(std::vector<std::vector<PictureCost>>& cameras,
               const std::vector<PictureCost>& moments,
               const std::vector<std::vector<PictureCost>>& alone);

// Fills the costs of `method`, the sending over `links` among them, from those of each camera's
// pictures. Cameras have equal numbers of pictures, at least one. The first pictures, which no
// other precedes, count for the links alone, unless they are the only ones.
void add_costs(CompareMethod& method, const std::vector<std::vector<PictureCost>>& cameras,
               const std::vector<CompareLink>& links);

}  // namespace theatron::bench
