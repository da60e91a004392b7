// SPDX-License-Identifier: Apache-2.0
#include "viewer/cloud_pick.h"

#include <cmath>

namespace theatron::viewer {
namespace {

constexpr double nearest_m = 0.05, step_m = 0.01;
// A ray that is farther behind a surface passes behind it.
constexpr double surface_m = 0.03;
constexpr int refinements = 12;
// The noise of one measurement, as in filter/noise_model.h.
constexpr double noise_constant_m = 0.0005, noise_squared_m = 0.00025;

class CameraRay {
public:
    CameraRay(const CloudCamera& camera, const render::PickRay& ray)
        : camera_(camera),
          from_(inverse(camera.calibration->room_from_camera) * ray.from),
          direction_(rotate(conjugate(camera.calibration->room_from_camera.rotation),
                            normalized(ray.direction))) {}

    Vec3 at(double t) const { return from_ + direction_ * t; }

    // How far the ray is behind the surface; nullopt where none was measured.
    std::optional<double> behind(double t) const {
        const Vec3 p = at(t);
        const auto pixel = project(camera_.calibration->depth, p);
        const double z = pixel ? depth_at(*pixel) : 0;
        return z > 0 ? std::optional(p.z - z) : std::nullopt;
    }

    std::optional<double> hit() const {
        std::optional<double> before;
        constexpr int steps = int((farthest_pick_m - nearest_m) / step_m + 0.5);
        for (int i = 0; i < steps; ++i) {
            const double t = nearest_m + i * step_m;
            const std::optional<double> now = behind(t);
            if (before && now && *before < 0 && *now >= 0 && *now < surface_m)
                return refined(t - step_m, t);
            before = now;
        }
        return std::nullopt;
    }

    // The normal of the surface around a place of it, towards the camera.
    Vec3 normal(Vec3 place) const {
        const auto pixel = project(camera_.calibration->depth, place);
        constexpr double reach = 3;
        const auto side = [&](double x, double y) { return neighbour(*pixel, x, y, place.z); };
        const auto left = side(-reach, 0), right = side(reach, 0), up = side(0, -reach),
                   down = side(0, reach);
        const Vec3 towards = normalized(-place);
        if (!left || !right || !up || !down)
            return towards;
        const Vec3 normal = cross(*right - *left, *up - *down);
        const double size = length(normal);
        if (!(size > 0))
            return towards;
        return normal * ((dot(normal, towards) < 0 ? -1 : 1) / size);
    }

private:
    double depth_at(Vec2 pixel) const {
        const double x = std::floor(pixel.x + 0.5), y = std::floor(pixel.y + 0.5);
        const Size size = camera_.depth.size;
        if (!(x >= 0 && y >= 0 && x < size.width && y < size.height))
            return 0;
        return depth_m(*camera_.calibration, camera_.depth.row(int(y))[int(x)]);
    }

    double refined(double before, double after) const {
        for (int i = 0; i < refinements; ++i) {
            const double middle = (before + after) / 2;
            const std::optional<double> depth = behind(middle);
            (depth && *depth < 0 ? before : after) = middle;
        }
        return after;
    }

    std::optional<Vec3> neighbour(Vec2 pixel, double x, double y, double z) const {
        const Vec2 at{std::round(pixel.x + x), std::round(pixel.y + y)};
        const double depth = depth_at(at);
        const auto ray = unproject(camera_.calibration->depth, at);
        if (depth == 0 || !ray || std::abs(depth - z) > surface_m)
            return std::nullopt;
        return Vec3{ray->x * depth, ray->y * depth, depth};
    }

    const CloudCamera& camera_;
    Vec3 from_, direction_;
};

}  // namespace

std::optional<CloudPoint> pick_cloud(const std::vector<CloudCamera>& cameras,
                                     const render::PickRay& ray) {
    std::optional<CloudPoint> nearest;
    for (const CloudCamera& camera : cameras) {
        const CameraRay in_camera(camera, ray);
        const auto t = in_camera.hit();
        if (!t || (nearest && *t >= nearest->distance_m))
            continue;
        const Calibration& calibration = *camera.calibration;
        CloudPoint point;
        point.distance_m = *t;
        point.measured.camera = camera.number;
        point.measured.room_from_camera = calibration.room_from_camera;
        point.measured.in_camera = in_camera.at(*t);
        const double reach = length(point.measured.in_camera);
        point.measured.deviation_m = noise_constant_m + noise_squared_m * reach * reach;
        point.measured.pixel_radians = 1 / calibration.depth.fx;
        if (calibration.covariance)
            point.measured.placement = *calibration.covariance;
        point.place = calibration.room_from_camera * point.measured.in_camera;
        point.normal = rotate(calibration.room_from_camera.rotation,
                              in_camera.normal(point.measured.in_camera));
        nearest = point;
    }
    return nearest;
}

}  // namespace theatron::viewer
