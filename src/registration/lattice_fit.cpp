// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "registration/background_depth.h"
#include "registration/edge_prediction.h"
#include "registration/plane_evidence.h"

namespace theatron::registration {
namespace {

// A round fits the plane, then the edges. Coverage goes from 0 to 1 over some pixels, first over
// more because the match is only good to a centimetre.
struct Round {
    double least_ramp_m;
    double spacing_m;  // on the face; where pixels are finer, some rows and columns are left out
    int steps;
};
constexpr std::array<Round, 3> rounds{{{0.014, 0.01, 2}, {0.007, 0.01, 2}, {0, 0.0045, 2}}};
constexpr int last_steps = 2;  // of the edges, with the pixels of the last round
constexpr double ramp_pixels = 3;
constexpr double moves_in_round_m = 0.003;
constexpr double free_of_edges_pixels = 3;  // pixels that show the plane alone
constexpr int least_plane_pixels = 200, least_edge_pixels = 100;
constexpr double mixed_m = 0.04;     // most that a background pulls a mixed pixel off the board
constexpr double farthest_m = 0.04;  // from the match
// Standard deviations of the priors.
constexpr double prior_growth_m = 0.002, prior_log_background = 0.7;
constexpr double prior_turn = 0.2, prior_shift_m = 0.2;  // keep far views solvable
// Standard deviation of a pixel's seen share. Noise is smooth over some pixels: this number of
// pixels counts as one measurement.
constexpr double share_sigma = 0.16;
constexpr double pixels_per_measurement = 8, edge_pixels_per_measurement = 4;
// Errors of the edges that more pixels do not lower: the model of coverage is not exact.
constexpr double unmodelled_pixels = 0.02;
// The same where no computed image matches, as of a sensor that is none of time of flight: its
// edges may all lie further out, or further in, than was expected.
constexpr double unmatched_pixels = 0.15;

constexpr int measuring_steps = 16;
constexpr double measured_growth_m = 0.0003;  // as prior_growth_m, for a computed image
// A pose whose image has a larger difference is not used. The difference gives the variance of the
// others, relative to that of a fitted pose.
constexpr double largest_measured_rms = 0.22;
double measured_variance(double rms) {
    return 0.15 * std::pow(std::max(rms, 0.08) / 0.1, 4);
}

constexpr int pose_count = 6, param_count = 9;
using VectorAll = Eigen::Matrix<double, param_count, 1>;
using MatrixAll = Eigen::Matrix<double, param_count, param_count>;

// A pixel near the board.
struct Spot {
    Vec3 ray;               // camera frame, z = 1
    double ramp_u, ramp_v;  // along the face, over which coverage goes from 0 to 1, metres
    int x, y;               // pixel
    bool is_before_dark;    // its background returns too little light to be measured
    double shown;           // 1: board, 0: background, 0.5: not measured
};

Pose stepped(const Pose& pose, const Eigen::Ref<const Vector6>& step) {
    const Vec3 turn{step[0], step[1], step[2]};
    const double angle = length(turn);
    const Quat rotation = angle > 1e-12 ? rotation_about(turn, angle) : Quat{};
    return pose * Pose{rotation, {step[3], step[4], step[5]}};
}

class Fit {
public:
    Fit(const DepthLookup& depth, const Image<Ray>& rays, const LatticeMatch& match,
        const LatticeTarget& target, FitEffort effort, const DepthTrust& trust)
        : depth_(depth),
          effort_(effort),
          rays_(rays),
          target_(target),
          pattern_(target, match.face),
          trust_(trust),
          face_(match.face),
          start_(match.camera_from_face) {
        result_.camera_from_face = start_;
    }

    std::optional<LatticeFit> run() {
        bool first = true;
        for (const Round& round : rounds) {
            if (!fit_plane(first, round))
                return {};
            SeenEdges seen = edges_from_here();
            find_spots(seen, round);
            if (!fit_edges(seen, round.steps) || is_far_from_match())
                return {};
            first = false;
        }
        if (!fit_edges(edges_from_here(), last_steps) || is_far_from_match())
            return {};
        fill_covariance();
        if (effort_ == FitEffort::measure) {
            const LatticeFit found = result_;
            if (measure_edges())
                fill_measured_covariance();
            else {
                result_ = found;
                doubt_edges();
            }
        }
        return result_;
    }

private:
    // Places on the face that the pixels of a plane see.
    class OnFace {
    public:
        OnFace(const Plane& plane, const Pose& camera_from_face)
            : u_(in_plane(axis_of(camera_from_face, 0), plane, camera_from_face)),
              v_(in_plane(axis_of(camera_from_face, 1), plane, camera_from_face)) {}

        // `on_plane` is the plane's inverse depth for this ray.
        Vec2 at(Ray ray, double on_plane) const {
            const double z = 1 / on_plane;
            return {(u_.x * ray.x + u_.y * ray.y + u_.z) * z,
                    (v_.x * ray.x + v_.y * ray.y + v_.z) * z};
        }

    private:
        static Vec3 in_plane(Vec3 axis, const Plane& plane, const Pose& pose) {
            return axis - plane.q * dot(axis, pose.translation);
        }
        Vec3 u_, v_;
    };

    int step_in(const Round& round) const {
        const double pixel_m = pixel_pitch() * length(result_.camera_from_face.translation);
        return std::max(1, int(round.spacing_m / pixel_m + 0.5));
    }

    // The face's plane from the pixels that show nothing else; and the background's distance.
    bool fit_plane(bool first, const Round& round) {
        const Pose& pose = result_.camera_from_face;
        const Plane before = first ? plane_of(pose) : result_.plane;
        const PixelWindow w = window_of(depth_, pose, target_);
        const OnFace on_face(before, pose);
        const int step = step_in(round);
        const double margin =
            first ? 0.016 : free_of_edges_pixels * pixel_pitch() * length(pose.translation);
        const double per_length = 1 / length(before.q);
        background_ = {};
        Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
        Eigen::Vector3d b = Eigen::Vector3d::Zero();
        double square = 0, square_of_inverse = 0;
        int n = 0;
        for (int y = w.top; y < w.bottom; y += step) {
            const Ray* rays = rays_.view().row(y);
            const std::uint16_t* row = depth_.depth.row(y);
            for (int x = w.left; x < w.right; x += step) {
                if (row[x] == 0 || rays[x].x == no_ray)
                    continue;
                const double on_plane = before.inverse_depth(rays[x]);
                const double z_m = row[x] * depth_.metres_per_unit;
                const double off = (on_plane * z_m - 1) * per_length;
                const double tolerance = plane_tolerance_m(z_m);
                if (on_plane <= 0 || off < -tolerance)
                    continue;
                const bool is_behind = off >= board_reach_m(z_m) + mixed_m;
                if (off > tolerance && !is_behind)
                    continue;
                const Vec2 p = on_face.at(rays[x], on_plane);
                if (is_behind) {
                    background_.add(pattern_, p, z_m);
                    continue;
                }
                if (pattern_.inside(p.x, p.y).solid() < margin)
                    continue;
                const Eigen::Vector3d r(rays[x].x, rays[x].y, 1);
                a += r * r.transpose();
                b += r / z_m;
                square += off * off;
                square_of_inverse += (on_plane - 1 / z_m) * (on_plane - 1 / z_m);
                ++n;
            }
        }
        if (n * step * step < least_plane_pixels)
            return false;
        const Eigen::Vector3d q = a.ldlt().solve(b);
        if (!q.allFinite())
            return false;
        result_.plane = {{q.x(), q.y(), q.z()}};
        result_.plane_covariance = a.inverse() * pixels_per_measurement * square_of_inverse / n;
        result_.plane_pixels = n;
        result_.plane_rms_m = std::sqrt(square / n);
        return true;
    }

    static Plane plane_of(const Pose& pose) {
        const Vec3 z = axis_of(pose, 2);
        return {z * (1 / dot(z, pose.translation))};
    }

    bool is_far_from_match() const {
        return length(result_.camera_from_face.translation - start_.translation) > farthest_m;
    }

    SeenEdges edges_from_here() const {
        const Pose& pose = result_.camera_from_face;
        const Vec3 eye = inverse(pose).translation;
        return {target_,
                face_,
                pose,
                pixel_pitch(),
                board_reach_m(length(eye)),
                background_.light(pose.translation.z),
                result_.edges.log_background};
    }

    // The least squares of the edges about `pose`.
    struct Normal {
        MatrixAll a = MatrixAll::Zero();
        VectorAll b = VectorAll::Zero();
        double square = 0;
        int n = 0;
    };

    // `residual_of`: the share of the board that a spot shows, minus the expected one; `seen` gives
    // its derivatives by the pose.
    template <class Residual>
    Normal normal_equations(const SeenEdges& seen, const Pose& pose,
                            const Residual& residual_of) const {
        Normal sums;
        const Pose face_from_camera = inverse(pose);
        for (const Spot& s : spots_) {
            const Vec3 d = rotate(face_from_camera.rotation, s.ray);
            const double t = -face_from_camera.translation.z / d.z;
            const double u = face_from_camera.translation.x + d.x * t;
            const double v = face_from_camera.translation.y + d.y * t;
            const Coverage c = seen.at(u, v, s.ramp_u, s.ramp_v, result_.edges);
            if (c.by_u == 0 && c.by_v == 0)
                continue;
            const double residual = residual_of(s, c);
            // The face moves by (turn x p + shift); the ray meets it where its z is 0 again.
            const double slide = -(c.by_u * d.x + c.by_v * d.y) / d.z;
            VectorAll j;
            j << -slide * v, slide * u, c.by_u * v - c.by_v * u, -c.by_u, -c.by_v, -slide,
                c.by_params[0], c.by_params[1], c.by_params[2];
            sums.a.selfadjointView<Eigen::Lower>().rankUpdate(j);
            sums.b += residual * j;
            sums.square += residual * residual;
            ++sums.n;
        }
        sums.a.triangularView<Eigen::StrictlyUpper>() = sums.a.transpose();
        const double weight = 1 / (share_sigma * share_sigma * edge_pixels_per_measurement);
        sums.a *= weight;
        sums.b *= weight;
        return sums;
    }

    static void step_params(EdgeParams& params, const VectorAll& p) {
        params.outline_growth_m += p[6];
        params.hole_growth_m += p[7];
        params.log_background += p[8];
    }

    bool fit_edges(const SeenEdges& seen, int steps) {
        Pose& pose = result_.camera_from_face;
        for (int step = 0; step < steps; ++step) {
            Normal sums = normal_equations(
                seen, pose, [](const Spot& s, const Coverage& c) { return s.shown - c.share; });
            if (sums.n < least_edge_pixels)
                return false;
            add_priors(sums, result_.edges, prior_growth_m);
            edge_information_ = sums.a;
            edge_pull_ = sums.b;
            const PlaneSays plane =
                plane_says(result_.plane, result_.plane_covariance, pose, target_, trust_);
            sums.a.topLeftCorner<6, 6>() += plane.information;
            sums.b.head<6>() += plane.pull;
            const VectorAll p = sums.a.ldlt().solve(sums.b);
            if (!p.allFinite() || p.head<3>().norm() > 0.2)
                return false;
            last_step_ = p.head<6>();
            pose = stepped(pose, p.head<6>());
            step_params(result_.edges, p);
            result_.edge_pixels = sums.n;
            result_.edge_rms = std::sqrt(sums.square / sums.n);
        }
        return true;
    }

    // The numbers of unmeasured and of background pixels among 7 x 7 pixels around one.
    struct Around {
        int unseen = 0, behind = 0;
    };
    Around around(int x, int y) const {
        constexpr int arm = 3;
        Around sums;
        for (int j = y - arm; j <= y + arm; ++j)
            for (int i = x - arm; i <= x + arm; ++i) {
                const bool is_in =
                    i >= 0 && j >= 0 && i < depth_.depth.size.width && j < depth_.depth.size.height;
                const int units = is_in ? depth_.depth.row(j)[i] : 0;
                sums.unseen += units == 0;
                sums.behind += units * depth_.metres_per_unit *
                                   result_.plane.inverse_depth(rays_.view().row(y)[x]) >
                               1.05;
            }
        return sums;
    }

    // Moves the pose by edges until an image that is computed for it shows the same edges. In front
    // of a dark background, which is often not measured, only the border between the board and
    // everything else counts.
    bool measure_edges() {
        Pose& pose = result_.camera_from_face_by_edges;
        result_.camera_from_face = pose;
        const SeenEdges seen = edges_from_here();
        find_spots(seen, {0, 0, 0});
        constexpr int outside_of_light = 36, dark = 6;  // of 49 pixels
        std::erase_if(spots_,
                      [&](const Spot& s) { return around(s.x, s.y).unseen > outside_of_light; });
        // A dark background is often not measured, also far from edges.
        for (Spot& s : spots_)
            s.is_before_dark = around(s.x, s.y).behind < dark;
        result_.edges.outline_growth_m = result_.edges.hole_growth_m = 0;
        const PixelWindow w = window_of(depth_, pose, target_);
        EdgePrediction prediction(target_, face_, rays_, w);
        // The image changes in steps of pixels, so the last pose need not be the best one.
        LatticeFit best = result_;
        best.edge_rms = 1;
        for (int step = 0; step < measuring_steps; ++step) {
            prediction.compute(pose, background_, result_.edges, board_reach_m(0), mixed_m);
            Normal sums =
                normal_equations(seen, pose, [&](const Spot& s, const Coverage&) -> double {
                    const double expected = prediction.shown(s.x, s.y);
                    return s.is_before_dark ? (s.shown == 1) - (expected == 1) : s.shown - expected;
                });
            if (sums.n < least_edge_pixels)
                return false;
            add_priors(sums, result_.edges, measured_growth_m);
            const double rms = std::sqrt(sums.square / sums.n);
            if (rms < best.edge_rms) {
                best.camera_from_face_by_edges = pose;
                best.edges = result_.edges;
                best.edge_rms = rms;
                best.edge_pixels = sums.n;
                edge_information_ = sums.a;
            }
            const VectorAll p = MatrixAll(sums.a + weak_prior()).ldlt().solve(sums.b);
            if (!p.allFinite() || p.head<3>().norm() > 0.05 || p.segment<3>(3).norm() > 0.05)
                break;
            pose = stepped(pose, p.head<6>());
            step_params(result_.edges, p);
        }
        result_ = best;
        return best.edge_rms < largest_measured_rms;
    }

    static void add_priors(Normal& sums, const EdgeParams& params, double growth_m) {
        const double values[3] = {params.outline_growth_m, params.hole_growth_m,
                                  params.log_background};
        for (int i = 0; i < 3; ++i) {
            const double sigma = i < 2 ? growth_m : prior_log_background;
            sums.a(pose_count + i, pose_count + i) += 1 / (sigma * sigma);
            sums.b[pose_count + i] -= values[i] / (sigma * sigma);
        }
    }

    // The distance behind the plane up to which a measurement is the board: noise and walls.
    double board_reach_m(double z_m) const { return plane_tolerance_m(z_m) + target_.thickness_m; }

    void find_spots(const SeenEdges& seen, const Round& round) {
        const Pose& pose = result_.camera_from_face;
        const Plane& plane = result_.plane;
        const PixelWindow w = window_of(depth_, pose, target_);
        const OnFace on_face(plane, pose);
        const int step = step_in(round);
        const double per_length = 1 / length(plane.q);
        const double usual_ramp_m = std::max(
            ramp_pixels * pixel_pitch() * length(pose.translation) * 1.3, round.least_ramp_m);
        const double reach_m = usual_ramp_m / 2 + moves_in_round_m + round.least_ramp_m / 2;
        spots_.clear();
        for (int y = w.top; y + 1 < w.bottom; y += step) {
            const Ray* rays = rays_.view().row(y);
            const Ray* below = rays_.view().row(y + 1);
            const std::uint16_t* row = depth_.depth.row(y);
            for (int x = w.left; x + 1 < w.right; x += step) {
                if (rays[x].x == no_ray || rays[x + 1].x == no_ray || below[x].x == no_ray)
                    continue;
                const double on_plane = plane.inverse_depth(rays[x]);
                if (on_plane <= 0)
                    continue;
                const Vec2 here = on_face.at(rays[x], on_plane);
                // Pixels far from all edges contain no information.
                if (!seen.is_near_edge(here.x, here.y, reach_m))
                    continue;
                double shown = 0.5;
                if (row[x] != 0) {
                    const double z = row[x] * depth_.metres_per_unit;
                    const double off = (on_plane * z - 1) * per_length;  // behind the plane
                    if (off < -plane_tolerance_m(z))
                        continue;  // an object in front of the board
                    // A mixed pixel is measured between the two surfaces, near the board.
                    const double shared = board_reach_m(z);
                    shown = off < shared ? 1 : off < shared + mixed_m ? 0.5 : 0;
                }
                const Vec2 right = on_face.at(rays[x + 1], plane.inverse_depth(rays[x + 1]));
                const Vec2 under = on_face.at(below[x], plane.inverse_depth(below[x]));
                const auto ramp = [&](double a, double b) {
                    return std::max(ramp_pixels * std::sqrt(a * a + b * b), round.least_ramp_m);
                };
                spots_.push_back({{rays[x].x, rays[x].y, 1},
                                  ramp(right.x - here.x, under.x - here.x),
                                  ramp(right.y - here.y, under.y - here.y),
                                  x,
                                  y,
                                  false,
                                  shown});
            }
        }
    }

    double pixel_pitch() const { return 2 / (depth_.camera->fx + depth_.camera->fy); }

    static MatrixAll weak_prior() {
        MatrixAll prior = MatrixAll::Zero();
        for (int i = 0; i < pose_count; ++i) {
            const double sigma = i < 3 ? prior_turn : prior_shift_m;
            prior(i, i) = 1 / (sigma * sigma);
        }
        return prior;
    }

    void fill_measured_covariance() {
        result_.edge_covariance =
            (edge_information_ + weak_prior()).inverse().topLeftCorner<6, 6>() *
            measured_variance(result_.edge_rms);
        const PlaneSays plane = plane_says(result_.plane, result_.plane_covariance,
                                           result_.camera_from_face_by_edges, target_, trust_);
        result_.covariance = (result_.edge_covariance.inverse() + plane.information).inverse();
        result_.camera_from_face =
            stepped(result_.camera_from_face_by_edges, result_.covariance * plane.pull);
    }

    // Poses and covariances; growth and walls are left out of them as unknown.
    void fill_covariance() {
        const MatrixAll inverse_information = (edge_information_ + weak_prior()).inverse();
        result_.edge_covariance = inverse_information.topLeftCorner<6, 6>();
        const Vector6 to_edges = (inverse_information * edge_pull_).head<6>();
        result_.camera_from_face_by_edges =
            stepped(result_.camera_from_face, to_edges - last_step_);
        add_edge_errors(unmodelled_pixels);
        combine_covariances();
    }

    // An error of all edges on one side, over the arm that a tilt of the whole has.
    void add_edge_errors(double pixels) {
        const double error_m =
            pixels * pixel_pitch() * length(result_.camera_from_face.translation);
        const double turn = error_m / (target_.height_m / 2);
        for (int i = 0; i < 3; ++i) {
            result_.edge_covariance(i, i) += turn * turn;
            result_.edge_covariance(i + 3, i + 3) += error_m * error_m;
        }
    }

    // A board whose edges all lie further out looks larger, which is nearer.
    void doubt_edges() {
        add_edge_errors(unmatched_pixels);
        const Vec3 at = inverse(result_.camera_from_face_by_edges).translation;
        const Eigen::Vector3d farther = Eigen::Vector3d(at.x, at.y, at.z) * unmatched_pixels *
                                        pixel_pitch() * length(at) / (target_.height_m / 2);
        result_.edge_covariance.bottomRightCorner<3, 3>() += farther * farther.transpose();
        combine_covariances();
    }

    void combine_covariances() {
        const PlaneSays plane = plane_says(result_.plane, result_.plane_covariance,
                                           result_.camera_from_face, target_, trust_);
        result_.covariance = (result_.edge_covariance.inverse() + plane.information).inverse();
    }

    const DepthLookup& depth_;
    FitEffort effort_;
    const Image<Ray>& rays_;
    const LatticeTarget& target_;
    const FacePattern pattern_;
    const DepthTrust& trust_;
    Face face_;
    Pose start_;
    MatrixAll edge_information_ = MatrixAll::Identity();
    VectorAll edge_pull_ = VectorAll::Zero();
    Vector6 last_step_ = Vector6::Zero();
    BackgroundDepth background_;
    std::vector<Spot> spots_;
    LatticeFit result_;
};

}  // namespace

std::optional<LatticeFit> fit_lattice(const DepthLookup& depth, const Image<Ray>& rays,
                                      const LatticeMatch& match, const LatticeTarget& target,
                                      FitEffort effort, const DepthTrust& trust) {
    return Fit(depth, rays, match, target, effort, trust).run();
}

}  // namespace theatron::registration
