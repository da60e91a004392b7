// SPDX-License-Identifier: Apache-2.0
// Computes the places of several cameras from their depth images, while a person carries the board.
//
// While the board is at rest, each camera that sees it averages some frames and makes one view.
// Views of the same moment belong to one place of the board. Times are those of the frames.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/time.h"
#include "registration/frame_mean.h"
#include "registration/rig_solver.h"

namespace theatron::registration {

struct SessionCamera {
    std::string name;  // for sentences
    CameraModel depth;
    double depth_unit_mm = 1;
};

class BoardSession {
public:
    static constexpr int frames_per_view = 30;

    // `cameras` must have at least one; `target` must be valid.
    BoardSession(std::vector<SessionCamera> cameras, const LatticeTarget& target);

    // The result of a camera's last frame.
    enum class Sight { no_board, moving, averaging, taken };

    // `depth` must have the camera's size, and the times of a camera must grow. True if a view was
    // taken.
    bool add(std::size_t camera, DepthView depth, TimePoint captured);

    Sight sight(std::size_t camera) const { return cameras_[camera].sight; }
    // Views of this camera, and the number of ninths of its picture that had the board's middle.
    int views(std::size_t camera) const;
    int coverage(std::size_t camera) const;
    // Places that both cameras saw, and the root mean square of the distances between the board's
    // corners there according to either camera, metres.
    struct Pair {
        std::size_t a = 0, b = 0;
        int places = 0;
        double apart_m = 0;
    };
    std::vector<Pair> pairs(const RigSolution& solution) const;

    int places() const { return int(places_.size()); }
    // The size of the box that holds the board's middles, along the axes of camera 0, metres; zero
    // before the solution converged.
    static Vec3 span_m(const RigSolution& solution);
    // A sentence on where to hold the board next, so that each camera gets this many views, all
    // over its picture, and all cameras are joined; empty once is_complete().
    std::string next_step(const RigSolution& solution, int views) const;
    // True if all cameras are joined by shared places, and each has at least this many views.
    bool is_complete(const RigSolution& solution, int views) const;
    // The mean of the last still frames; empty before there was one.
    const DepthImage& last_mean(std::size_t camera) const { return cameras_[camera].mean; }
    double mean_unit_mm(std::size_t camera) const;

    // Takes long with many views: once after each.
    RigSolution solve() const;

    // A sentence with the problem of `solution` and its remedy; empty if the solution may be used.
    std::string problem(const RigSolution& solution) const;

private:
    struct Window {
        TimePoint begin{}, end{};
        Pose first;
        FrameMean mean;
    };
    struct Camera {
        SessionCamera about;
        LatticeDetector detector, mean_detector;
        std::optional<Window> window;
        std::optional<Pose> taken;  // the board as it was at the last view
        Sight sight = Sight::no_board;
        int frames_to_next_look = 0;
        DepthImage mean;
    };
    struct Place {
        TimePoint begin{}, end{};
    };
    bool finish(std::size_t camera, const Pose& last);
    std::set<int> covered_ninths(std::size_t camera) const;
    int common_places(std::size_t a, std::size_t b) const;
    int place_for(std::size_t camera, TimePoint begin, TimePoint end);

    LatticeTarget target_;
    std::vector<Camera> cameras_;
    std::vector<Place> places_;
    std::vector<BoardView> views_;
};

}  // namespace theatron::registration
