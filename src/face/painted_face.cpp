// SPDX-License-Identifier: Apache-2.0
#include "face/painted_face.h"

#include <cassert>

#include "face/expression.h"
#include "face/face_texture.h"
#include "face/random.h"

namespace theatron::face {
namespace {

using Polygon = std::vector<Vec2>;  // in texels

Polygon landmarks_of(const MorphModel& model, std::size_t first, std::size_t count) {
    Polygon polygon;
    for (std::size_t i = first; i < first + count; ++i) {
        const float* place = model.places.data() + 2 * std::size_t(model.landmarks[i]);
        polygon.push_back({place[0] * double(texture_side), place[1] * double(texture_side)});
    }
    return polygon;
}

// How far a place is from a line of points.
double distance_to(const Polygon& line, Vec2 p, bool is_closed) {
    double best = 1e9;
    for (std::size_t i = 0; i + (is_closed ? 0 : 1) < line.size(); ++i) {
        const Vec2 a = line[i], b = line[(i + 1) % line.size()];
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double t = std::clamp(
            ((p.x - a.x) * dx + (p.y - a.y) * dy) / std::max(dx * dx + dy * dy, 1e-9), 0.0, 1.0);
        best = std::min(best, std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy));
    }
    return best;
}

bool is_inside(const Polygon& polygon, Vec2 p) {
    bool inside = false;
    for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
        const Vec2 a = polygon[i], b = polygon[k];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

// 1 well inside, 0 outside, with a soft edge.
double cover(const Polygon& polygon, Vec2 p, double soft = 1.5) {
    const double away = distance_to(polygon, p, true);
    return std::clamp(0.5 + (is_inside(polygon, p) ? away : -away) / (2 * soft), 0.0, 1.0);
}

Vec2 middle_of(const Polygon& polygon) {
    Vec2 sum;
    for (const Vec2 p : polygon)
        sum = {sum.x + p.x / double(polygon.size()), sum.y + p.y / double(polygon.size())};
    return sum;
}

void mix(Light& light, Light with, double share) {
    for (std::size_t c = 0; c < 3; ++c)
        light[c] += float(share) * (with[c] - light[c]);
}

struct Spot {
    Vec2 at;
    double radius, strength;
    Light color;
};

// Blotches of the skin, and a few moles: what a mirrored texture would put on the wrong side.
std::vector<Spot> spots_of(Random& random) {
    std::vector<Spot> spots;
    for (int i = 0; i < 40; ++i) {
        const double change = random.between(0.9, 1.12);
        spots.push_back(
            {{random.between(0, texture_side), random.between(0, texture_side)},
             random.between(15, 50),
             0.35,
             {float(0.52 * change), float(0.3 * change * change), float(0.21 * change)}});
    }
    for (int i = 0; i < 14; ++i)
        spots.push_back(
            {{random.between(0.2, 0.8) * texture_side, random.between(0.3, 0.8) * texture_side},
             random.between(2, 4),
             0.8,
             {0.09F, 0.035F, 0.02F}});
    return spots;
}

}  // namespace

PaintedPerson painted_person(const MorphModel& model, std::uint64_t seed) {
    Random random(seed);
    PaintedPerson person;
    for (std::size_t i = 0; i < model.identities.size(); ++i)
        person.identity.push_back(float(random.normal()));
    const auto tone = float(random.between(0.45, 1.1));
    const Light skin{0.56F * tone, 0.33F * tone, 0.23F * tone}, lips{0.42F * tone, 0.12F, 0.11F},
        hair{0.045F, 0.028F, 0.018F}, white{0.72F, 0.69F, 0.65F},
        iris{0.05F, float(random.between(0.05, 0.15)), float(random.between(0.02, 0.25))};
    const std::vector<Spot> spots = spots_of(random);
    const Polygon brows[] = {landmarks_of(model, 17, 5), landmarks_of(model, 22, 5)};
    const Polygon eyes[] = {landmarks_of(model, 36, 6), landmarks_of(model, 42, 6)};
    const Polygon outer = landmarks_of(model, 48, 12), inner = landmarks_of(model, 60, 8);
    const bool has_eyes = model.part_sizes[std::size_t(HeadPart::iris)] > 0;
    const double unit = std::hypot(eyes[0][3].x - eyes[0][0].x, eyes[0][3].y - eyes[0][0].y);
    std::vector<Light> texture(texel_count);
    for (std::size_t i = 0; i < texel_count; ++i) {
        const Vec2 p{double(i % texture_side) + 0.5, double(i / texture_side) + 0.5};
        Light& light = texture[i] = skin;
        for (const Spot& spot : spots) {
            const double away = std::hypot(p.x - spot.at.x, p.y - spot.at.y) / spot.radius;
            if (away < 4)
                mix(light, spot.color, spot.strength * std::exp(-away * away / 2));
        }
        for (const Polygon& brow : brows)
            mix(light, hair,
                0.85 * std::clamp(1.6 - distance_to(brow, p, false) / (0.09 * unit), 0.0, 1.0));
        mix(light, lips, 0.8 * cover(outer, p));
        mix(light, {0.05F, 0.02F, 0.02F}, 0.8 * cover(inner, p));
        for (const Polygon& eye : eyes) {
            mix(light, hair,
                0.7 * std::clamp(1.5 - distance_to(eye, p, true) / (0.04 * unit), 0.0, 1.0));
            if (has_eyes)
                continue;
            const Vec2 middle = middle_of(eye);
            const double away = std::hypot(p.x - middle.x, p.y - middle.y) / unit;
            Light ball = white;
            mix(ball, iris, std::clamp((0.2 - away) * 60, 0.0, 1.0));
            mix(ball, {0.01F, 0.01F, 0.01F}, std::clamp((0.08 - away) * 60, 0.0, 1.0));
            mix(light, ball, cover(eye, p, 1));
        }
    }
    person.texture = texture_of(texture);
    return person;
}

PaintedPhoto painted_photo(const MorphModel& model, const PaintedPerson& person, Emotion emotion,
                           std::uint64_t seed, Size size, double view_degrees, double noise_px) {
    Random random(seed * 2003 + std::uint64_t(emotion));
    PaintedPhoto photo;
    photo.channels = channels_of(emotion);
    const FaceMesh mesh = mesh_of(model, person.identity, photo.channels);
    photo.camera.focal_px = focal_of(size, view_degrees);
    photo.camera.centre_px = {size.width / 2.0, size.height / 2.0};
    photo.camera.camera_from_face.rotation =
        rotation_about({0, 1, 0}, radians_of(random.between(-10, 10))) *
        rotation_about({1, 0, 0}, radians_of(random.between(-6, 6))) *
        rotation_about({0, 0, 1}, radians_of(random.between(-4, 4))) *
        rotation_about({1, 0, 0}, std::numbers::pi);
    // The face takes about half of the picture's height.
    constexpr double face_mm = 230;
    const double distance = photo.camera.focal_px * face_mm / (0.5 * size.height);
    photo.camera.camera_from_face.translation = {random.between(-15, 15), random.between(-15, 15),
                                                 distance * random.between(0.95, 1.1)};
    FaceLook look;
    look.texture = person.texture.view();
    look.colors = usual_colors();
    look.shade = random.between(0.1, 0.3);
    look.to_light = normalized(Vec3{random.between(-0.6, 0.6), random.between(0, 0.7), 1});
    photo.picture = draw_face(mesh, photo.camera, look, size);
    const auto bright = float(random.between(0.8, 1.15)), warm = float(random.between(0.93, 1.07));
    for (Rgb& pixel : photo.picture.pixels) {
        const Light light = to_linear(pixel);
        pixel =
            to_srgb(Light{light[0] * bright * warm, light[1] * bright, light[2] * bright / warm});
    }
    for (std::size_t i = 0; i < landmark_count; ++i) {
        const Vec3 seen = photo.camera.project(mesh.point(model.landmarks[i]));
        photo.landmarks_px[i] = {seen.x + noise_px * random.normal(),
                                 seen.y + noise_px * random.normal()};
    }
    return photo;
}

}  // namespace theatron::face
