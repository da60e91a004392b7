// SPDX-License-Identifier: Apache-2.0
// Any picture is searched for strips, twice as in a film; what is found lies near the picture, and
// has a time whose cells read back.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "photon/strip_finder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using namespace theatron::photon;
    // Width, then rows; short rows make small inputs find strips sooner.
    if (size < 2)
        return 0;
    const int width = data[0] + 1;
    const int height = int(std::min<std::size_t>((size - 1) / std::size_t(width), 255));
    if (height == 0)
        return 0;
    GreyImage grey({width, height});
    std::memcpy(grey.pixels.data(), data + 1, grey.pixels.size());
    StripFinder finder;
    for (int i = 0; i < 2; ++i)
        for (const StripReading& strip : finder.find(grey.view())) {
            for (const Point corner : strip.frame)
                if (!(std::abs(corner.x) < 2000 && std::abs(corner.y) < 2000))
                    std::abort();
            if (strip.time && time_of(cells_of(*strip.time)) != strip.time)
                std::abort();
        }
    return 0;
}
