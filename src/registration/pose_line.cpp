// SPDX-License-Identifier: Apache-2.0
#include "registration/pose_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace theatron::registration {
namespace {

constexpr double farthest_m = 1000;
// Quaternions are written with two digits or more; this is about their squared length.
constexpr double largest_deviation = 0.02;

}  // namespace

std::vector<std::string_view> words_of(std::string_view line, std::size_t most) {
    std::vector<std::string_view> words;
    constexpr std::string_view blanks = " \t\r,";
    while (words.size() <= most) {
        const std::size_t begin = line.find_first_not_of(blanks);
        if (begin == std::string_view::npos)
            break;
        const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        line.remove_prefix(end);
    }
    return words;
}

std::optional<Pose> parse_pose(std::span<const std::string_view> words) {
    if (words.size() != 3 && words.size() != 7)
        return std::nullopt;
    double values[7] = {0, 0, 0, 1, 0, 0, 0};
    for (std::size_t i = 0; i < words.size(); ++i) {
        const char* const last = words[i].data() + words[i].size();
        const auto [stop, error] = std::from_chars(words[i].data(), last, values[i]);
        if (error != std::errc{} || stop != last || !(std::abs(values[i]) < farthest_m))
            return std::nullopt;
    }
    const Quat turn{values[3], values[4], values[5], values[6]};
    const double norm = turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z;
    if (!(std::abs(norm - 1) < largest_deviation))
        return std::nullopt;
    return Pose{normalized(turn), {values[0], values[1], values[2]}};
}

}  // namespace theatron::registration
