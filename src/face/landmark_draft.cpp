// SPDX-License-Identifier: Apache-2.0
#include "face/landmark_draft.h"

#include <Eigen/Dense>
#include <cmath>

#include "face/expression.h"

namespace theatron::face {
namespace {

// The landmarks of LandmarkDraft::Place.
constexpr std::array<std::size_t, LandmarkDraft::place_count> landmark_of = {36, 39, 42, 45,
                                                                             30, 48, 54, 8};

// The kernel of a thin plate, of a squared distance.
double thin_plate(double squared) {
    return squared > 0 ? 0.5 * squared * std::log(squared) : 0;
}

double squared_distance(Vec2 a, Vec2 b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

}  // namespace

Landmarks usual_landmarks(const MorphModel& model, Emotion emotion) {
    Landmarks usual;
    for (std::size_t i = 0; i < landmark_count; ++i) {
        const Vec3 place = blended_vertex(model, {}, channels_of(emotion), model.landmarks[i]);
        usual[i] = {place.x, -place.y};
    }
    return usual;
}

std::optional<LandmarkDraft::Place> LandmarkDraft::next() const {
    for (std::size_t i = 0; i < place_count; ++i)
        if (!put_[landmark_of[i]])
            return Place(i);
    return std::nullopt;
}

void LandmarkDraft::put(Vec2 photo_px) {
    if (const auto place = next())
        move(landmark_of[std::size_t(*place)], photo_px);
}

void LandmarkDraft::take(const Landmarks& photo_px) {
    for (std::size_t i = 0; i < landmark_count; ++i)
        put_[i] = photo_px[i];
    steps_.clear();
    bend();
}

void LandmarkDraft::move(std::size_t landmark, Vec2 photo_px, bool goes_on) {
    if (!goes_on || steps_.empty() || steps_.back().landmark != landmark)
        steps_.push_back({landmark, put_[landmark]});
    set(landmark, photo_px);
}

bool LandmarkDraft::undo() {
    if (steps_.empty())
        return false;
    const Step step = steps_.back();
    steps_.pop_back();
    set(step.landmark, step.was);
    return true;
}

void LandmarkDraft::set(std::size_t landmark, std::optional<Vec2> place) {
    put_[landmark] = place;
    bend();
}

bool LandmarkDraft::is_shown(std::size_t landmark) const {
    return put_[landmark].has_value() || !next();
}

std::optional<std::size_t> LandmarkDraft::near(Vec2 photo_px, double reach_px) const {
    std::optional<std::size_t> nearest;
    double least = reach_px * reach_px;
    for (std::size_t i = 0; i < landmark_count; ++i) {
        const double squared = squared_distance(points_[i], photo_px);
        if (is_shown(i) && squared <= least) {
            least = squared;
            nearest = i;
        }
    }
    return nearest;
}

std::optional<Landmarks> LandmarkDraft::landmarks_px() const {
    return next() ? std::nullopt : std::optional(points_);
}

// The spline passes through all places that are put. Before all of them are, the others are not
// shown, so they need no place.
void LandmarkDraft::bend() {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < landmark_count; ++i)
        if (put_[i]) {
            known.push_back(i);
            points_[i] = *put_[i];
        }
    if (next() || known.size() == landmark_count)
        return;
    const auto count = Eigen::Index(known.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 3, count + 3);
    Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(count + 3, 2);
    for (Eigen::Index row = 0; row < count; ++row) {
        const Vec2 at = usual_[known[std::size_t(row)]];
        for (Eigen::Index column = 0; column < count; ++column)
            system(row, column) =
                thin_plate(squared_distance(at, usual_[known[std::size_t(column)]]));
        system.block<1, 3>(row, count) = Eigen::RowVector3d(1, at.x, at.y);
        system.block<3, 1>(count, row) = Eigen::Vector3d(1, at.x, at.y);
        const Vec2 place = *put_[known[std::size_t(row)]];
        wanted.row(row) = Eigen::RowVector2d(place.x, place.y);
    }
    // Landmarks of a strange model may lie on each other; the smallest solution is taken then.
    const Eigen::MatrixXd weights = system.completeOrthogonalDecomposition().solve(wanted);
    for (std::size_t i = 0; i < landmark_count; ++i) {
        if (put_[i])
            continue;
        Eigen::RowVector2d place =
            Eigen::RowVector3d(1, usual_[i].x, usual_[i].y) * weights.bottomRows<3>();
        for (Eigen::Index other = 0; other < count; ++other)
            place += thin_plate(squared_distance(usual_[i], usual_[known[std::size_t(other)]])) *
                     weights.row(other);
        points_[i] = {place.x(), place.y()};
    }
}

}  // namespace theatron::face
