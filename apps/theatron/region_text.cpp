// SPDX-License-Identifier: Apache-2.0
#include "region_text.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"

namespace theatron::app {
namespace {

constexpr std::uint16_t max_coordinate = 8192;

[[noreturn]] void refuse(std::string_view numbers) {
    throw Error("'" + std::string(numbers) +
                "' is no region; a box is X:Y:WIDTH:HEIGHT, a polygon X:Y:X:Y:X:Y with 3 to " +
                std::to_string(codec::strata::max_corners) +
                " corners, for example 120:80:200:160.");
}

}  // namespace

codec::strata::Polygon parse_polygon(std::string_view numbers) {
    std::vector<std::uint16_t> values;
    const char* at = numbers.data();
    const char* const end = at + numbers.size();
    while (true) {
        std::uint16_t value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || value > max_coordinate ||
            values.size() >= 2 * codec::strata::max_corners)
            refuse(numbers);
        values.push_back(value);
        if (next == end)
            break;
        if (*next != ':')
            refuse(numbers);
        at = next + 1;
    }
    if (values.size() == 4) {
        if (values[2] == 0 || values[3] == 0)
            refuse(numbers);
        return codec::strata::box(values[0], values[1], values[0] + values[2],
                                  values[1] + values[3]);
    }
    if (values.size() < 6 || values.size() % 2 != 0)
        refuse(numbers);
    codec::strata::Polygon polygon;
    for (std::size_t i = 0; i < values.size(); i += 2)
        polygon.push_back({values[i], values[i + 1]});
    return polygon;
}

RegionText parse_region(const std::string& text) {
    const auto equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0)
        throw Error("The region '" + text +
                    "' does not say which camera; write CAMERA=X:Y:WIDTH:HEIGHT, for example "
                    "0=120:80:200:160.");
    return {text.substr(0, equals), parse_polygon(std::string_view(text).substr(equals + 1))};
}

}  // namespace theatron::app
