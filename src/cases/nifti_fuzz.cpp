// SPDX-License-Identifier: Apache-2.0
// Any bytes: parsing ends with labels or a problem, within bounded memory. Labels that were read
// fit their grid.
#include <algorithm>
#include <cstdlib>

#include "cases/label_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView file = std::as_bytes(std::span(data, size));
    // A head of a pair has its samples behind it here.
    const bool is_head = cases::is_nifti_head(file);
    const cases::ParsedLabels parsed = cases::parse_nifti(
        file, is_head ? file.subspan(std::min<std::size_t>(size, 352)) : ByteView());
    if (!parsed.problem.empty())
        return 0;
    if (!medical::is_valid(parsed.value.grid) ||
        parsed.value.labels.size() != parsed.value.grid.size())
        std::abort();
    return 0;
}
