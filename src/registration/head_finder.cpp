// SPDX-License-Identifier: Apache-2.0
#include "registration/head_finder.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace theatron::registration {
namespace {

constexpr double nearest_m = 0.4, farthest_m = 4;
// A head with hair or a cap, and how much people differ.
constexpr double usual_radius_m = 0.098, radius_deviation_m = 0.008;
// From the middle to between the eyes.
constexpr double eyes_ahead_m = 0.09, eyes_below_m = 0.02;
constexpr int directions = 24;
constexpr double ring = 1.75;    // of the radius, where nothing of the head is left
constexpr double free_m = 0.16;  // what stands behind a head is farther than that
constexpr double least_free = 0.8, least_near = 0.85, least_share = 0.6;
constexpr double on_ball_m = 0.02;

double depth_m(const SurfaceCamera& camera, DepthView depth, int x, int y) {
    if (x < 0 || y < 0 || x >= depth.size.width || y >= depth.size.height)
        return 0;
    return depth.row(y)[x] * camera.depth_unit_mm / 1000;
}

std::optional<Vec3> point_at(const SurfaceCamera& camera, DepthView depth, int x, int y) {
    const double z = depth_m(camera, depth, x, y);
    if (z <= 0 || camera.rays.view().row(y)[x].x == no_ray)
        return {};
    const Ray ray = camera.rays.view().row(y)[x];
    return Vec3{ray.x * z, ray.y * z, z};
}

// How much a pixel looks like the middle of a head: the shares of places around it that are near
// where they should be, and far where they should be. `up` in the picture has length 1.
double likeness(const SurfaceCamera& camera, DepthView depth, int x, int y, Vec2 up) {
    const double z = depth_m(camera, depth, x, y);
    if (z < nearest_m || z > farthest_m)
        return 0;
    const double radius = usual_radius_m * camera.model.fx / z;
    if (x - radius < 0 || y - radius < 0 || x + radius >= depth.size.width ||
        y + radius >= depth.size.height)
        return 0;
    int near = 0, free = 0, beside = 0;
    for (int i = 0; i < directions; ++i) {
        const double a = 2 * std::numbers::pi * i / directions;
        const Vec2 d{std::cos(a), std::sin(a)};
        const double inside = depth_m(camera, depth, int(std::lround(x + 0.6 * radius * d.x)),
                                      int(std::lround(y + 0.6 * radius * d.y)));
        near += inside > 0 && std::abs(inside - z) < 0.07;
        // Below are neck and shoulders.
        if (d.x * up.x + d.y * up.y < -0.25)
            continue;
        ++beside;
        const double outside = depth_m(camera, depth, int(std::lround(x + ring * radius * d.x)),
                                       int(std::lround(y + ring * radius * d.y)));
        free += outside == 0 || outside > z + free_m;
    }
    const double near_share = double(near) / directions, free_share = double(free) / beside;
    return near_share < least_near || free_share < least_free ? 0 : near_share + free_share;
}

struct Ball {
    Vec3 middle;
    double radius = usual_radius_m;
    double share = 0;
    double deviation_m = 0;
};

// The ball that the points around `guess` lie on, its radius held near the usual one.
std::optional<Ball> fit_ball(const std::vector<Vec3>& points, Vec3 guess) {
    Ball ball{guess};
    double variance = 0;
    for (int i = 0; i < 15; ++i) {
        Eigen::Matrix4d normal_matrix = Eigen::Matrix4d::Zero();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        const double tolerance = std::max(on_ball_m, 0.05 - 0.004 * i);
        double count = 0, squares = 0, near = 0;
        for (const Vec3& p : points) {
            const Vec3 out = p - ball.middle;
            const double distance = length(out);
            if (distance > 1.35 * ball.radius || distance < 1e-3)
                continue;
            ++near;
            const double apart = distance - ball.radius, u = apart / tolerance;
            if (std::abs(u) >= 1)
                continue;
            const double w = (1 - u * u) * (1 - u * u);
            Eigen::Vector4d row;
            row << -out.x / distance, -out.y / distance, -out.z / distance, -1;
            normal_matrix += w * row * row.transpose();
            right -= w * apart * row;
            squares += w * apart * apart;
            count += w;
        }
        if (count < 30)
            return {};
        ball.share = count / near;
        variance = squares / count;
        // A head is no ball: its parts err together, so that all points count as a few.
        constexpr double independent = 12;
        const double unit = independent / (count * std::max(variance, 9e-6));
        normal_matrix *= unit;
        right *= unit;
        const double prior = 1 / (radius_deviation_m * radius_deviation_m);
        normal_matrix(3, 3) += prior;
        right[3] += prior * (usual_radius_m - ball.radius);
        const Eigen::Vector4d step = normal_matrix.ldlt().solve(right);
        ball.middle = ball.middle + Vec3{step[0], step[1], step[2]};
        ball.radius += step[3];
        if (!(length(ball.middle - guess) < 0.12))
            return {};
        ball.deviation_m = std::sqrt(normal_matrix.inverse().topLeftCorner<3, 3>().trace());
    }
    return ball;
}

// The body's direction, from the shoulders: the horizontal direction in which they are least wide.
// Its deviation in radians is large where they hardly show.
struct Facing {
    Vec3 ahead;
    double deviation = 1;
};

Facing facing_of(const std::vector<Vec3>& points, Vec3 middle, Vec3 up) {
    const Vec3 to_camera = normalized(-middle - up * dot(-middle, up));
    const Vec3 side = cross(to_camera, up);
    std::vector<Eigen::Vector2d> flat;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Vec3& p : points) {
        const Vec3 d = p - middle;
        const double below = -dot(d, up);
        if (below < 0.2 || below > 0.4 || std::abs(dot(d, side)) > 0.32 ||
            std::abs(dot(d, to_camera)) > 0.3)
            continue;
        flat.push_back({dot(d, side), dot(d, to_camera)});
        mean += flat.back();
    }
    if (flat.size() < 40)
        return {to_camera, 1};
    mean /= double(flat.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const Eigen::Vector2d& p : flat)
        spread += (p - mean) * (p - mean).transpose() / double(flat.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    const Eigen::Vector2d across = axes.eigenvectors().col(0);  // least wide
    const double ratio = std::sqrt(std::max(axes.eigenvalues()[0], 1e-9) / axes.eigenvalues()[1]);
    Vec3 ahead = side * across.x() + to_camera * across.y();
    if (dot(ahead, to_camera) < 0)
        ahead = -ahead;
    // A head turns on its body by about 20 degrees.
    return {ahead, std::min(1.0, 0.35 + ratio * ratio)};
}

}  // namespace

std::optional<FoundHead> find_head(const SurfaceCamera& camera, DepthView depth, Vec3 up) {
    if (depth.size.width < 16 || depth.size.height < 16 || !(length(up) > 0))
        return {};
    up = normalized(up);
    const double in_picture = std::hypot(up.x, up.y);
    if (in_picture < 0.3)
        return {};  // looks straight up or down
    const Vec2 picture_up{up.x / in_picture, up.y / in_picture};

    constexpr int step = 4;
    std::optional<FoundHead> nearest;
    std::vector<Vec3> points;
    for (int y = step; y < depth.size.height; y += step)
        for (int x = step; x < depth.size.width; x += step)
            if (const auto p = point_at(camera, depth, x, y))
                points.push_back(*p);
    struct Candidate {
        double likeness = 0;
        Vec3 at;
    };
    std::vector<Candidate> candidates;
    for (int y = step; y < depth.size.height; y += step)
        for (int x = step; x < depth.size.width; x += step)
            if (const double like = likeness(camera, depth, x, y, picture_up); like > 0)
                candidates.push_back({like, *point_at(camera, depth, x, y)});
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.likeness > b.likeness; });
    std::vector<Vec3> tried;
    for (const Candidate& candidate : candidates) {
        // Neighbours lead to the same ball.
        if (std::any_of(tried.begin(), tried.end(),
                        [&](Vec3 t) { return length(t - candidate.at) < usual_radius_m; }))
            continue;
        tried.push_back(candidate.at);
        constexpr std::size_t most_tries = 12;
        if (tried.size() > most_tries)
            break;
        const Vec3 sight = normalized(candidate.at);
        std::vector<Vec3> around;
        for (const Vec3& p : points)
            if (length(p - candidate.at) < 0.7)
                around.push_back(p);
        const auto ball = fit_ball(around, candidate.at + sight * usual_radius_m);
        if (!ball || ball->share < least_share ||
            (nearest && length(ball->middle) > length(nearest->middle)))
            continue;
        // It stands on something.
        const auto below = std::count_if(around.begin(), around.end(), [&](Vec3 p) {
            const double down = -dot(p - ball->middle, up);
            return down > 0.2 && down < 0.45;
        });
        if (below < 20)
            continue;
        const Facing facing = facing_of(around, ball->middle, up);
        // The person's own view: x to their right, y down, z ahead.
        const Vec3 z = normalized(facing.ahead), down = -up, x = cross(down, z);
        const Quat rotation =
            quat_from_matrix({{{x.x, down.x, z.x}, {x.y, down.y, z.y}, {x.z, down.z, z.z}}});
        FoundHead head;
        head.middle = ball->middle;
        head.middle_m = std::max(0.01, ball->deviation_m);
        head.share = ball->share;
        head.camera_from_head = {rotation, ball->middle + z * eyes_ahead_m + down * eyes_below_m};
        constexpr double nod = 0.35;  // of pitch and roll, which nothing tells
        const double turn = facing.deviation, shift = head.middle_m;
        Eigen::Matrix<double, 6, 1> variances;
        variances << nod * nod, turn * turn, nod * nod,
            shift * shift + std::pow(eyes_ahead_m * turn, 2),
            shift * shift + std::pow(eyes_ahead_m * nod, 2), shift * shift;
        head.covariance = variances.asDiagonal();
        nearest = head;
    }
    return nearest;
}

}  // namespace theatron::registration
