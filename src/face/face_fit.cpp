// SPDX-License-Identifier: Apache-2.0
#include "face/face_fit.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "registration/least_squares.h"

namespace theatron::face {
namespace {

constexpr double landmark_sigma_px = 2;
constexpr double contour_sigma_px = 4;
constexpr double channel_sigma = 0.2;
// A channel is hardly below rest.
constexpr double negative_sigma = 0.03;
constexpr double nearest_mm = 50;
constexpr std::size_t contour_count = 17;

struct Unknowns {
    Eigen::VectorXd identity;
    struct Photo {
        Pose camera_from_face;
        Eigen::VectorXd expression;  // one size a shape of the model
    };
    std::vector<Photo> photos;
};

Vec3 vertex_of(const std::vector<float>& from, std::uint32_t vertex) {
    const float* p = from.data() + std::size_t(vertex) * 3;
    return {p[0], p[1], p[2]};
}

// How far the middle of the left eye's landmarks is to the left of the right one's.
double eyes_apart(const MorphModel& model, const std::vector<float>& points) {
    constexpr std::size_t right_eye = 36, left_eye = 42, eye_count = 6;
    double sum = 0;
    for (std::size_t k = 0; k < eye_count; ++k)
        sum += vertex_of(points, model.landmarks[left_eye + k]).x -
               vertex_of(points, model.landmarks[right_eye + k]).x;
    return sum / eye_count;
}

class FaceProblem {
public:
    using Unknowns = face::Unknowns;

    FaceProblem(const MorphModel& model, std::span<const FacePhoto> photos,
                std::optional<EyeDistance> eyes)
        : model_(model),
          photos_(photos),
          eyes_(eyes),
          identities_(Eigen::Index(model.identities.size())),
          expressions_(Eigen::Index(model.expressions.size())),
          eye_moves_(identities_) {
        for (Eigen::Index i = 0; i < identities_; ++i)
            eye_moves_[i] = eyes_apart(model, model.identities[std::size_t(i)]);
    }

    double cost(const Unknowns& at) const { return summed(at, nullptr); }
    registration::QuadraticForm form(const Unknowns& at) const {
        registration::QuadraticForm form(identities_ + Eigen::Index(photos_.size()) * per_photo());
        form.cost = summed(at, &form);
        return form;
    }
    Unknowns moved(const Unknowns& from, const Eigen::VectorXd& step) const {
        Unknowns to = from;
        to.identity += step.head(identities_);
        for (std::size_t i = 0; i < to.photos.size(); ++i) {
            const auto part = step.segment(first_of(i), per_photo());
            const Vec3 turn{part[0], part[1], part[2]};
            Pose& pose = to.photos[i].camera_from_face;
            if (const double angle = length(turn); angle > 0)
                pose.rotation = normalized(rotation_about(turn, angle) * pose.rotation);
            pose.translation = pose.translation + Vec3{part[3], part[4], part[5]};
            to.photos[i].expression += part.tail(expressions_);
        }
        return to;
    }
    Unknowns start() const {
        Unknowns at;
        at.identity = Eigen::VectorXd::Zero(identities_);
        for (const FacePhoto& photo : photos_) {
            at.photos.push_back({first_pose(photo), Eigen::VectorXd::Zero(expressions_)});
            for (Eigen::Index k = 0; k < expressions_; ++k)
                at.photos.back().expression[k] = expected(photo, k);
        }
        return at;
    }
    double residual_px(const Unknowns& at, std::size_t photo) const {
        double square = 0;
        for (std::size_t k = 0; k < landmark_count; ++k) {
            const Vec2 miss = missed(at, photo, k);
            square += miss.x * miss.x + miss.y * miss.y;
        }
        return std::sqrt(square / double(landmark_count));
    }

private:
    Eigen::Index per_photo() const { return 6 + expressions_; }
    double expected(const FacePhoto& photo, Eigen::Index expression) const {
        return photo.expected[model_.expressions[std::size_t(expression)].channel];
    }
    Eigen::Index first_of(std::size_t photo) const {
        return identities_ + Eigen::Index(photo) * per_photo();
    }

    // A frontal face, as far away as its size in the photo says.
    Pose first_pose(const FacePhoto& photo) const {
        Vec2 mean;
        Vec3 middle;
        for (std::size_t k = 0; k < landmark_count; ++k) {
            mean = {mean.x + photo.landmarks_px[k].x / landmark_count,
                    mean.y + photo.landmarks_px[k].y / landmark_count};
            middle =
                middle + vertex_of(model_.neutral, model_.landmarks[k]) * (1.0 / landmark_count);
        }
        double seen = 0, real = 0;
        for (std::size_t k = 0; k < landmark_count; ++k) {
            seen += std::hypot(photo.landmarks_px[k].x - mean.x, photo.landmarks_px[k].y - mean.y);
            const Vec3 away = vertex_of(model_.neutral, model_.landmarks[k]) - middle;
            real += std::hypot(away.x, away.y);
        }
        const double distance = photo.focal_px * real / std::max(seen, 1e-6);
        Pose pose;
        pose.rotation = rotation_about({1, 0, 0}, std::numbers::pi);
        const Vec3 there{(mean.x - photo.centre_px.x) / photo.focal_px * distance,
                         (mean.y - photo.centre_px.y) / photo.focal_px * distance, distance};
        pose.translation = there - rotate(pose.rotation, middle);
        return pose;
    }

    Vec3 on_face(const Unknowns& at, std::size_t photo, std::size_t landmark) const {
        const std::uint32_t vertex = model_.landmarks[landmark];
        Vec3 point = vertex_of(model_.neutral, vertex);
        for (Eigen::Index i = 0; i < identities_; ++i)
            point = point + at.identity[i] * vertex_of(model_.identities[std::size_t(i)], vertex);
        for (Eigen::Index i = 0; i < expressions_; ++i)
            point = point + at.photos[photo].expression[i] *
                                vertex_of(model_.expressions[std::size_t(i)].offsets, vertex);
        return point;
    }

    Vec2 missed(const Unknowns& at, std::size_t photo, std::size_t landmark) const {
        const Vec3 p = at.photos[photo].camera_from_face * on_face(at, photo, landmark);
        const FacePhoto& seen = photos_[photo];
        const double z = std::max(p.z, nearest_mm);
        return {seen.focal_px * p.x / z + seen.centre_px.x - seen.landmarks_px[landmark].x,
                seen.focal_px * p.y / z + seen.centre_px.y - seen.landmarks_px[landmark].y};
    }

    // The cost, and where `form` is wanted also its derivatives.
    double summed(const Unknowns& at, registration::QuadraticForm* form) const {
        double cost = at.identity.squaredNorm() / 2;
        if (form) {
            form->gradient.head(identities_) += at.identity;
            form->information.diagonal().head(identities_).array() += 1;
        }
        if (eyes_) {
            const double miss =
                (eyes_apart(model_, model_.neutral) + eye_moves_.dot(at.identity) - eyes_->mm) /
                eyes_->sigma_mm;
            cost += miss * miss / 2;
            if (form) {
                const Eigen::VectorXd slope = eye_moves_ / eyes_->sigma_mm;
                form->gradient.head(identities_) += miss * slope;
                form->information.topLeftCorner(identities_, identities_) +=
                    slope * slope.transpose();
            }
        }
        for (std::size_t i = 0; i < photos_.size(); ++i) {
            for (Eigen::Index k = 0; k < expressions_; ++k) {
                const double size = at.photos[i].expression[k];
                const double away = size - expected(photos_[i], k), below = std::min(size, 0.0);
                constexpr double weight = 1 / (channel_sigma * channel_sigma);
                constexpr double below_weight = 1 / (negative_sigma * negative_sigma);
                cost += (weight * away * away + below_weight * below * below) / 2;
                if (!form)
                    continue;
                const Eigen::Index place = first_of(i) + 6 + k;
                form->gradient[place] += weight * away + below_weight * below;
                form->information(place, place) += weight + (below < 0 ? below_weight : 0);
            }
            for (std::size_t k = 0; k < landmark_count; ++k)
                cost += add_landmark(at, i, k, form);
        }
        return cost;
    }

    double add_landmark(const Unknowns& at, std::size_t photo, std::size_t landmark,
                        registration::QuadraticForm* form) const {
        const double sigma = landmark < contour_count ? contour_sigma_px : landmark_sigma_px;
        const Vec2 miss = missed(at, photo, landmark);
        const double square = (miss.x * miss.x + miss.y * miss.y) / (sigma * sigma);
        const registration::HuberLoss loss(square, 3);
        if (!form)
            return loss.cost;
        const Pose& pose = at.photos[photo].camera_from_face;
        const Vec3 turned = rotate(pose.rotation, on_face(at, photo, landmark));
        const Vec3 p = turned + pose.translation;
        const double z = std::max(p.z, nearest_mm), f = photos_[photo].focal_px / sigma;
        const auto put = [&](Eigen::MatrixXd& jacobian, Eigen::Index column, Vec3 d) {
            jacobian(0, column) = f * (d.x - p.x / z * d.z) / z;
            jacobian(1, column) = f * (d.y - p.y / z * d.z) / z;
        };
        Eigen::MatrixXd of_person(2, identities_), of_photo(2, per_photo());
        const std::uint32_t vertex = model_.landmarks[landmark];
        for (Eigen::Index i = 0; i < identities_; ++i)
            put(of_person, i,
                rotate(pose.rotation, vertex_of(model_.identities[std::size_t(i)], vertex)));
        constexpr Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int axis = 0; axis < 3; ++axis) {
            put(of_photo, axis, cross(axes[axis], turned));
            put(of_photo, 3 + axis, axes[axis]);
        }
        for (Eigen::Index i = 0; i < expressions_; ++i)
            put(of_photo, 6 + i,
                rotate(pose.rotation,
                       vertex_of(model_.expressions[std::size_t(i)].offsets, vertex)));
        const Eigen::Vector2d residual(miss.x / sigma, miss.y / sigma);
        const Eigen::Index first = first_of(photo), count = per_photo();
        form->gradient.head(identities_) += loss.weight * of_person.transpose() * residual;
        form->gradient.segment(first, count) += loss.weight * of_photo.transpose() * residual;
        form->information.topLeftCorner(identities_, identities_) +=
            loss.weight * of_person.transpose() * of_person;
        form->information.block(first, first, count, count) +=
            loss.weight * of_photo.transpose() * of_photo;
        const Eigen::MatrixXd between = loss.weight * of_person.transpose() * of_photo;
        form->information.block(0, first, identities_, count) += between;
        form->information.block(first, 0, count, identities_) += between.transpose();
        return loss.cost;
    }

    const MorphModel& model_;
    std::span<const FacePhoto> photos_;
    const std::optional<EyeDistance> eyes_;
    const Eigen::Index identities_, expressions_;
    Eigen::VectorXd eye_moves_;  // by one standard deviation of each way in which persons differ
};

bool is_sound(const FacePhoto& photo) {
    if (!(photo.focal_px > 0) || !std::isfinite(photo.focal_px) ||
        !std::isfinite(photo.centre_px.x) || !std::isfinite(photo.centre_px.y))
        return false;
    double spread = 0;
    for (const Vec2 point : photo.landmarks_px) {
        if (!(std::fabs(point.x) < 1e6) || !(std::fabs(point.y) < 1e6))
            return false;
        spread = std::max(spread, std::hypot(point.x - photo.landmarks_px[0].x,
                                             point.y - photo.landmarks_px[0].y));
    }
    return spread > 1;
}

}  // namespace

double eye_distance_mm(const MorphModel& model, std::span<const float> identity) {
    double distance = eyes_apart(model, model.neutral);
    for (std::size_t i = 0; i < std::min(identity.size(), model.identities.size()); ++i)
        distance += double(identity[i]) * eyes_apart(model, model.identities[i]);
    return distance;
}

std::optional<FaceFit> fit_face(const MorphModel& model, std::span<const FacePhoto> photos,
                                std::optional<EyeDistance> eyes) {
    if (photos.empty() || photos.size() > max_photos)
        return std::nullopt;
    if (eyes && !(eyes->mm >= least_eye_distance_mm && eyes->mm <= most_eye_distance_mm &&
                  eyes->sigma_mm > 0))
        return std::nullopt;
    for (const FacePhoto& photo : photos)
        if (!is_sound(photo))
            return std::nullopt;
    const FaceProblem problem(model, photos, eyes);
    Unknowns at = problem.start();
    if (!registration::minimise(problem, at, 60, 1e-6))
        return std::nullopt;
    FaceFit fit;
    for (const double value : at.identity)
        fit.identity.push_back(float(value));
    double square = 0;
    for (std::size_t p = 0; p < at.photos.size(); ++p) {
        const auto& photo = at.photos[p];
        auto& one = fit.photos.emplace_back();
        one.residual_px = problem.residual_px(at, p);
        square += one.residual_px * one.residual_px;
        one.camera_from_face = photo.camera_from_face;
        // Halves of a channel are one again.
        Channels counts{};
        for (std::size_t i = 0; i < model.expressions.size(); ++i) {
            const Channel channel = model.expressions[i].channel;
            one.channels[channel] += float(photo.expression[Eigen::Index(i)]);
            counts[channel] += 1;
        }
        for (std::size_t c = 0; c < channel_count; ++c)
            if (counts[c] > 0)
                one.channels[c] = std::clamp(one.channels[c] / counts[c], 0.F, 1.F);
    }
    fit.residual_px = std::sqrt(square / double(at.photos.size()));
    return fit;
}

Result<std::array<Vec2, landmark_count>> parse_pts(std::string_view text) {
    constexpr std::string_view count = "n_points:";
    const auto skip_blanks = [&] {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    };
    const auto next_number = [&](double& value) {
        skip_blanks();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || !std::isfinite(value) || std::fabs(value) >= 1e6)
            return false;
        text.remove_prefix(std::size_t(end - text.data()));
        return true;
    };
    const std::size_t at = text.find(count);
    if (at == std::string_view::npos)
        return Status::malformed;
    text.remove_prefix(at + count.size());
    double points = 0;
    if (!next_number(points))
        return Status::malformed;
    if (points != double(landmark_count))
        return Status::size_mismatch;
    skip_blanks();
    if (text.empty() || text[0] != '{')
        return Status::malformed;
    text.remove_prefix(1);
    std::array<Vec2, landmark_count> landmarks;
    for (Vec2& point : landmarks)
        if (!next_number(point.x) || !next_number(point.y)) {
            skip_blanks();
            return text.empty() ? Status::truncated : Status::malformed;
        }
    skip_blanks();
    if (text.empty() || text[0] != '}')
        return text.empty() ? Status::truncated : Status::malformed;
    return landmarks;
}

}  // namespace theatron::face
