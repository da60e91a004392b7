// SPDX-License-Identifier: Apache-2.0
// Any bytes: parsing ends with labels or a problem, within bounded memory. Labels that were read
// fit their grid.
#include <cstdlib>

#include "cases/label_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const cases::ParsedLabels parsed = cases::parse_nifti(std::as_bytes(std::span(data, size)));
    if (!parsed.problem.empty())
        return 0;
    if (!medical::is_valid(parsed.value.grid) ||
        parsed.value.labels.size() != parsed.value.grid.size())
        std::abort();
    return 0;
}
