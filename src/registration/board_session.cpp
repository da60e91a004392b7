// SPDX-License-Identifier: Apache-2.0
#include "registration/board_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace theatron::registration {
namespace {

// Detection takes longer than averaging: only one frame in this number is searched.
constexpr int frames_between_looks = 6;
constexpr double still_m = 0.004, still_rad = 0.006;
constexpr double moved_m = 0.05, moved_rad = 0.09;  // a new place of the board
// Farther off than a camera measures wrong: the board is of another size.
constexpr double believable_scale = 0.012;
constexpr double believable_error_m = 0.010;

double angle_between(const Pose& a, const Pose& b) {
    const Quat d = conjugate(a.rotation) * b.rotation;
    return 2 * std::asin(std::min(1.0, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

bool is_near(const Pose& a, const Pose& b, double shift_m, double turn) {
    return length(a.translation - b.translation) < shift_m && angle_between(a, b) < turn;
}

// How much smaller the board is than given, by a view: depth measures its distance directly, the
// edges by its size.
double smaller_by(const LatticeFit& fit) {
    const Vec3 by_edges = fit.camera_from_face_by_edges.translation;
    const Ray ray{float(by_edges.x / by_edges.z), float(by_edges.y / by_edges.z)};
    return 1 - 1 / (fit.plane.inverse_depth(ray) * by_edges.z);
}

std::string percent(double share) {
    const int tenths = int(std::lround(std::abs(share) * 1000));
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
}

}  // namespace

BoardSession::BoardSession(std::vector<SessionCamera> cameras, const LatticeTarget& target)
    : target_(target) {
    for (SessionCamera& camera : cameras) {
        LatticeDetector detector(camera.depth, camera.depth_unit_mm, target);
        LatticeDetector mean_detector(camera.depth, camera.depth_unit_mm / FrameMean::finer,
                                      target);
        cameras_.push_back({std::move(camera),
                            std::move(detector),
                            std::move(mean_detector),
                            {},
                            {},
                            Sight::no_board,
                            0,
                            {}});
    }
}

bool BoardSession::add(std::size_t index, DepthView depth, TimePoint captured) {
    Camera& camera = cameras_[index];
    if (camera.window) {
        camera.window->mean.add(depth);
        camera.window->end = captured;
    }
    const bool full = camera.window && camera.window->mean.frames() >= frames_per_view;
    if (!full && --camera.frames_to_next_look > 0)
        return false;
    camera.frames_to_next_look = frames_between_looks;
    const auto found = camera.detector.detect(depth);
    if (!found) {
        camera.window.reset();
        camera.sight = Sight::no_board;
        return false;
    }
    const Pose& pose = found->camera_from_board;
    if (camera.taken && is_near(*camera.taken, pose, moved_m, moved_rad)) {
        camera.window.reset();
        camera.sight = Sight::taken;
        return false;
    }
    if (camera.window && is_near(camera.window->first, pose, still_m, still_rad)) {
        camera.sight = Sight::averaging;
        return full && finish(index, pose);
    }
    camera.sight = camera.window ? Sight::moving : Sight::averaging;
    camera.window = Window{captured, captured, pose, FrameMean(depth.size)};
    camera.window->mean.add(depth);
    return false;
}

bool BoardSession::finish(std::size_t index, const Pose& last) {
    Camera& camera = cameras_[index];
    camera.mean = camera.window->mean.mean();
    const TimePoint begin = camera.window->begin, end = camera.window->end;
    camera.window.reset();
    const auto found =
        camera.mean_detector.detect(std::as_const(camera.mean).view(), FitEffort::measure);
    if (!found)
        return false;
    views_.push_back({int(index), place_for(index, begin, end), *found});
    camera.taken = last;
    camera.sight = Sight::taken;
    return true;
}

// Still views that overlap by half in time are of one place.
int BoardSession::place_for(std::size_t camera, TimePoint begin, TimePoint end) {
    for (std::size_t i = places_.size(); i-- > 0;) {
        const Place& place = places_[i];
        const auto common = std::min(end, place.end) - std::max(begin, place.begin);
        const bool mine = std::any_of(views_.begin(), views_.end(), [&](const BoardView& v) {
            return v.place == int(i) && v.camera == int(camera);
        });
        if (!mine && 2 * common >= std::min(end - begin, place.end - place.begin))
            return int(i);
    }
    places_.push_back({begin, end});
    return int(places_.size()) - 1;
}

int BoardSession::views(std::size_t camera) const {
    return int(std::count_if(views_.begin(), views_.end(),
                             [&](const BoardView& v) { return v.camera == int(camera); }));
}

// Row by row from the upper left.
std::set<int> BoardSession::covered_ninths(std::size_t camera) const {
    const CameraModel& model = cameras_[camera].about.depth;
    std::set<int> ninths;
    for (const BoardView& view : views_) {
        const auto pixel = project(model, view.detection.camera_from_board.translation);
        if (view.camera == int(camera) && pixel)
            ninths.insert(std::clamp(int(3 * pixel->y / model.size.height), 0, 2) * 3 +
                          std::clamp(int(3 * pixel->x / model.size.width), 0, 2));
    }
    return ninths;
}

int BoardSession::coverage(std::size_t camera) const {
    return int(covered_ninths(camera).size());
}

int BoardSession::common_places(std::size_t a, std::size_t b) const {
    int count = 0;
    for (const BoardView& left : views_)
        for (const BoardView& right : views_)
            count += left.camera == int(a) && right.camera == int(b) && left.place == right.place;
    return count;
}

Vec3 BoardSession::span_m(const RigSolution& solution) {
    if (!solution.converged || solution.reference_from_board.empty())
        return {};
    Vec3 low = solution.reference_from_board[0].translation, high = low;
    for (const Pose& board : solution.reference_from_board) {
        const Vec3 at = board.translation;
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
    }
    return high - low;
}

std::string BoardSession::next_step(const RigSolution& solution, int least) const {
    const auto quoted = [&](std::size_t camera) { return "'" + cameras_[camera].about.name + "'"; };
    // A camera that nothing joins comes first, then the one with the fewest views.
    std::size_t needy = 0;
    for (std::size_t c = 1; c < cameras_.size(); ++c)
        if (views(c) < views(needy))
            needy = c;
    if (views(needy) >= least && solution.separate.empty())
        return "";
    if (views(needy) > 0 && !solution.separate.empty())
        needy = std::size_t(solution.separate[0]);
    std::size_t partner = needy == 0 ? 1 : 0;
    for (std::size_t c = 0; c < cameras_.size(); ++c)
        if (c != needy && common_places(needy, c) > common_places(needy, partner))
            partner = c;
    if (cameras_.size() < 2)
        return "Hold the board where " + quoted(needy) + " sees it.";
    // The corners come last: not every lens lights them.
    constexpr std::pair<int, const char*> parts[] = {
        {4, "middle"},      {3, "left"},       {5, "right"},
        {1, "upper part"},  {7, "lower part"}, {0, "upper left"},
        {2, "upper right"}, {6, "lower left"}, {8, "lower right"}};
    const std::set<int> covered = covered_ninths(needy);
    std::string part;
    for (const auto& [ninth, name] : parts)
        if (part.empty() && !covered.contains(ninth))
            part = std::string(", in the ") + name + " of the picture of " + quoted(needy);
    return "Next: hold the board where " + quoted(needy) + " and " + quoted(partner) +
           " both see it" + part + ".";
}

std::vector<BoardSession::Pair> BoardSession::pairs(const RigSolution& solution) const {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < cameras_.size(); ++a)
        for (std::size_t b = a + 1; b < cameras_.size(); ++b) {
            Pair pair{a, b, 0, 0};
            double square = 0;
            for (const BoardView& left : views_)
                for (const BoardView& right : views_) {
                    if (left.camera != int(a) || right.camera != int(b) ||
                        left.place != right.place)
                        continue;
                    ++pair.places;
                    if (!solution.converged)
                        continue;
                    const double apart =
                        corner_distance_m(target_,
                                          solution.cameras[a].reference_from_camera *
                                              left.detection.camera_from_board,
                                          solution.cameras[b].reference_from_camera *
                                              right.detection.camera_from_board);
                    square += apart * apart;
                }
            pair.apart_m = pair.places > 0 ? std::sqrt(square / pair.places) : 0;
            pairs.push_back(pair);
        }
    return pairs;
}

bool BoardSession::is_complete(const RigSolution& solution, int least) const {
    for (std::size_t c = 0; c < cameras_.size(); ++c)
        if (views(c) < least)
            return false;
    return solution.separate.empty();
}

double BoardSession::mean_unit_mm(std::size_t camera) const {
    return cameras_[camera].about.depth_unit_mm / FrameMean::finer;
}

RigSolution BoardSession::solve() const {
    return solve_rig(int(cameras_.size()), int(places_.size()), views_, target_);
}

std::string BoardSession::problem(const RigSolution& solution) const {
    if (views_.empty())
        return "No camera saw the board held still. Hold the whole board still for two seconds, 1 "
               "to "
               "3.5 m in front of the cameras, free of other things, and check that --board and "
               "--thickness are those of your board.";
    for (std::size_t c = 0; c < cameras_.size(); ++c)
        if (views(c) == 0)
            return "The camera '" + cameras_[c].about.name +
                   "' never saw the board. Hold it where this camera and another one see it, or "
                   "leave the camera out.";
    if (!solution.separate.empty())
        return "No place of the board joins the camera '" +
               cameras_[std::size_t(solution.separate[0])].about.name + "' to '" +
               cameras_[0].about.name +
               "'. Hold the board still where both see it, or each together with a third.";
    std::vector<double> smaller;
    for (const BoardView& view : views_)
        smaller.push_back(smaller_by(view.detection.fit));
    std::nth_element(smaller.begin(), smaller.begin() + long(smaller.size() / 2), smaller.end());
    const double usual = smaller[smaller.size() / 2];
    if (std::abs(usual) > believable_scale)
        return "The board is " + percent(usual) + (usual > 0 ? " smaller" : " larger") +
               " than was said. Measure it, and give its size with --board WIDTHxHEIGHT:BAR in "
               "centimetres, or cut it at true scale.";
    if (!solution.converged)
        return "The views of the board fit no arrangement of the cameras. Begin again, and keep "
               "the "
               "cameras still.";
    std::vector<double> errors = solution.view_error_m;
    std::nth_element(errors.begin(), errors.begin() + long(errors.size() / 2), errors.end());
    if (errors[errors.size() / 2] > believable_error_m)
        return "The cameras do not agree on where the board was: half of the views are more than "
               "10 "
               "mm off. Begin again, keep the cameras still, and hold the board still until its "
               "view is taken.";
    return "";
}

}  // namespace theatron::registration
