// SPDX-License-Identifier: Apache-2.0
#include "face/landmark_check.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace theatron::face {
namespace {

using Point = std::complex<double>;
using Points = std::array<Point, landmark_count>;

// Further than this from upright, a face stands on its head; a person who lies has 90.
constexpr double most_tilt = 120 * std::numbers::pi / 180;
constexpr std::size_t jaw_begin = 0, jaw_end = 16;

Points centred(const Landmarks& landmarks) {
    Points points;
    Point sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        sum += points[i] = {landmarks[i].x, landmarks[i].y};
    for (Point& point : points)
        point -= sum / double(points.size());
    return points;
}

Points mirrored(Points points) {
    for (Point& point : points)
        point = -std::conj(point);
    return points;
}

struct Fit {
    Point turn;        // and scale, from the usual face to the landmarks
    double share = 0;  // of the face's width, as unusual_share()
};

Fit fit(const Points& usual, const Points& points) {
    Point along = 0;
    double squared = 0, away = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        along += std::conj(usual[i]) * points[i];
        squared += std::norm(usual[i]);
    }
    const Point turn = along / squared;
    for (std::size_t i = 0; i < points.size(); ++i)
        away += std::norm(points[i] - turn * usual[i]);
    const double width = std::abs(turn) * std::abs(usual[jaw_end] - usual[jaw_begin]);
    const double share = width > 0 ? std::sqrt(away / double(points.size())) / width
                                   : std::numeric_limits<double>::infinity();
    return {turn, share};
}

bool is_outside(const Landmarks& landmarks, Size photo) {
    const double margin = outside_share * std::max(photo.width, photo.height);
    return std::any_of(landmarks.begin(), landmarks.end(), [&](Vec2 point) {
        // A value that is no number is outside, too.
        return !(point.x >= -margin && point.y >= -margin && point.x <= photo.width + margin &&
                 point.y <= photo.height + margin);
    });
}

}  // namespace

double unusual_share(const Landmarks& photo_px, const Landmarks& usual) {
    return fit(centred(usual), centred(photo_px)).share;
}

std::optional<LandmarkFault> landmark_fault(const Landmarks& photo_px, const Landmarks& usual,
                                            Size photo) {
    if (is_outside(photo_px, photo))
        return LandmarkFault::outside;
    const Points face = centred(usual), points = centred(photo_px);
    const Fit straight = fit(face, points), exchanged = fit(mirrored(face), points);
    if (std::min(straight.share, exchanged.share) > most_unusual)
        return LandmarkFault::no_face;
    if (exchanged.share < straight.share)
        return LandmarkFault::exchanged;
    if (std::abs(straight.turn) * std::abs(face[jaw_end] - face[jaw_begin]) < least_face_px)
        return LandmarkFault::too_small;
    if (std::abs(std::arg(straight.turn)) > most_tilt)
        return LandmarkFault::upside_down;
    return std::nullopt;
}

}  // namespace theatron::face
