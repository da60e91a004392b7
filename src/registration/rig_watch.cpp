// SPDX-License-Identifier: Apache-2.0
#include "registration/rig_watch.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace theatron::registration {
namespace {

// Together all cameras take less than 2 % of a core, and with up to eight an alarm comes within
// 10 s.
constexpr Duration least_period = std::chrono::milliseconds(500),
                   time_for_each = std::chrono::milliseconds(200);
constexpr int reference_images = 16, least_reference_images = 11;
constexpr std::size_t window_images = 4;
constexpr double static_spread_m = 0.004;  // deviation of a surface that stands still
constexpr double static_spread_px = 1.5;   // an edge that stands still, from lowest to highest
constexpr double farthest_change_m = 0.1;
constexpr double on_plane_m = 0.004;
constexpr std::size_t least_points = 150;
constexpr double least_share = 0.5;
constexpr int evaluations_to_clear = 3, evaluations_to_renew = 40, comparisons_to_alarm = 6;
// People who lean slowly look like a motion for a second or two.
constexpr Duration time_to_alarm = std::chrono::seconds(4);
constexpr Duration time_to_lose = std::chrono::seconds(5), time_to_cover = std::chrono::seconds(8);
// A place is gone if what is measured there is farther by this, and by this share of the distance.
constexpr double gone_m = 0.1, gone_share_of_z = 0.05;
// The camera may have been moved from these shares of the reference's surfaces on.
constexpr double least_gone = 0.1, least_displaced = 0.3;
// Surfaces nearer than this share of the reference's distance are of something that covers it.
constexpr double nearest_displaced = 0.6;
// The smallest eigenvalue of the mean of n n^T over the normals that agree: below, there is a
// direction in which the camera can have moved.
constexpr double least_spread = 0.03;
constexpr double least_measured = 0.02;  // of the picture, of a camera that sees something
constexpr double cleared_share = 0.6;    // of the alarm's size
// Changes of this size tell whether a point has moved; a point within this share of either is told.
constexpr double least_told_m = 0.003, told_share = 0.25;
constexpr double least_rest = 0.05;  // of the points that are told
constexpr std::size_t least_rest_points = 40;
// Motions of two cameras in the room that differ by less are one: metres, and share of the size.
constexpr double alike_m = 0.002, alike_share = 0.3;
constexpr double overlap_reach_m = 0.15;  // larger distances are other surfaces
constexpr double base_reach_m = 0.04;
constexpr std::size_t least_overlap = 80;
constexpr double smoothing = 0.2;  // of a pair's distance

double angle_deg(const Pose& pose) {
    const Quat& q = pose.rotation;
    return 2 * std::asin(std::min(1.0, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z))) /
           radians_of(1);
}

// The lowest, highest and mean value of something over some images.
struct Spread {
    double lowest = 1e9, highest = -1e9, sum = 0;
    int count = 0;

    void add(double value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
        sum += value;
        ++count;
    }
    double size() const { return highest - lowest; }
    double mean() const { return sum / count; }
};

// True if the points that lie on their planes after `motion` fix a camera in all directions.
bool fixes_all_directions(const Pose& motion, const std::vector<PointOnPlane>& points) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double count = 0;
    for (const PointOnPlane& p : points) {
        const Vec3 shift = motion * p.at - p.at;
        if (std::abs(p.apart_m + dot(p.normal, shift)) >= on_plane_m)
            continue;
        const Eigen::Vector3d n(p.normal.x, p.normal.y, p.normal.z);
        sum += n * n.transpose();
        ++count;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(sum, Eigen::EigenvaluesOnly);
    return count > 0 && solver.eigenvalues()[0] >= least_spread * count;
}

// Root mean square of the lengths by which `motion` moves the points.
double size_m(const Pose& motion, const std::vector<PointOnPlane>& points) {
    double squares = 0;
    for (const PointOnPlane& p : points) {
        const Vec3 shift = motion * p.at - p.at;
        squares += dot(shift, shift) / double(points.size());
    }
    return std::sqrt(squares);
}

// True if part of the points stands where it was although a camera that moved by `motion` would see
// it elsewhere, and if that part is behind what did move: the room is behind what moves in it, and
// what is fixed to the camera, and so moves with it, is before the room.
bool rest_stands_still(const Pose& motion, const std::vector<PointOnPlane>& points) {
    std::size_t still = 0, moved = 0;
    double still_z = 0, moved_z = 0;
    for (const PointOnPlane& p : points) {
        const double expected = -dot(p.normal, motion * p.at - p.at);
        const double tolerance = std::min(on_plane_m, told_share * std::abs(expected));
        if (std::abs(expected) < least_told_m)
            continue;
        if (std::abs(p.apart_m) < tolerance) {
            ++still;
            still_z += p.at.z;
        } else if (std::abs(p.apart_m - expected) < tolerance) {
            ++moved;
            moved_z += p.at.z;
        }
    }
    return still >= least_rest_points && double(still) >= least_rest * double(still + moved) &&
           still_z * double(moved) >= moved_z * double(still);
}

}  // namespace

// The mean surfaces of the recent images, where they were there in all of them and stood still.
void RigWatch::add_surface_changes(const State& state, std::vector<PointOnPlane>& points) {
    const std::vector<SurfacePoint>& reference = state.reference.points;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (!reference[i].is_valid())
            continue;
        Vec3 mean{};
        Spread z;
        bool all = true;
        for (const Observation& seen : state.recent) {
            all = all && seen.surface[i].is_valid();
            mean = mean + seen.surface[i].at * (1.0 / double(state.recent.size()));
            z.add(seen.surface[i].at.z);
        }
        if (!all || z.size() > 3 * static_spread_m)
            continue;
        const double apart = dot(reference[i].normal, mean - reference[i].at);
        if (std::abs(apart) < farthest_change_m)
            points.push_back({mean, reference[i].normal, apart});
    }
}

// The same for the edges.
void RigWatch::add_edge_changes(const State& state, std::vector<PointOnPlane>& points) {
    for (std::size_t i = 0; i < state.reference.edges.size(); ++i) {
        const DepthEdge& edge = state.reference.edges[i];
        Spread position;
        for (const Observation& seen : state.recent)
            if (!std::isnan(seen.edges[i]))
                position.add(seen.edges[i]);
        Vec3 mean;
        if (position.count < int(state.recent.size()) || position.size() > static_spread_px ||
            !edge_point(edge, float(position.mean()), state.surface, mean))
            continue;
        points.push_back({mean, edge.normal, dot(edge.normal, mean - edge.at)});
    }
}

RigWatch::RigWatch(const std::vector<Camera>& cameras)
    : period_(std::max(least_period, time_for_each * long(cameras.size()))) {
    for (const Camera& camera : cameras) {
        states_.push_back({camera,
                           SurfaceCamera(camera.depth, camera.depth_unit_mm),
                           {},
                           {},
                           {},
                           {},
                           {},
                           0,
                           0,
                           0,
                           0,
                           0,
                           0,
                           0,
                           {},
                           false,
                           {},
                           {}});
        states_.back().surface.bias.offset_m = camera.depth_offset_m;
        states_.back().motion.room_from_camera = camera.room_from_camera;
        begin_reference(states_.back());
    }
}

void RigWatch::begin_reference(State& state) {
    const std::size_t cells = surface_grid_size(state.about.depth.size).area();
    state.reference = {};
    state.reference.points.resize(cells);
    state.reference.squares.resize(cells);
    state.reference.counts.resize(cells);
    state.reference.edge_sums.emplace(state.about.depth.size);
    state.base.clear();
    state.recent.clear();
    state.above = state.below = state.matched = state.denied = state.gone = state.hidden = 0;
    state.stands_still = false;
    state.moving_since.reset();
}

bool RigWatch::is_due(std::size_t camera, TimePoint captured) const {
    const TimePoint last = states_[camera].captured;
    return last == TimePoint{} || captured - last >= period_ || captured < last;
}

void RigWatch::add(std::size_t camera, DepthView depth, TimePoint captured) {
    State& state = states_[camera];
    if (!(depth.size == state.about.depth.size))
        return;
    // Images before and after a pause do not belong to one window.
    if (captured < state.captured || captured - state.captured > 4 * period_)
        state.recent.clear();
    state.captured = captured;
    state.newest.resize(depth.size);
    copy_pixels(depth, state.newest.view());
    std::vector<SurfacePoint> grid = surface_grid(state.surface, depth);
    if (state.about.room_from_camera)
        compare_with_other(camera, grid);
    if (state.reference.images < reference_images)
        return add_to_reference(camera, grid, depth);
    state.recent.push_back({std::move(grid), edge_positions(state.reference.edges, depth)});
    if (state.recent.size() > window_images)
        state.recent.pop_front();
    if (state.recent.size() == window_images)
        compare_with_reference(camera);
}

void RigWatch::add_to_reference(std::size_t camera, const std::vector<SurfacePoint>& grid,
                                DepthView depth) {
    State& state = states_[camera];
    Reference& reference = state.reference;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (!grid[i].is_valid())
            continue;
        SurfacePoint& sum = reference.points[i];
        sum.at = sum.at + grid[i].at;
        sum.normal = sum.normal + grid[i].normal;
        reference.squares[i] += grid[i].at.z * grid[i].at.z;
        ++reference.counts[i];
    }
    reference.edge_sums->add(depth);
    if (++reference.images < reference_images)
        return;
    reference.edges = reference.edge_sums->edges(state.surface, static_spread_m);
    reference.edge_sums.reset();
    std::size_t surfaces = 0;
    double measured = 0;  // cells, on average
    for (std::size_t i = 0; i < grid.size(); ++i) {
        measured += double(reference.counts[i]) / reference_images;
        SurfacePoint& point = reference.points[i];
        const double n = std::max(1, reference.counts[i]);
        const Vec3 mean = point.at * (1 / n);
        const double variance = reference.squares[i] / n - mean.z * mean.z;
        const bool is_static = reference.counts[i] >= least_reference_images &&
                               variance < static_spread_m * static_spread_m;
        point = is_static ? SurfacePoint{mean, normalized(point.normal)} : SurfacePoint{};
        surfaces += is_static;
    }
    // A camera that sees nothing has nothing to be compared with.
    if (surfaces < least_points) {
        const bool sees_nothing = measured < least_measured * double(grid.size());
        begin_reference(state);
        state.motion.is_covered = sees_nothing;
        return;
    }
    state.motion.is_covered = false;
    state.complete_since = state.captured;
    note_base(camera);
}

// The overlaps of a complete reference.
void RigWatch::note_base(std::size_t camera) {
    State& state = states_[camera];
    state.base.clear();
    if (!state.about.room_from_camera)
        return;
    for (std::size_t other = 0; other < states_.size(); ++other)
        if (other != camera && states_[other].about.room_from_camera &&
            !states_[other].newest.empty())
            state.base.push_back({other, overlap(state.reference.points, states_[other].surface,
                                                 std::as_const(states_[other].newest).view(),
                                                 between(other, camera), base_reach_m)});
}

void RigWatch::correct_place(std::size_t camera, const Pose& room_from_camera) {
    State& corrected = states_[camera];
    if (!corrected.about.room_from_camera)
        return;
    std::optional<Pose>& now = corrected.motion.room_from_camera;
    if (now)
        now = room_from_camera * (inverse(*corrected.about.room_from_camera) * *now);
    corrected.about.room_from_camera = room_from_camera;
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (states_[i].reference.images >= reference_images)
            note_base(i);
    for (std::size_t i = pairs_.size(); i-- > 0;)
        if (pairs_[i].a == camera || pairs_[i].b == camera) {
            pairs_.erase(pairs_.begin() + std::ptrdiff_t(i));
            pair_above_.erase(pair_above_.begin() + std::ptrdiff_t(i));
        }
}

Pose RigWatch::between(std::size_t to, std::size_t from) const {
    return inverse(*states_[to].about.room_from_camera) * *states_[from].about.room_from_camera;
}

void RigWatch::compare_with_reference(std::size_t camera) {
    State& state = states_[camera];
    Motion& motion = state.motion;
    std::vector<PointOnPlane> points;
    add_surface_changes(state, points);
    add_edge_changes(state, points);
    const SmallMotion found = fit_small_motion(points, on_plane_m);
    const Change change = change_of(state);
    motion.is_known = found.points >= least_points && found.share >= least_share &&
                      (change.gone < least_gone || fixes_all_directions(found.motion, points));
    state.stands_still = false;
    if (!motion.is_known)
        return on_mismatch(state, change);
    on_match(state);
    if (found.size_m < alarm_m)
        state.moving_since.reset();
    else if (!state.moving_since)
        state.moving_since = state.captured;
    const bool rest_is_still = state.moving_since && rest_stands_still(found.motion, points);
    state.stands_still = rest_is_still || found.size_m < cleared_share * alarm_m;
    if (state.moving_since && !motion.is_alarm) {
        const Mover mover = told_by_overlaps(camera, found.motion);
        if (mover == Mover::scene || (mover == Mover::unknown && rest_is_still)) {
            if (++state.denied >= evaluations_to_renew) {
                ++motion.renewals;
                begin_reference(state);
            }
            return;
        }
    }
    state.denied = 0;
    motion.moved_m = size_m(found.motion, points);
    motion.turned_deg = angle_deg(found.motion);
    if (state.about.room_from_camera)
        motion.room_from_camera = *state.about.room_from_camera * found.motion;
    state.above = motion.moved_m >= alarm_m ? state.above + 1 : 0;
    state.below = motion.moved_m < cleared_share * alarm_m ? state.below + 1 : 0;
    if (state.above * period_ >= time_to_alarm)
        motion.is_alarm = true;
    if (state.below >= evaluations_to_clear) {
        motion.is_alarm = false;
        motion.together_with.reset();
    }
    if (motion.is_alarm && !motion.together_with)
        motion.together_with = moved_alike(camera);
}

RigWatch::Change RigWatch::change_of(const State& state) {
    const Size size = surface_grid_size(state.about.depth.size);
    const DepthView depth = state.newest.view();
    Change change;
    double surfaces = 0;
    for (std::size_t i = 0; i < state.reference.points.size(); ++i) {
        const SurfacePoint& point = state.reference.points[i];
        if (!point.is_valid())
            continue;
        ++surfaces;
        const int x = int(i % std::size_t(size.width)), y = int(i / std::size_t(size.width));
        const std::uint16_t units =
            depth.row(y * surface_step + surface_step / 2)[x * surface_step + surface_step / 2];
        const double z = units * state.about.depth_unit_mm / 1000;
        change.gone += z > point.at.z + std::max(gone_m, gone_share_of_z * point.at.z);
        Spread now;
        for (const Observation& seen : state.recent)
            if (seen.surface[i].is_valid())
                now.add(seen.surface[i].at.z);
        if (now.count < int(state.recent.size()) || now.size() > 3 * static_spread_m ||
            now.mean() < nearest_displaced * point.at.z)
            continue;
        const double apart = dot(point.normal, state.recent.back().surface[i].at - point.at);
        (std::abs(apart) < 2 * on_plane_m ? change.agreeing : change.displaced) += 1;
    }
    for (double* share : {&change.gone, &change.displaced, &change.agreeing})
        *share /= std::max(1.0, surfaces);
    return change;
}

void RigWatch::on_match(State& state) {
    state.hidden = 0;
    state.motion.is_covered = false;
    if (++state.matched < evaluations_to_clear)
        return;
    state.motion.is_far = false;
    state.gone = 0;
}

void RigWatch::on_mismatch(State& state, const Change& change) {
    Motion& motion = state.motion;
    state.below = state.matched = 0;
    ++state.hidden;
    const bool is_moved = change.gone >= least_gone || (change.displaced >= least_displaced &&
                                                        change.displaced > change.agreeing);
    if (is_moved && !state.moving_since)
        state.moving_since = state.captured;
    state.above = is_moved ? state.above + 1 : 0;
    state.gone = is_moved ? state.gone + 1 : std::max(0, state.gone - 1);
    if (state.gone * period_ >= time_to_lose) {
        motion.is_alarm = motion.is_far = true;
        motion.moved_m = far_m;
        motion.turned_deg = 0;
        motion.together_with.reset();
        motion.room_from_camera.reset();
    }
    motion.is_covered = !motion.is_far && state.hidden * period_ >= time_to_cover;
}

void RigWatch::accept_place(std::size_t camera) {
    State& state = states_[camera];
    const int renewals = state.motion.renewals;
    state.motion = {};
    state.motion.renewals = renewals;
    state.motion.room_from_camera = state.about.room_from_camera;
    begin_reference(state);
}

// A camera that has stood still since before the other one's picture began to move.
bool RigWatch::is_witness(const State& other, const State& of) const {
    return other.stands_still && of.moving_since && other.complete_since < *of.moving_since &&
           of.captured - other.captured <= 4 * period_;
}

// Another camera whose place in the room changed by the same motion at the same time.
std::optional<std::size_t> RigWatch::moved_alike(std::size_t camera) const {
    const auto motion_in_room = [](const State& state) {
        return *state.motion.room_from_camera * inverse(*state.about.room_from_camera);
    };
    const State& state = states_[camera];
    if (!state.motion.room_from_camera)
        return {};
    const Pose own = motion_in_room(state);
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const State& other = states_[i];
        if (i == camera || !state.moving_since || !other.moving_since ||
            !other.motion.room_from_camera ||
            std::chrono::abs(*state.moving_since - *other.moving_since) > time_to_alarm)
            continue;
        const Pose its = motion_in_room(other);
        double squares = 0, apart_squares = 0;
        int count = 0;
        for (const State* seen_by : {&state, &other})
            for (const SurfacePoint& point : seen_by->reference.points)
                if (point.is_valid()) {
                    const Vec3 at = *seen_by->about.room_from_camera * point.at;
                    const Vec3 shift = own * at - at, apart = own * at - its * at;
                    squares += dot(shift, shift);
                    apart_squares += dot(apart, apart);
                    ++count;
                }
        const double size = std::sqrt(squares / std::max(1, count));
        if (std::sqrt(apart_squares / std::max(1, count)) < std::max(alike_m, alike_share * size))
            return i;
    }
    return {};
}

// If the camera moved, distances in its overlaps have changed by the motion's part along the
// normals; if the scene did, they have not.
RigWatch::Mover RigWatch::told_by_overlaps(std::size_t camera,
                                           const Pose& reference_from_now) const {
    const State& state = states_[camera];
    const auto mean_of = [&](const std::vector<OverlapPoint>& points, std::size_t other,
                             double& information, double& square) {
        const Pose other_from_camera = between(other, camera), back = inverse(other_from_camera);
        double product = 0, predicted = 0;
        square = 0;
        for (const OverlapPoint& point : points) {
            const Vec3 at = back * point.at;
            const double change =
                dot(point.normal, rotate(other_from_camera.rotation, at - reference_from_now * at));
            product += change * point.apart_m;
            predicted += change * change;
            square += point.apart_m * point.apart_m;
        }
        information = predicted;
        square /= std::max<double>(1, double(points.size()));
        return predicted > 0 ? product / predicted : 0;
    };
    double weighted = 0, weights = 0;
    for (const BaseOverlap& base : state.base) {
        if (base.points.size() < least_overlap)
            continue;
        const State& other = states_[base.other];
        if (!is_witness(other, state))
            continue;
        const auto now = overlap(state.recent.back().surface, other.surface, other.newest.view(),
                                 between(base.other, camera), base_reach_m);
        if (now.size() < least_overlap)
            continue;
        double information_before = 0, information_now = 0, square_before = 0, square_now = 0;
        const double before = mean_of(base.points, base.other, information_before, square_before);
        const double after = mean_of(now, base.other, information_now, square_now);
        // Neighbouring points share their errors, so that each counts for a tenth.
        const double variance = 10 * (square_before / std::max(information_before, 1e-12) +
                                      square_now / std::max(information_now, 1e-12));
        weighted += (after - before) / variance;
        weights += 1 / variance;
    }
    constexpr double well_known = 0.25;  // deviation of the share that moved
    if (weights < 1 / (well_known * well_known))
        return Mover::unknown;
    return weighted / weights < 0.4 ? Mover::scene : Mover::camera;
}

void RigWatch::compare_with_other(std::size_t camera, const std::vector<SurfacePoint>& grid) {
    State& state = states_[camera];
    for (std::size_t tries = 0; tries < states_.size(); ++tries) {
        state.next_other = (state.next_other + 1) % states_.size();
        const std::size_t other = state.next_other;
        // Pictures of a camera that stopped say nothing about now.
        if (other == camera || !states_[other].about.room_from_camera ||
            states_[other].newest.empty() || state.captured - states_[other].captured > 4 * period_)
            continue;
        const auto points = overlap(grid, states_[other].surface, states_[other].newest.view(),
                                    between(other, camera), overlap_reach_m);
        const std::size_t a = std::min(camera, other), b = std::max(camera, other);
        auto pair = std::find_if(pairs_.begin(), pairs_.end(),
                                 [&](const Pair& p) { return p.a == a && p.b == b; });
        if (pair == pairs_.end()) {
            if (points.size() < least_overlap)
                return;
            pairs_.push_back({a, b, median_apart_m(points), 0, false});
            pair_above_.push_back(0);
            pair = pairs_.end() - 1;
        }
        pair->points = points.size();
        if (points.size() < least_overlap)
            return;
        pair->apart_m += smoothing * (median_apart_m(points) - pair->apart_m);
        int& above = pair_above_[std::size_t(pair - pairs_.begin())];
        above = pair->apart_m > wrong_apart_m ? above + 1 : 0;
        pair->is_alarm = above >= comparisons_to_alarm;
        return;
    }
}

const RigWatch::Pair* RigWatch::wrong_pair(std::size_t camera) const {
    const auto found = std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
        return pair.is_alarm && (pair.a == camera || pair.b == camera);
    });
    return found == pairs_.end() ? nullptr : &*found;
}

}  // namespace theatron::registration
