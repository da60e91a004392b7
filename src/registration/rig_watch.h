// SPDX-License-Identifier: Apache-2.0
// Notices, while cameras stream, that one of them was moved, or that their places do not fit.
//
// A camera's own picture tells a motion best: the errors of a depth sensor are the same before and
// after, so the static part of the picture is compared with what it was when the watch began, and
// the rigid motion between them is fitted. Surfaces show a motion along their normals, and their
// ends before something farther away show the others. A part of the scene that moves as one (a
// table that is raised) may fit as well. The overlaps with cameras that stand still decide then:
// they change if the camera was moved, and stay as they are if the scene was. Cameras that moved at
// the same time decide nothing: on one arm they keep their overlap. Without a witness the rest of
// the picture decides: a room that stands where it was, behind what moved, shows that the scene
// moved. If there is no such rest, the camera has moved. The overlaps also give the figure by which
// the cameras' places differ now, for each pair.
//
// A motion that is too large to be fitted shows places farther away than what stood there before:
// nothing that comes before a camera can do that. Where all is nearer, or nothing is measured,
// something covers the camera. The reference stays as it is in both cases, so that a camera that is
// put back, or uncovered, is seen to be in its place.
//
// Pure and without threads. 1 to 3 ms of work for each image of 640 x 576 pixels; the test
// Watching.NoAlarm* prints how much.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "base/time.h"
#include "registration/depth_edges.h"
#include "registration/small_motion.h"
#include "registration/surface_grid.h"

namespace theatron::registration {

class RigWatch {
public:
    // Motions from here on raise the alarm, and the distance of overlaps from which the places are
    // wrong, metres: above the differences of good cameras' depth errors.
    static constexpr double alarm_m = 0.0035, wrong_apart_m = 0.012;
    // Motions that are too large to be measured are larger than this.
    static constexpr double far_m = 0.03;

    struct Camera {
        CameraModel depth;
        double depth_unit_mm = 1;
        std::optional<Pose> room_from_camera;  // empty: unknown; then only its motion is watched
        double depth_offset_m = 0;             // saved with the place: by which depth is too large
    };
    explicit RigWatch(const std::vector<Camera>& cameras);

    // The time from one image of a camera to the next: half a second, or more for many cameras.
    Duration period() const { return period_; }
    // True if an image captured at this time is wanted; the others are better not added.
    bool is_due(std::size_t camera, TimePoint captured) const;
    // `depth` as measured, of the camera's size, before any correction. Times of a camera grow.
    void add(std::size_t camera, DepthView depth, TimePoint captured);

    // Somebody has corrected the place of a camera that had one. The state of its own picture
    // stays, and the distances of its overlaps begin anew.
    void correct_place(std::size_t camera, const Pose& room_from_camera);

    // Somebody says that the camera's place is right as it is now: what it sees from now on is
    // what it is compared with, and an alarm of its own picture ends.
    void accept_place(std::size_t camera);

    struct Motion {
        bool is_known = false;  // enough of the picture stands still
        bool is_alarm = false;
        bool is_far = false;                 // too large to be measured; always an alarm
        bool is_covered = false;             // nothing of the reference is seen, for some time
        double moved_m = 0, turned_deg = 0;  // since the watch began; far_m and 0 if `is_far`
        // Where the camera is now; empty where its place was not known, or is not any more.
        std::optional<Pose> room_from_camera;
        // With an alarm: another camera that was moved in the same way at the same time. Both stand
        // on one thing that was moved, or everything that they see was.
        std::optional<std::size_t> together_with;
        // How often the scene has moved as one, so that the camera is compared with what it sees
        // since then.
        int renewals = 0;
    };
    const Motion& motion(std::size_t camera) const { return states_[camera].motion; }

    struct Pair {
        std::size_t a = 0, b = 0;
        double apart_m = 0;      // median distance of the surfaces that both see
        std::size_t points = 0;  // of the last comparison; few: they share no view
        bool is_alarm = false;
    };
    // The pairs of cameras with known places that share a view.
    const std::vector<Pair>& pairs() const { return pairs_; }

    // One of them with the alarm that this camera belongs to; null if there is none.
    const Pair* wrong_pair(std::size_t camera) const;

private:
    struct Reference {
        // Sums over images, then means.
        std::vector<SurfacePoint> points;
        std::vector<double> squares;  // of z
        std::vector<int> counts;
        std::optional<EdgeReference> edge_sums;  // until it is complete
        std::vector<DepthEdge> edges;
        int images = 0;
    };
    // The surfaces and edges of one image behind the reference.
    struct Observation {
        std::vector<SurfacePoint> surface;
        std::vector<float> edges;  // positions
    };
    // Overlap with another camera when the reference was complete.
    struct BaseOverlap {
        std::size_t other = 0;
        std::vector<OverlapPoint> points;
    };
    struct State {
        Camera about;
        SurfaceCamera surface;
        DepthImage newest;
        TimePoint captured{};
        Reference reference;
        std::vector<BaseOverlap> base;
        std::deque<Observation> recent;
        int above = 0, below = 0, matched = 0, hidden = 0, denied = 0;  // evaluations in a row
        int gone = 0;  // unmatched evaluations that show a motion, less those that do not
        std::size_t next_other = 0;
        TimePoint complete_since{};  // the reference
        // Its own picture shows that it stands where it stood: all of it, or the room behind
        // something that moved.
        bool stands_still = false;
        std::optional<TimePoint> moving_since;  // in all evaluations since then
        Motion motion;
    };

    static void begin_reference(State& state);
    // Shares of the reference's surfaces.
    struct Change {
        double gone = 0;       // something farther away is measured there now
        double displaced = 0;  // a surface stands still there, elsewhere than it was
        double agreeing = 0;   // stands where it was
    };
    static Change change_of(const State& state);
    static void on_match(State& state);
    void on_mismatch(State& state, const Change& change);
    void add_to_reference(std::size_t camera, const std::vector<SurfacePoint>& grid,
                          DepthView depth);
    static void add_surface_changes(const State& state, std::vector<PointOnPlane>& points);
    static void add_edge_changes(const State& state, std::vector<PointOnPlane>& points);
    void note_base(std::size_t camera);
    void compare_with_reference(std::size_t camera);
    // The cause of a motion that a camera's picture shows.
    enum class Mover { camera, scene, unknown };
    Mover told_by_overlaps(std::size_t camera, const Pose& reference_from_now) const;
    bool is_witness(const State& other, const State& of) const;
    std::optional<std::size_t> moved_alike(std::size_t camera) const;
    void compare_with_other(std::size_t camera, const std::vector<SurfacePoint>& grid);
    Pose between(std::size_t to, std::size_t from) const;

    Duration period_;
    std::vector<State> states_;
    std::vector<Pair> pairs_;
    std::vector<int> pair_above_;  // evaluations in a row, by pair
};

}  // namespace theatron::registration
