// SPDX-License-Identifier: Apache-2.0
#include "render/label_pass.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "render/matrix.h"

namespace theatron::render {
namespace {

// In heights of a capital letter.
constexpr double padding = 0.55, plate_height = 2.0, apart = 0.9, rounding = 0.45;
constexpr Rgb letters{240, 244, 244}, ground{16, 19, 22};
constexpr double ground_opacity = 0.88;
// Surfaces hide names only where they are nearer to the eye by this distance.
constexpr double nearer_m = 0.1;

struct Projected {
    Vec2 pixel;
    double distance_m = 0;  // along the view's axis
};

// Nothing for a place behind the eye.
std::optional<Projected> projected(Vec3 place, const CameraView& view, Size picture) {
    const Vec3 p = inverse(view.room_from_eye) * place;
    if (p.z < view.near_m)
        return std::nullopt;
    return Projected{{(p.x / p.z - view.left) / (view.right - view.left) * picture.width,
                      (p.y / p.z - view.top) / (view.bottom - view.top) * picture.height},
                     p.z};
}

// Clip coordinates from pixels of a picture, whose origin is `origin`, at this distance.
Mat4 clip_from_pixels(Size picture, Vec2 origin, double distance_m, const CameraView& view) {
    const double w = distance_m, n = view.near_m, f = view.far_m;
    const double tested = std::max(w - nearer_m, 1.001 * n);
    const double depth = (f + n) / (f - n) - 2 * f * n / (f - n) / tested;
    return {{2.0 / picture.width * w, 0, 0, 0,    //
             0, -2.0 / picture.height * w, 0, 0,  //
             0, 0, 0, 0,                          //
             (2 * origin.x / picture.width - 1) * w, (1 - 2 * origin.y / picture.height) * w,
             depth * w, w}};
}

}  // namespace

std::vector<std::optional<LabelPlate>> label_plates(const std::vector<SceneLabel>& labels,
                                                    const std::vector<double>& lengths,
                                                    const CameraView& view, Size picture) {
    assert(lengths.size() == labels.size());
    const Rect area{0, 0, double(picture.width), double(picture.height)};
    const double usual = label_height(picture);
    std::vector<std::optional<LabelPlate>> plates(labels.size());
    std::vector<std::size_t> order;
    std::vector<Rect> there;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const auto at = projected(labels[i].place, view, picture);
        if (!at || at->pixel.x < 0 || at->pixel.y < 0 || at->pixel.x > area.width ||
            at->pixel.y > area.height)
            continue;
        const double letter = std::min(usual, area.width / (lengths[i] + 2 * padding));
        plates[i] = LabelPlate{{}, at->pixel, letter};
        order.push_back(i);
        // The label's own place stays in sight, too.
        const double free = 0.5 * apart * usual;
        there.push_back({at->pixel.x - free, at->pixel.y - free, 2 * free, 2 * free});
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return labels[a].rank > labels[b].rank; });
    const std::size_t places = there.size();
    for (const std::size_t i : order) {
        const double letter = plates[i]->letter;
        const Rect plate = label_place(plates[i]->place,
                                       {(lengths[i] + 2 * padding) * letter, plate_height * letter},
                                       apart * letter, area, there);
        const bool covers_labels =
            std::any_of(there.begin() + std::ptrdiff_t(places), there.end(),
                        [&](const Rect& other) { return shared_area(plate, other) > 0; });
        if (covers_labels && labels[i].rank == LabelRank::author) {
            plates[i].reset();
            continue;
        }
        plates[i]->plate = plate;
        there.push_back(plate);
    }
    return plates;
}

LabelPass::LabelPass() = default;

void LabelPass::place(const std::vector<SceneLabel>& labels, const TextPass& text,
                      const CameraView& first, Size picture) {
    std::vector<double> lengths;
    for (const SceneLabel& label : labels)
        lengths.push_back(text.length_of(label.utf8));
    plates_ = label_plates(labels, lengths, first, picture);
}

void LabelPass::draw(const std::vector<SceneLabel>& labels, TextPass& text, const CameraView& view,
                     const DrawTarget& target) const {
    assert(plates_.size() == labels.size());
    std::vector<std::size_t> order(labels.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    // A number is never below another plate.
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return labels[a].rank < labels[b].rank; });
    for (const std::size_t i : order) {
        const auto at = projected(labels[i].place, view, target.size);
        if (!plates_[i] || !at)
            continue;
        const LabelPlate& label = *plates_[i];
        // A name that a screen hides must not be taken for one on its images; a number is always
        // read, and its line shows faintly where it is hidden.
        labels[i].rank == LabelRank::number ? glDisable(GL_DEPTH_TEST) : glEnable(GL_DEPTH_TEST);
        // Whole pixels keep letters sharp.
        const Vec2 corner{std::round(at->pixel.x + label.plate.x - label.place.x),
                          std::round(at->pixel.y + label.plate.y - label.place.y)};
        program_.use();
        glBindVertexArray(nothing_.name());
        set_matrix(clip_from_picture_, clip_from_pixels(target.size, corner, at->distance_m, view));
        glUniform2f(plate_, float(label.plate.width), float(label.plate.height));
        glUniform4f(ground_, float(ground.r) / 255, float(ground.g) / 255, float(ground.b) / 255,
                    float(ground_opacity));
        const Rgb edge = labels[i].color;
        glUniform3f(edge_, float(edge.r) / 255, float(edge.g) / 255, float(edge.b) / 255);
        glUniform2f(shape_, float(rounding * label.letter), float(outline_width(target.size)));
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        const Vec2 base{corner.x + std::round(padding * label.letter),
                        corner.y + std::round((plate_height + 1) / 2 * label.letter)};
        text.draw_line(labels[i].utf8, clip_from_pixels(target.size, base, at->distance_m, view),
                       label.letter, letters);
    }
    glEnable(GL_DEPTH_TEST);
    glBindVertexArray(0);
}

}  // namespace theatron::render
