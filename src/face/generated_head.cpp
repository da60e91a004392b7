// SPDX-License-Identifier: Apache-2.0
// The head of our own making: a grid bent round an ellipsoid, with smooth hills where a face has
// features. Each way in which persons differ and each expression is a sum of smooth hills, too.
#include <algorithm>
#include <cmath>

#include "face/morph_model.h"

namespace theatron::face {
namespace {

constexpr int columns = 61, rows = 61;
constexpr double half_width_mm = 72, half_height_mm = 112, half_depth_mm = 95;
constexpr double last_angle = radians_of(100);  // from the middle of the face to the ears

// A hill at (x, y) of the face seen from the front, in millimetres, moved by `move`.
struct Hill {
    double x, y, width, height;
    Vec3 move;
};

double weight_of(const Hill& hill, Vec3 at) {
    const double dx = (at.x - hill.x) / hill.width, dy = (at.y - hill.y) / hill.height;
    return at.z < 0 ? 0 : std::exp(-(dx * dx + dy * dy) / 2);
}

// The same on the other side of the face.
Hill mirrored(const Hill& hill) {
    return {-hill.x, hill.y, hill.width, hill.height, {-hill.move.x, hill.move.y, hill.move.z}};
}

using Hills = std::vector<Hill>;

Hills both_sides(const Hills& left) {
    Hills all = left;
    for (const Hill& hill : left)
        all.push_back(mirrored(hill));
    return all;
}

// Eyes at y 25, the tip of the nose at -15, the mouth at -48, the chin at -90.
constexpr double eye_x = 32, eye_y = 25, brow_y = 45, nose_y = -15, mouth_y = -48, chin_y = -88;

Hills features() {
    Hills all = both_sides({{eye_x, eye_y, 12, 8, {0, 0, -9}},
                            {eye_x, brow_y, 20, 6, {0, 0, 4}},
                            {48, -10, 14, 16, {0, 0, 5}},
                            {12, nose_y - 4, 5, 6, {2, 0, 9}}});
    const Hills middle = {{0, 5, 6, 18, {0, 0, 9}},
                          {0, nose_y, 8, 9, {0, 0, 18}},
                          {0, mouth_y + 5, 16, 4, {0, 0, 5}},
                          {0, mouth_y - 6, 14, 4, {0, 0, 5}},
                          {0, chin_y + 6, 15, 12, {0, 0, 9}}};
    all.insert(all.end(), middle.begin(), middle.end());
    return all;
}

Vec3 on_ellipsoid(int column, int row) {
    const double across = last_angle * (2.0 * column / (columns - 1) - 1);
    const double up = radians_of(80) * (1 - 2.0 * row / (rows - 1));
    // The jaw is narrower than the forehead.
    const double narrow = 1 - 0.22 * std::pow(std::max(0.0, -std::sin(up)), 2);
    return {half_width_mm * narrow * std::cos(up) * std::sin(across), half_height_mm * std::sin(up),
            half_depth_mm * std::cos(up) * std::cos(across)};
}

std::vector<float> offsets_of(const std::vector<Vec3>& base, const Hills& hills) {
    std::vector<float> offsets;
    offsets.reserve(base.size() * 3);
    for (const Vec3 at : base) {
        Vec3 sum;
        for (const Hill& hill : hills)
            sum = sum + weight_of(hill, at) * hill.move;
        for (const double value : {sum.x, sum.y, sum.z})
            offsets.push_back(float(value));
    }
    return offsets;
}

std::vector<float> stretched(const std::vector<Vec3>& base, Vec3 share) {
    std::vector<float> offsets;
    for (const Vec3 at : base)
        for (const double value : {at.x * share.x, at.y * share.y, at.z * share.z})
            offsets.push_back(float(value));
    return offsets;
}

// Ways in which persons differ, as large as one standard deviation.
std::vector<std::vector<float>> differences(const std::vector<Vec3>& base) {
    std::vector<std::vector<float>> all = {stretched(base, {0.05, 0, 0}),
                                           stretched(base, {0, 0.05, 0}),
                                           stretched(base, {0, 0, 0.05})};
    const std::vector<Hills> local = {
        {{0, nose_y, 9, 10, {0, 0, 2.5}}},                  // length of the nose
        {{0, nose_y, 9, 10, {0, 2.5, 0}}},                  // height of its tip
        both_sides({{12, nose_y - 4, 7, 8, {1.5, 0, 0}}}),  // its width
        {{0, 5, 7, 16, {0, 0, 2}}},                         // its back
        both_sides({{eye_x, eye_y, 20, 14, {2, 0, 0}}}),    // distance of the eyes
        both_sides({{eye_x, eye_y, 20, 14, {0, 2, 0}}}),    // their height
        both_sides({{48, -70, 22, 26, {3.5, 0, 0}}}),       // width of the jaw
        {{0, chin_y, 22, 18, {0, -3, 0}}},                  // length of the chin
        {{0, chin_y, 20, 16, {0, 0, 3}}},                   // how far it stands out
        both_sides({{46, -8, 20, 20, {1, 0, 2.5}}}),        // cheeks
        {{0, mouth_y, 26, 14, {0, 2, 0}}},                  // height of the mouth
        both_sides({{24, mouth_y, 12, 12, {2, 0, 0}}}),     // its width
        {{0, 80, 45, 30, {0, 0, 3}}},                       // forehead
    };
    for (const Hills& hills : local)
        all.push_back(offsets_of(base, hills));
    return all;
}

// The hills that a channel moves on the left side, or in the middle.
Hills left_hills(std::string_view name) {
    struct Move {
        std::string_view name;
        Hills hills;
    };
    static const std::vector<Move> moves = {
        {"eyeBlink", {{eye_x, eye_y + 4, 12, 3.5, {0, -7, 1}}}},
        {"eyeSquint", {{eye_x, eye_y - 5, 12, 4, {0, 4, 0}}}},
        {"eyeWide", {{eye_x, eye_y + 5, 12, 4, {0, 4, 0}}}},
        {"browDown", {{eye_x - 6, brow_y, 18, 7, {-2, -7, 0}}}},
        {"browOuterUp", {{eye_x + 12, brow_y, 14, 8, {0, 8, 0}}}},
        {"cheekSquint", {{42, 4, 14, 10, {0, 5, 3}}}},
        {"noseSneer", {{12, -4, 7, 12, {1, 5, 2}}}},
        {"mouthSmile", {{24, mouth_y, 10, 10, {8, 9, -3}}, {42, -20, 12, 12, {0, 3, 3}}}},
        {"mouthFrown", {{24, mouth_y, 10, 9, {2, -9, 0}}}},
        {"mouthDimple", {{26, mouth_y, 9, 8, {4, 0, -4}}}},
        {"mouthStretch", {{24, mouth_y, 11, 10, {9, -2, -3}}}},
        {"mouthPress", {{16, mouth_y, 10, 6, {0, 0, -3}}}},
        {"mouthLowerDown", {{10, mouth_y - 6, 9, 5, {0, -7, 0}}}},
        {"mouthUpperUp", {{10, mouth_y + 6, 9, 5, {0, 7, 0}}}},
        {"eyeLookUp", {{eye_x, eye_y + 4, 10, 3, {0, 1.5, 0}}}},
        {"eyeLookDown", {{eye_x, eye_y + 4, 10, 3, {0, -2, 0}}}},
        {"jawForward", {{0, -78, 40, 22, {0, 0, 9}}}},
        {"jawOpen", {{0, chin_y, 38, 20, {0, -22, -5}}, {0, mouth_y - 7, 14, 5, {0, -10, 0}}}},
        {"jawLeft", {{0, -80, 36, 22, {9, 0, 0}}}},
        {"jawRight", {{0, -80, 36, 22, {-9, 0, 0}}}},
        {"mouthLeft", {{0, mouth_y, 24, 12, {9, 0, 0}}}},
        {"mouthRight", {{0, mouth_y, 24, 12, {-9, 0, 0}}}},
        {"mouthClose", {{0, mouth_y - 6, 14, 5, {0, 8, 0}}}},
        {"mouthFunnel",
         {{24, mouth_y, 10, 9, {-7, 0, 3}},
          {-24, mouth_y, 10, 9, {7, 0, 3}},
          {0, mouth_y, 14, 10, {0, 0, 7}}}},
        {"mouthPucker",
         {{24, mouth_y, 10, 9, {-10, 0, 4}},
          {-24, mouth_y, 10, 9, {10, 0, 4}},
          {0, mouth_y, 12, 8, {0, 0, 8}}}},
        {"mouthRollLower", {{0, mouth_y - 6, 16, 4, {0, 3, -5}}}},
        {"mouthRollUpper", {{0, mouth_y + 5, 16, 4, {0, -3, -5}}}},
        {"mouthShrugLower", {{0, -64, 18, 12, {0, 6, 3}}}},
        {"mouthShrugUpper", {{0, mouth_y + 6, 16, 6, {0, 4, 2}}}},
        {"browInnerUp", {{12, brow_y, 12, 8, {0, 8, 0}}, {-12, brow_y, 12, 8, {0, 8, 0}}}},
        {"cheekPuff", {{40, -36, 16, 16, {6, 0, 6}}, {-40, -36, 16, 16, {-6, 0, 6}}}},
    };
    for (const Move& move : moves)
        if (move.name == name)
            return move.hills;
    return {};
}

std::vector<MorphModel::Expression> movements(const std::vector<Vec3>& base) {
    std::vector<MorphModel::Expression> all;
    for (std::size_t c = 0; c < channel_count; ++c) {
        const std::string_view name = channel_names[c];
        const auto side = [&](std::string_view word) {
            return name.size() > word.size() && name.substr(name.size() - word.size()) == word
                       ? name.substr(0, name.size() - word.size())
                       : std::string_view();
        };
        Hills hills = left_hills(name);
        if (hills.empty())
            hills = left_hills(side("Left"));
        if (hills.empty())
            for (const Hill& hill : left_hills(side("Right")))
                hills.push_back(mirrored(hill));
        // Sideways gaze and the tongue move no skin.
        if (!hills.empty())
            all.push_back({Channel(c), offsets_of(base, hills)});
    }
    return all;
}

// Where the 68 points are on the mean face, seen from the front.
std::array<Vec2, landmark_count> landmark_places() {
    std::array<Vec2, landmark_count> places{};
    for (int i = 0; i < 17; ++i) {  // from the right ear round the chin to the left one
        const double angle = radians_of(180.0 * i / 16);
        places[std::size_t(i)] = {-62 * std::cos(angle), 15 - 108 * std::sin(angle)};
    }
    const auto set = [&](std::size_t first, std::initializer_list<Vec2> points) {
        std::copy(points.begin(), points.end(), places.begin() + std::ptrdiff_t(first));
    };
    set(17, {{-48, 40}, {-40, 46}, {-31, 48}, {-22, 47}, {-13, 44}});
    set(22, {{13, 44}, {22, 47}, {31, 48}, {40, 46}, {48, 40}});
    set(27, {{0, 24}, {0, 11}, {0, -2}, {0, -14}});
    set(31, {{-13, -21}, {-7, -23}, {0, -25}, {7, -23}, {13, -21}});
    set(36, {{-44, 25}, {-36, 30}, {-28, 30}, {-20, 25}, {-28, 21}, {-36, 21}});
    set(42, {{20, 25}, {28, 30}, {36, 30}, {44, 25}, {36, 21}, {28, 21}});
    set(48, {{-25, -48},
             {-16, -43},
             {-7, -40},
             {0, -42},
             {7, -40},
             {16, -43},
             {25, -48},
             {16, -54},
             {8, -57},
             {0, -58},
             {-8, -57},
             {-16, -54}});
    set(60, {{-21, -48}, {-8, -46}, {0, -46}, {8, -46}, {21, -48}, {8, -50}, {0, -50}, {-8, -50}});
    return places;
}

}  // namespace

MorphModel generated_head() {
    MorphModel model;
    std::vector<Vec3> base;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            base.push_back(on_ellipsoid(column, row));
    const std::vector<float> relief = offsets_of(base, features());
    for (std::size_t i = 0; i < base.size(); ++i) {
        const float* move = relief.data() + 3 * i;
        base[i] = base[i] + Vec3{move[0], move[1], move[2]};
        for (const double value : {base[i].x, base[i].y, base[i].z})
            model.neutral.push_back(float(value));
    }
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = row * columns + column, b = a + columns;
            model.triangles.push_back({a, b, b + 1});
            model.triangles.push_back({a, b + 1, a + 1});
        }
    model.part_sizes[std::size_t(HeadPart::skin)] = std::uint32_t(model.triangles.size());
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            model.places.push_back(float(column) / (columns - 1));
            model.places.push_back(float(row) / (rows - 1));
        }
    model.identities = differences(base);
    model.expressions = movements(base);
    const auto places = landmark_places();
    for (std::size_t i = 0; i < landmark_count; ++i) {
        double best = 1e9;
        for (std::size_t v = 0; v < base.size(); ++v) {
            const double dx = base[v].x - places[i].x, dy = base[v].y - places[i].y;
            if (base[v].z > 0 && dx * dx + dy * dy < best) {
                best = dx * dx + dy * dy;
                model.landmarks[i] = std::uint32_t(v);
            }
        }
    }
    return model;
}

}  // namespace theatron::face
