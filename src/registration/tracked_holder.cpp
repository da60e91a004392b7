// SPDX-License-Identifier: Apache-2.0
#include "registration/tracked_holder.h"

#include <charconv>
#include <cmath>

#include "registration/pose_line.h"
#include "registration/rigid_fit.h"
#include "registration/touched_corners.h"

namespace theatron::registration {
namespace {

// An offset that was measured badly, a place of another number, or a board that slipped is further
// off.
constexpr double largest_holder_rms_m = 0.015;

}  // namespace

ParsedHolder parse_holder(std::string_view text) {
    ParsedHolder parsed;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto words = words_of(text.substr(0, end), 8);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        if (words.empty() || words[0].starts_with('#'))
            continue;
        int place = 0;
        const char* const last = words[0].data() + words[0].size();
        const auto [stop, error] = std::from_chars(words[0].data(), last, place);
        const auto pose = parse_pose(std::span(words).subspan(1));
        if (error != std::errc{} || stop != last || place < 1 || !pose || words.size() != 8) {
            parsed.problem = "Line " + std::to_string(number) +
                             " of the holder's poses is not PLACE X Y Z QW QX QY QZ, with a place "
                             "from 1 on and metres.";
            return parsed;
        }
        parsed.poses.push_back({place - 1, *pose});
    }
    return parsed;
}

HolderFit fit_holder(const LatticeTarget& target, std::span<const Pose> reference_from_board,
                     const Pose& controller_from_board, std::span<const HolderPose> poses) {
    HolderFit fit;
    if (poses.empty()) {
        fit.problem = "There is no pose of the holder; give one line for a place of the board.";
        return fit;
    }
    std::vector<Vec3> by_cameras, by_controller;
    for (const HolderPose& pose : poses) {
        if (pose.place < 0 || std::size_t(pose.place) >= reference_from_board.size()) {
            fit.problem = "The holder's poses name place " + std::to_string(pose.place + 1) +
                          ", and the cameras saw the board at " +
                          std::to_string(reference_from_board.size()) + ".";
            return fit;
        }
        for (const Vec3& corner : board_corners(target)) {
            by_cameras.push_back(reference_from_board[std::size_t(pose.place)] * corner);
            by_controller.push_back(pose.room_from_controller * controller_from_board * corner);
        }
    }
    const RigidFit found = fit_rigid(by_cameras, by_controller);
    fit.room_from_reference = found.pose;
    fit.rms_m = found.rms_m;
    if (!(fit.rms_m < largest_holder_rms_m))
        fit.problem = "The controller has the board " +
                      std::to_string(int(std::lround(fit.rms_m * 1000))) +
                      " mm from where the cameras see it. Check --holder-offset, the numbers of "
                      "the places, and that the board is fixed in its holder.";
    return fit;
}

}  // namespace theatron::registration
