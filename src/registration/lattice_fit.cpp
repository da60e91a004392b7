// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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
constexpr double mixed_m = 0.04;        // pulled off the board by what is behind it, no further
constexpr double farthest_m = 0.04;     // from the match
constexpr double light_reach_m = 0.03;  // around edges; the light of what is behind counts there
constexpr double background_reflectivity = 0.6;  // in that of the board
// Deviations of what is known beforehand.
constexpr double prior_growth_m = 0.002, prior_log_background = 0.7;
constexpr double prior_turn = 0.2, prior_shift_m = 0.2;  // keep far views solvable
// Of the share of a pixel that is seen, and noise is smooth over some pixels: that many
// count as one measurement.
constexpr double share_sigma = 0.16;
constexpr double pixels_per_measurement = 8, edge_pixels_per_measurement = 4;
// Errors of the edges that no number of pixels lowers: what the model of coverage leaves out.
constexpr double unmodelled_pixels = 0.02;

constexpr int pose_count = 6, param_count = 9;
using VectorAll = Eigen::Matrix<double, param_count, 1>;
using MatrixAll = Eigen::Matrix<double, param_count, param_count>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// A pixel near the board.
struct Spot {
    Vec3 ray;               // camera frame, z = 1
    double ramp_u, ramp_v;  // along the face, over which coverage goes from 0 to 1, metres
    double shown;           // 1: board, 0: what is behind, 0.5: not measured
};

struct PixelWindow {
    int left, top, right, bottom;
};

PixelWindow window_of(const DepthLookup& lookup, const Pose& camera_from_face,
                      const LatticeTarget& target) {
    const Rect r = outline(target);
    PixelWindow w{lookup.depth.size.width, lookup.depth.size.height, 0, 0};
    constexpr double rim = 0.03;
    constexpr int steps = 8;  // lenses bend straight edges
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
            const Vec3 p =
                camera_from_face * Vec3{r.left - rim + (r.width() + 2 * rim) * i / steps,
                                        r.bottom - rim + (r.height() + 2 * rim) * j / steps, 0};
            const auto pixel = project(*lookup.camera, p);
            if (!pixel)
                continue;
            w.left = std::min(w.left, int(pixel->x) - 2);
            w.right = std::max(w.right, int(pixel->x) + 3);
            w.top = std::min(w.top, int(pixel->y) - 2);
            w.bottom = std::max(w.bottom, int(pixel->y) + 3);
        }
    return {std::max(w.left, 0), std::max(w.top, 0), std::min(w.right, lookup.depth.size.width),
            std::min(w.bottom, lookup.depth.size.height)};
}

Vec3 axis_of(const Pose& pose, int i) {
    return rotate(pose.rotation, {i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0});
}

Pose stepped(const Pose& pose, const Eigen::Ref<const Vector6>& step) {
    const Vec3 turn{step[0], step[1], step[2]};
    const double angle = length(turn);
    const Quat rotation = angle > 1e-12 ? rotation_about(turn, angle) : Quat{};
    return pose * Pose{rotation, {step[3], step[4], step[5]}};
}

// What the measured plane says about a pose close to `pose`: information and its product with the
// step towards it.
struct PlaneSays {
    Matrix6 information = Matrix6::Zero();
    Vector6 pull = Vector6::Zero();
};

PlaneSays plane_says(const Plane& plane, const Matrix3& q_covariance, const Pose& pose,
                     const LatticeTarget& target, const DepthTrust& trust) {
    const Vec3 normal = axis_of(pose, 2);
    Eigen::Matrix<double, 3, 6> by_pose = Eigen::Matrix<double, 3, 6>::Zero();
    Eigen::Matrix3d rays;
    Eigen::Vector3d longer, depths;  // measured minus expected
    int i = 0;
    for (const Vec3& place : depth_places(target)) {
        const Vec3 p = pose * place;
        const Vec3 ray = p * (1 / p.z);
        depths[i] = 1 / plane.inverse_depth({float(ray.x), float(ray.y)});
        longer[i] = depths[i] - p.z;
        // A small motion of the face moves the point of this ray along the ray.
        const double per_normal = 1 / dot(normal, ray);
        by_pose(i, 0) = place.y * per_normal;
        by_pose(i, 1) = -place.x * per_normal;
        by_pose(i, 5) = per_normal;
        rays.row(i) << ray.x, ray.y, 1;
        ++i;
    }
    const Eigen::Vector3d squares = depths.array().square();
    Eigen::Matrix3d covariance =
        squares.asDiagonal() * rays * q_covariance * rays.transpose() * squares.asDiagonal();
    covariance.array() += trust.common_m * trust.common_m;
    covariance.diagonal().array() += trust.slow_m * trust.slow_m;
    const Eigen::Matrix3d information = covariance.inverse();
    return {by_pose.transpose() * information * by_pose,
            by_pose.transpose() * information * longer};
}

// How far away the background is beyond each edge of the outline, and through each hole.
class BackgroundDepth {
public:
    void add(const FacePattern& pattern, Vec2 p, double z_m) {
        const FacePattern::Inside inside = pattern.inside(p.x, p.y);
        if (inside.edge() > light_reach_m)
            return;
        const bool is_beyond = inside.outline < 0;
        Mean& own = is_beyond ? beyond_[std::size_t(pattern.side_beyond(p.x, p.y))]
                              : through_[std::size_t(pattern.nearest_cell(p.x, p.y))];
        for (Mean* mean : {&own, &all_}) {
            mean->sum += z_m;
            ++mean->n;
        }
    }

    // Expected for a face at `z_m`, whose normal has this cosine to the line of sight.
    BackgroundLight light(double z_m, double cos_face) const {
        const auto light_of = [&](const Mean& mean) {
            constexpr int enough = 10;
            const Mean& used = mean.n >= enough ? mean : all_;
            const double behind_m = used.n > 0 ? used.sum / used.n : 2 * z_m;
            return background_reflectivity * (z_m / behind_m) * (z_m / behind_m) / cos_face;
        };
        BackgroundLight result;
        std::transform(beyond_.begin(), beyond_.end(), result.outline.begin(), light_of);
        std::transform(through_.begin(), through_.end(), result.cells.begin(), light_of);
        return result;
    }

private:
    struct Mean {
        double sum = 0;
        int n = 0;
    };
    Mean all_;
    std::array<Mean, 4> beyond_{};
    std::array<Mean, FacePattern::cell_count> through_{};
};

class Fit {
public:
    Fit(const DepthLookup& depth, const Image<Ray>& rays, const LatticeMatch& match,
        const LatticeTarget& target, const DepthTrust& trust)
        : depth_(depth),
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

    // The face's plane from the pixels that show nothing else; and how far away the background is.
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
                background_.light(pose.translation.z, eye.z / length(eye)),
                result_.edges.log_background};
    }

    bool fit_edges(const SeenEdges& seen, int steps) {
        Pose& pose = result_.camera_from_face;
        EdgeParams& params = result_.edges;
        for (int step = 0; step < steps; ++step) {
            MatrixAll a = MatrixAll::Zero();
            VectorAll b = VectorAll::Zero();
            double square = 0;
            int n = 0;
            const Pose face_from_camera = inverse(pose);
            for (const Spot& s : spots_) {
                const Vec3 d = rotate(face_from_camera.rotation, s.ray);
                const double t = -face_from_camera.translation.z / d.z;
                const double u = face_from_camera.translation.x + d.x * t;
                const double v = face_from_camera.translation.y + d.y * t;
                const Coverage c = seen.at(u, v, s.ramp_u, s.ramp_v, params);
                if (c.by_u == 0 && c.by_v == 0)
                    continue;
                const double residual = s.shown - c.share;
                // The face moves by (turn x p + shift); the ray meets it where its z is 0 again.
                const double slide = -(c.by_u * d.x + c.by_v * d.y) / d.z;
                VectorAll j;
                j << -slide * v, slide * u, c.by_u * v - c.by_v * u, -c.by_u, -c.by_v, -slide,
                    c.by_params[0], c.by_params[1], c.by_params[2];
                a.selfadjointView<Eigen::Lower>().rankUpdate(j);
                b += residual * j;
                square += residual * residual;
                ++n;
            }
            if (n < least_edge_pixels)
                return false;
            a.triangularView<Eigen::StrictlyUpper>() = a.transpose();
            const double weight = 1 / (share_sigma * share_sigma * edge_pixels_per_measurement);
            a *= weight;
            b *= weight;
            add_priors(a, b, params);
            edge_information_ = a;
            edge_pull_ = b;
            const PlaneSays plane =
                plane_says(result_.plane, result_.plane_covariance, pose, target_, trust_);
            a.topLeftCorner<6, 6>() += plane.information;
            b.head<6>() += plane.pull;
            const VectorAll p = a.ldlt().solve(b);
            if (!p.allFinite() || p.head<3>().norm() > 0.2)
                return false;
            last_step_ = p.head<6>();
            pose = stepped(pose, p.head<6>());
            params.outline_growth_m += p[6];
            params.hole_growth_m += p[7];
            params.log_background += p[8];
            result_.edge_pixels = n;
            result_.edge_rms = std::sqrt(square / n);
        }
        return true;
    }

    static void add_priors(MatrixAll& a, VectorAll& b, const EdgeParams& params) {
        const double values[3] = {params.outline_growth_m, params.hole_growth_m,
                                  params.log_background};
        for (int i = 0; i < 3; ++i) {
            const double sigma = i < 2 ? prior_growth_m : prior_log_background;
            a(pose_count + i, pose_count + i) += 1 / (sigma * sigma);
            b[pose_count + i] -= values[i] / (sigma * sigma);
        }
    }

    // How far behind the plane a measurement is still the board: noise, and the walls.
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
                // Pixels in the middle of holes and of the rest say nothing.
                if (!seen.is_near_edge(here.x, here.y, reach_m))
                    continue;
                double shown = 0.5;
                if (row[x] != 0) {
                    const double z = row[x] * depth_.metres_per_unit;
                    const double off = (on_plane * z - 1) * per_length;  // behind the plane
                    if (off < -plane_tolerance_m(z))
                        continue;  // something stands before the board
                    // A pixel that both share lies between them, near the board.
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
                                  shown});
            }
        }
    }

    double pixel_pitch() const { return 2 / (depth_.camera->fx + depth_.camera->fy); }

    // Poses and covariances; growth and walls are left out of them as unknown.
    void fill_covariance() {
        MatrixAll prior = MatrixAll::Zero();
        for (int i = 0; i < pose_count; ++i) {
            const double sigma = i < 3 ? prior_turn : prior_shift_m;
            prior(i, i) = 1 / (sigma * sigma);
        }
        const MatrixAll inverse_information = (edge_information_ + prior).inverse();
        result_.edge_covariance = inverse_information.topLeftCorner<6, 6>();
        const Vector6 to_edges = (inverse_information * edge_pull_).head<6>();
        result_.camera_from_face_by_edges =
            stepped(result_.camera_from_face, to_edges - last_step_);
        // An error of all edges on one side, over the arm that a tilt of the whole has.
        const double error_m =
            unmodelled_pixels * pixel_pitch() * length(result_.camera_from_face.translation);
        const double turn = error_m / (target_.height_m / 2);
        for (int i = 0; i < 3; ++i) {
            result_.edge_covariance(i, i) += turn * turn;
            result_.edge_covariance(i + 3, i + 3) += error_m * error_m;
        }
        const PlaneSays plane = plane_says(result_.plane, result_.plane_covariance,
                                           result_.camera_from_face, target_, trust_);
        result_.covariance = (result_.edge_covariance.inverse() + plane.information).inverse();
    }

    const DepthLookup& depth_;
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

std::array<Vec3, 3> depth_places(const LatticeTarget& target) {
    const double x = target.width_m * 0.35, y = target.height_m * 0.35;
    return {Vec3{-x, -y, 0}, Vec3{x, -y, 0}, Vec3{0, y, 0}};
}

std::optional<LatticeFit> fit_lattice(const DepthLookup& depth, const Image<Ray>& rays,
                                      const LatticeMatch& match, const LatticeTarget& target,
                                      const DepthTrust& trust) {
    return Fit(depth, rays, match, target, trust).run();
}

}  // namespace theatron::registration
