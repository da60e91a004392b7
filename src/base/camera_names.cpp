// SPDX-License-Identifier: Apache-2.0
#include "base/camera_names.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"

namespace theatron {

std::size_t find_camera(const std::string& number_or_name, const std::vector<std::string>& names) {
    const auto named = std::find(names.begin(), names.end(), number_or_name);
    if (named != names.end())
        return std::size_t(named - names.begin());
    std::size_t number = 0;
    const char* const end = number_or_name.data() + number_or_name.size();
    const auto [next, error] = std::from_chars(number_or_name.data(), end, number);
    if (names.empty())
        throw Error("There is no camera '" + number_or_name + "', since there are no cameras.");
    if (error != std::errc() || next != end || number >= names.size())
        throw Error("There is no camera '" + number_or_name +
                    "'; the cameras have the numbers 0 to " + std::to_string(names.size() - 1) +
                    ".");
    return number;
}

}  // namespace theatron
