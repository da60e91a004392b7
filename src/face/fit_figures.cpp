// SPDX-License-Identifier: Apache-2.0
#include "face/fit_figures.h"

#include <algorithm>
#include <cmath>

#include "face/random.h"
#include "registration/rigid_fit.h"

namespace theatron::face {
namespace {

constexpr double drawn_noise_px = 2;
constexpr double eyes_sigma_mm = 1;

// A distance of the eyes that was measured; of a person whom nobody is like, within the bounds.
EyeDistance measured_eyes(const MorphModel& model, const DrawnPerson& person, std::uint64_t seed) {
    const double true_mm = eye_distance_mm(model, person.identity);
    return {std::clamp(true_mm + eyes_sigma_mm * Random(seed).normal(), least_eye_distance_mm,
                       most_eye_distance_mm),
            eyes_sigma_mm};
}

std::vector<Vec3> points_of(const MorphModel& model, std::span<const float> identity) {
    std::vector<float> blended(model.neutral.size());
    blend_shape(model, identity, Channels{}, blended);
    std::vector<Vec3> points(model.vertex_count());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {blended[3 * i], blended[3 * i + 1], blended[3 * i + 2]};
    return points;
}

// The root of the mean square distance from the middle.
double spread_of(const std::vector<Vec3>& points) {
    Vec3 middle;
    for (const Vec3 point : points)
        middle = middle + point * (1 / double(points.size()));
    double sum = 0;
    for (const Vec3 point : points)
        sum += dot(point - middle, point - middle);
    return std::sqrt(sum / double(points.size()));
}

}  // namespace

DrawnPerson drawn_person(const MorphModel& model, std::uint64_t seed, double noise_px,
                         std::uint64_t photo) {
    DrawnPerson person;
    Random who(seed);
    for (std::size_t i = 0; i < model.identities.size(); ++i)
        person.identity.push_back(float(who.normal()));
    Random random(seed * 1009 + photo + 1);
    for (int i = 0; i < 4; ++i)
        person.channels[random.below(channel_count)] = float(random.between(0, 0.6));
    person.photo.focal_px = random.between(900, 1400);
    person.photo.centre_px = {640, 360};
    const Quat frontal = rotation_about({1, 0, 0}, std::numbers::pi);
    person.camera_from_face.rotation =
        rotation_about({0, 1, 0}, radians_of(random.between(-8, 8))) *
        rotation_about({1, 0, 0}, radians_of(random.between(-8, 8))) *
        rotation_about({0, 0, 1}, radians_of(random.between(-5, 5))) * frontal;
    person.camera_from_face.translation = {random.between(-50, 50), random.between(-30, 30),
                                           random.between(500, 900)};
    for (std::size_t i = 0; i < landmark_count; ++i) {
        const Vec3 p = person.camera_from_face *
                       blended_vertex(model, person.identity, person.channels, model.landmarks[i]);
        person.photo.landmarks_px[i] = {person.photo.focal_px * p.x / p.z +
                                            person.photo.centre_px.x + noise_px * random.normal(),
                                        person.photo.focal_px * p.y / p.z +
                                            person.photo.centre_px.y + noise_px * random.normal()};
    }
    return person;
}

double surface_error_mm(const MorphModel& model, std::span<const float> person,
                        std::span<const float> other, bool fits_size) {
    std::vector<Vec3> from = points_of(model, other);
    const std::vector<Vec3> to = points_of(model, person);
    if (fits_size) {
        const double size = spread_of(to) / spread_of(from);
        for (Vec3& point : from)
            point = size * point;
    }
    const Pose laid = registration::fit_rigid(from, to).pose;
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        sum += length(laid * from[i] - to[i]);
    return sum / double(from.size());
}

double turned_degrees(const Pose& a, const Pose& b) {
    const Quat turn = normalized(a.rotation * conjugate(b.rotation));
    return 2 * std::acos(std::min(1.0, std::fabs(turn.w))) * 180 / std::numbers::pi;
}

FitFigures fit_figures(const MorphModel& model, int persons, std::uint64_t seed) {
    FitFigures figures;
    int fitted = 0;
    for (int i = 0; i < persons; ++i) {
        const DrawnPerson person =
            drawn_person(model, seed * 7919 + std::uint64_t(i), drawn_noise_px);
        const auto fit = fit_face(model, std::span(&person.photo, 1));
        if (!fit) {
            ++figures.refused;
            continue;
        }
        ++fitted;
        const auto with_eyes = fit_face(model, std::span(&person.photo, 1),
                                        measured_eyes(model, person, seed * 31 + std::uint64_t(i)));
        figures.eyes_known_error_mm += surface_error_mm(
            model, person.identity, with_eyes ? with_eyes->identity : fit->identity);
        const double turned =
            turned_degrees(person.camera_from_face, fit->photos[0].camera_from_face);
        figures.mean_error_mm += surface_error_mm(model, person.identity, fit->identity);
        figures.mean_face_error_mm += surface_error_mm(model, person.identity, {});
        figures.shape_error_mm += surface_error_mm(model, person.identity, fit->identity, true);
        figures.mean_face_shape_error_mm += surface_error_mm(model, person.identity, {}, true);
        figures.pose_degrees += turned;
        figures.worst_pose_degrees = std::max(figures.worst_pose_degrees, turned);
        figures.residual_px += fit->residual_px;
    }
    for (double* mean :
         {&figures.mean_error_mm, &figures.mean_face_error_mm, &figures.shape_error_mm,
          &figures.eyes_known_error_mm, &figures.mean_face_shape_error_mm, &figures.pose_degrees,
          &figures.residual_px})
        *mean /= std::max(fitted, 1);
    return figures;
}

}  // namespace theatron::face
