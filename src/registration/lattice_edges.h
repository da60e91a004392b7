// SPDX-License-Identifier: Apache-2.0
// The share of a pixel that a lattice board covers for a time-of-flight camera.
//
// A pixel with two surfaces measures the one that returns more light, pulled towards the other, or
// has no measurement. So the outline appears larger than drawn and the holes smaller, the more so
// the brighter the board is than the background. The wall of a hole, seen at an angle, belongs to
// the board, but it is darker than the face. The apparent place of an edge follows from the light
// of these three: the walls' is known from their angle, the background's is a parameter.
#pragma once

#include <array>
#include <vector>

#include "registration/lattice_target.h"

namespace theatron::registration {

// As docs/synthetic_sensor.md models mixed pixels: light that a pixel gets from the next and the
// one after, the longest pull of a farther surface, and the pull that makes a pixel invalid.
namespace mixed_light {
inline constexpr double next_light = 0.20, second_light = 0.012;
inline constexpr double farthest_pull_m = 0.3, given_up_m = 0.032;
}  // namespace mixed_light

struct EdgeParams {
    double outline_growth_m = 0, hole_growth_m = 0;  // of the board, outwards and into its holes
    double log_background = 0;  // logarithm of the background's light relative to the expected
};

struct Coverage {
    double share = 0;  // 0 to 1
    double by_u = 0, by_v = 0;
    std::array<double, 3> by_params{};  // in the order of EdgeParams
};

// Light that a pixel gets from the background behind an edge, relative to that of the board's
// surface, seen perpendicularly, at 1 m. Sides in the order left, bottom, right, top.
struct BackgroundLight {
    std::array<double, 4> outline{};
    std::array<double, LatticeTarget::columns * LatticeTarget::rows> cells{};  // row by row
};

// Light per apparent area, relative to that of the face.
struct EdgeLight {
    double wall_px = 0;  // width of the wall beside the face's edge, as seen
    double wall = 0;
    double background = 0;
};

// Measurements at most `board_m` behind the face's plane count as the board.
struct EdgeReach {
    double board_m = 0.02;
    double cos_face = 1;  // between the face's normal and the line of sight
    double thickness_m = 0;
};

// The mixing of light of neighbouring pixels across an edge in some direction of the picture.
class PixelBlur {
public:
    explicit PixelBlur(Vec2 direction);  // unit vector, at a right angle to the edge

    // The share of a pixel's light that comes from below `t` pixels from its middle.
    double below(double t) const;

private:
    static constexpr double reach = 4, step = 0.0625;
    std::array<double, int(2 * reach / step) + 1> below_{};
};

// The apparent place of the edge between a face with the wall beside it and the background, in
// pixels from the face's edge outwards: half-way between the last pixel that is measured as the
// board and the first that is measured as background.
double apparent_edge_px(const PixelBlur& blur, const EdgeLight& light, const EdgeReach& reach);

// The apparent pattern of one face for a camera at one place.
class SeenEdges {
public:
    // `pitch` is the angle of a pixel, radians; the camera must lie before the face; measurements
    // up to `board_reach_m` behind the face count as the board.
    SeenEdges(const LatticeTarget& target, Face face, const Pose& camera_from_face, double pitch,
              double board_reach_m, const BackgroundLight& background, double log_background);

    // At (u, v) on the face, for pixels that blur an edge over `ramp_u` and `ramp_v` metres.
    Coverage at(double u, double v, double ramp_u, double ramp_v, const EdgeParams& params) const;

    // True if an edge appears within `reach_m` of a place.
    bool is_near_edge(double u, double v, double reach_m) const {
        const int i = pattern_.nearest_cell(u, v);
        return outline_.is_near(u, v, reach_m) ||
               (pattern_.is_hole(i) && cells_[std::size_t(i)].is_near(u, v, reach_m));
    }

private:
    struct Sides {
        bool is_near(double u, double v, double reach_m) const {
            const double inside = std::min(std::min(u - place[0], v - place[1]),
                                           std::min(place[2] - u, place[3] - v));
            return std::abs(inside) < reach_m;
        }

        std::array<double, 4> place{};          // apparent place of each side
        std::array<double, 4> by_background{};  // its derivative by log_background
    };
    struct Viewpoint;
    static Sides seen(const Rect& drawn, bool is_hole, const Viewpoint& from,
                      const std::array<double, 4>& light);
    void add(const Sides& sides, bool is_hole, double u, double v, double ramp_u, double ramp_v,
             const EdgeParams& params, Coverage& sum) const;

    FacePattern pattern_;
    double log_background_;
    Sides outline_;
    std::array<Sides, FacePattern::cell_count> cells_;
};

}  // namespace theatron::registration
