// SPDX-License-Identifier: Apache-2.0
// The 68 landmarks of a photo while a person marks them.
//
// Eight places are asked for, one after the other. The other landmarks follow them: a usual face is
// bent to the places that are known (a thin-plate spline; Bookstein, IEEE PAMI 1989). Each landmark
// can be moved, and stays where it was put. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "face/emotion.h"
#include "face/morph_model.h"

namespace theatron::face {

using Landmarks = std::array<Vec2, landmark_count>;

// The landmarks of the model's mean person with this emotion, seen from the front: millimetres, y
// down.
Landmarks usual_landmarks(const MorphModel& model, Emotion emotion);

// Lines of landmarks that are drawn as one: jaw, brows, nose, eyes, lips.
struct LandmarkLine {
    std::uint8_t first = 0, last = 0;
    bool is_closed = false;
};
inline constexpr std::array<LandmarkLine, 9> landmark_lines = {{{0, 16, false},
                                                                {17, 21, false},
                                                                {22, 26, false},
                                                                {27, 30, false},
                                                                {31, 35, false},
                                                                {36, 41, true},
                                                                {42, 47, true},
                                                                {48, 59, true},
                                                                {60, 67, true}}};

class LandmarkDraft {
public:
    // Left and right are those of the picture. The chin is its lowest point.
    enum class Place : std::uint8_t {
        left_eye_outer,
        left_eye_inner,
        right_eye_inner,
        right_eye_outer,
        nose_tip,
        left_mouth_corner,
        right_mouth_corner,
        chin
    };
    static constexpr std::size_t place_count = 8;

    // `usual` as usual_landmarks() gives them.
    explicit LandmarkDraft(const Landmarks& usual) : usual_(usual) {}

    // The place that is asked for next; nullopt: all are put, and the landmarks are there.
    std::optional<Place> next() const;
    // Puts it. Without one, nothing happens.
    void put(Vec2 photo_px);
    // Landmarks that were found in the photo: they take the place of all that was put.
    void take(const Landmarks& photo_px);
    // The landmark stays there from now on. Before all places are put only those can be moved.
    // `goes_on`: the movement of the last call goes on, as a drag does; undo() takes both back.
    void move(std::size_t landmark, Vec2 photo_px, bool goes_on = false);
    // Takes back the newest put() or move(). False: there is nothing to take back.
    bool undo();

    // The landmark next to this place, within `reach_px` of the photo; of those that are shown.
    std::optional<std::size_t> near(Vec2 photo_px, double reach_px) const;
    // Before all places are put, those alone are shown; then all landmarks.
    bool is_shown(std::size_t landmark) const;
    // nullopt while a place is asked for.
    std::optional<Landmarks> landmarks_px() const;
    // The place of a landmark that is shown.
    Vec2 point(std::size_t landmark) const { return points_[landmark]; }

private:
    struct Step {
        std::size_t landmark = 0;
        std::optional<Vec2> was;  // where it had been put before
    };

    void set(std::size_t landmark, std::optional<Vec2> place);
    void bend();

    const Landmarks usual_;
    std::array<std::optional<Vec2>, landmark_count> put_;
    Landmarks points_{};
    std::vector<Step> steps_;
};

}  // namespace theatron::face
