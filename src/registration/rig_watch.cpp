// SPDX-License-Identifier: Apache-2.0
#include "registration/rig_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace theatron::registration {
namespace {

// Together all cameras take less than 2 % of a core.
constexpr Duration least_period = std::chrono::milliseconds(500),
                   time_for_each = std::chrono::milliseconds(125);
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
constexpr double cleared_share = 0.6;     // of the alarm's size
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

// Root mean square of the lengths by which `motion` moves the points.
double size_m(const Pose& motion, const std::vector<PointOnPlane>& points) {
    double squares = 0;
    for (const PointOnPlane& p : points) {
        const Vec3 shift = motion * p.at - p.at;
        squares += dot(shift, shift) / double(points.size());
    }
    return std::sqrt(squares);
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
                           {},
                           {},
                           0,
                           0,
                           0,
                           0,
                           0,
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
    state.newest_motion = {};
    state.above = state.below = state.unclear = state.denied = 0;
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
    for (std::size_t i = 0; i < grid.size(); ++i) {
        SurfacePoint& point = reference.points[i];
        const double n = std::max(1, reference.counts[i]);
        const Vec3 mean = point.at * (1 / n);
        const double variance = reference.squares[i] / n - mean.z * mean.z;
        const bool is_static = reference.counts[i] >= least_reference_images &&
                               variance < static_spread_m * static_spread_m;
        point = is_static ? SurfacePoint{mean, normalized(point.normal)} : SurfacePoint{};
    }
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
    const Pose moved = inverse(*corrected.about.room_from_camera) *
                       corrected.motion.room_from_camera.value_or(Pose{});
    corrected.about.room_from_camera = room_from_camera;
    corrected.motion.room_from_camera = room_from_camera * moved;
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
    motion.is_known = found.points >= least_points && found.share >= least_share;
    if (!motion.is_known) {
        // Too much of the scene has changed: what stands still now is the new reference.
        if (++state.unclear >= evaluations_to_renew)
            renew_reference(state);
        return;
    }
    state.unclear = 0;
    if (found.size_m >= alarm_m && !motion.is_alarm && overlaps_deny(camera, found.motion)) {
        if (++state.denied >= evaluations_to_renew)
            renew_reference(state);
        return;
    }
    state.denied = 0;
    state.newest_motion = found.motion;
    const Pose total = state.carried * found.motion;
    motion.moved_m = size_m(total, points);
    motion.turned_deg = angle_deg(total);
    if (state.about.room_from_camera)
        motion.room_from_camera = *state.about.room_from_camera * total;
    state.above = motion.moved_m >= alarm_m ? state.above + 1 : 0;
    state.below = motion.moved_m < cleared_share * alarm_m ? state.below + 1 : 0;
    if (state.above * period_ >= time_to_alarm)
        motion.is_alarm = true;
    if (state.below >= evaluations_to_clear)
        motion.is_alarm = false;
}

// A camera that was moved stays moved.
void RigWatch::renew_reference(State& state) {
    state.carried = state.motion.is_alarm ? state.carried * state.newest_motion : Pose{};
    begin_reference(state);
}

// If the camera moved, distances in its overlaps have changed by the motion's part along the
// normals; if the scene did, they have not.
bool RigWatch::overlaps_deny(std::size_t camera, const Pose& reference_from_now) const {
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
        return false;
    return weighted / weights < 0.4;
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
