// SPDX-License-Identifier: Apache-2.0
// Any bytes as a file of places: what is accepted reads the same after it was written.
#include <cstdlib>

#include "capture/camera_places.h"

using namespace theatron::capture;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    (void)parse_place(text);
    const ParsedPlaces parsed = parse_places(text);
    if (!parsed.problem.empty())
        return 0;
    const ParsedPlaces again = parse_places(write_places(parsed.places));
    if (!again.problem.empty() || again.places.cameras.size() != parsed.places.cameras.size())
        std::abort();
    return 0;
}
