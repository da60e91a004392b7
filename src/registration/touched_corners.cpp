// SPDX-License-Identifier: Apache-2.0
#include "registration/touched_corners.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <charconv>
#include <cmath>
#include <set>

namespace theatron::registration {
namespace {

constexpr double largest_rms_m = 0.015;
constexpr double farthest_m = 1000;

// Words of a line; more than `most` are not split.
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
        double values[7] = {};
        bool is_good = (words.size() == 4 || words.size() == 8) && words[0].size() == 1;
        const int corner = (words[0][0] | 0x20) - 'a';
        is_good = is_good && corner >= 0 && corner < 4;
        for (std::size_t i = 1; is_good && i < words.size(); ++i) {
            const char* const last = words[i].data() + words[i].size();
            const auto [stop, error] = std::from_chars(words[i].data(), last, values[i - 1]);
            is_good = error == std::errc{} && stop == last && std::abs(values[i - 1]) < farthest_m;
        }
        const Quat turn{values[3], values[4], values[5], values[6]};
        const bool has_turn = words.size() == 8;
        const double norm = turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z;
        if (is_good && has_turn)
            is_good = std::abs(norm - 1) < 0.02;
        if (!is_good) {
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
        const Vec3 at{values[0], values[1], values[2]};
        parsed.touches.push_back({corner, has_turn ? Pose{normalized(turn), at} * tip : at});
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
    const double share = 1 / double(touches.size());
    Vec3 board_mean{}, room_mean{};
    for (const Touch& touch : touches) {
        board_mean = board_mean + places[std::size_t(touch.corner)] * share;
        room_mean = room_mean + touch.room * share;
    }
    Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
    for (const Touch& touch : touches) {
        const Vec3 b = places[std::size_t(touch.corner)] - board_mean, r = touch.room - room_mean;
        product += Eigen::Vector3d(r.x, r.y, r.z) * Eigen::RowVector3d(b.x, b.y, b.z);
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1, 1, 1);
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    Mat3 matrix;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            matrix.m[i][j] = turn(i, j);
    fit.room_from_board.rotation = quat_from_matrix(matrix);
    fit.room_from_board.translation = room_mean - rotate(fit.room_from_board.rotation, board_mean);
    double squares = 0;
    for (const Touch& touch : touches) {
        const Vec3 off = fit.room_from_board * places[std::size_t(touch.corner)] - touch.room;
        squares += dot(off, off) * share;
    }
    fit.rms_m = std::sqrt(squares);
    if (!(fit.rms_m < largest_rms_m))
        fit.problem =
            "The touches are " + std::to_string(int(std::lround(fit.rms_m * 1000))) +
            " mm off the board's corners. Touch A, B, C, D clockwise from the corner with "
            "the three filled cells, seen from the front, and check --board and --tip.";
    return fit;
}

}  // namespace theatron::registration
