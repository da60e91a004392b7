// SPDX-License-Identifier: Apache-2.0
#include "registration/touched_corners.h"

#include <cmath>
#include <set>
#include <span>

#include "registration/pose_line.h"
#include "registration/rigid_fit.h"

namespace theatron::registration {
namespace {

constexpr double largest_rms_m = 0.015;

}  // namespace

std::array<Vec3, 4> board_corners(const LatticeTarget& target) {
    const double x = target.width_m / 2, y = target.height_m / 2;
    return {{{-x, y, 0}, {x, y, 0}, {x, -y, 0}, {-x, -y, 0}}};
}

ParsedTouches parse_touches(std::string_view text, Vec3 tip) {
    ParsedTouches parsed;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        const auto words = words_of(line, 8);
        if (words.empty() || words[0].starts_with('#'))
            continue;
        const int corner = words[0].size() == 1 ? (words[0][0] | 0x20) - 'a' : -1;
        const bool has_turn = words.size() == 8;
        const auto pose = parse_pose(std::span(words).subspan(1));
        if (!pose || corner < 0 || corner >= 4) {
            parsed.problem =
                "Line " + std::to_string(number) +
                " of the touches is not CORNER X Y Z or CORNER X Y Z QW QX QY QZ, with "
                "a corner from A to D and metres.";
            return parsed;
        }
        if (!has_turn && length(tip) > 0) {
            parsed.problem = "Line " + std::to_string(number) +
                             " of the touches has no rotation, which the tip's offset needs.";
            return parsed;
        }
        parsed.touches.push_back({corner, *pose * tip});
    }
    return parsed;
}

TouchFit fit_touches(const LatticeTarget& target, const std::vector<Touch>& touches) {
    TouchFit fit;
    std::set<int> corners;
    for (const Touch& touch : touches)
        corners.insert(touch.corner);
    if (corners.size() < 3) {
        fit.problem = "Touch at least three corners of the board; there are " +
                      std::to_string(corners.size()) + ".";
        return fit;
    }
    const std::array<Vec3, 4> places = board_corners(target);
    std::vector<Vec3> of_board, in_room;
    for (const Touch& touch : touches) {
        of_board.push_back(places[std::size_t(touch.corner)]);
        in_room.push_back(touch.room);
    }
    const RigidFit found = fit_rigid(of_board, in_room);
    fit.room_from_board = found.pose;
    fit.rms_m = found.rms_m;
    if (!(fit.rms_m < largest_rms_m))
        fit.problem =
            "The touches are " + std::to_string(int(std::lround(fit.rms_m * 1000))) +
            " mm off the board's corners. Touch A, B, C, D clockwise from the corner with "
            "the three filled cells, seen from the front, and check --board and --tip.";
    return fit;
}

}  // namespace theatron::registration
