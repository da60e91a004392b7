// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "cases/case_pictures.h"
#include "medical/mesh_measures.h"

namespace theatron::cases {
namespace {

using medical::Mesh;

// Unit vectors in the patient: the picture's right and up directions, and that to the viewer.
struct Camera {
    Vec3 right, up, viewer;
    Vec3 light() const { return normalized(right * -0.35 + up * 0.6 + viewer * 0.72); }
};

Camera camera_of(PartsView view) {
    constexpr Vec3 head{0, 0, 1}, front{0, -1, 0}, left{1, 0, 0};
    const auto looking = [](Vec3 viewer, Vec3 up) {
        const Vec3 v = normalized(viewer), right = normalized(cross(up, v));
        return Camera{right, cross(v, right), v};
    };
    switch (view) {
        case PartsView::front:
            return looking(front, head);
        case PartsView::back:
            return looking(-front, head);
        case PartsView::left:
            return looking(left, head);
        case PartsView::right:
            return looking(-left, head);
        case PartsView::above:
            return looking(head, front);
        case PartsView::below:
            return looking(-head, front);
        case PartsView::corner:
            break;
    }
    return looking({0.33, -0.91, 0.25}, head);
}

struct Pixel {
    double depth = -1e30;  // towards the viewer
    Vec3 color{0.055, 0.06, 0.075};
};

class Canvas {
public:
    Canvas(Size size, Vec3 center, double mm_per_pixel, const Camera& camera)
        : size_(size),
          center_(center),
          mm_per_pixel_(mm_per_pixel),
          right_(camera.right),
          up_(camera.up),
          view_(camera.viewer),
          light_(camera.light()),
          pixels_(size.area()) {}

    // Draws `mesh`; each pixel keeps the nearest surface.
    void draw(const Mesh& mesh, Rgb color) {
        each_pixel(mesh, [&](std::size_t i, double depth, Vec3 normal) {
            if (depth <= pixels_[i].depth)
                return;
            pixels_[i] = {depth, shaded(color, normal)};
        });
    }

    // Draws a translucent part over the picture: its far side first, then the near one. A surface
    // that is seen at a grazing angle covers more, as a skin does.
    void draw_over(const Mesh& mesh, Rgb color, double opacity) {
        for (const bool near_side : {false, true}) {
            std::vector<Pixel> layer(pixels_.size());
            each_pixel(mesh, [&](std::size_t i, double depth, Vec3 normal) {
                const bool faces = dot(normal, view_) > 0;
                if (faces == near_side && depth > layer[i].depth && depth > pixels_[i].depth) {
                    const double edge = 1 - std::abs(dot(normal, view_));
                    layer[i].depth = depth;
                    const double share = std::min(1.0, opacity * (0.45 + 1.1 * edge * edge));
                    layer[i].color = pixels_[i].color * (1 - share) +
                                     shaded(color, faces ? normal : -normal) * share;
                }
            });
            for (std::size_t i = 0; i < pixels_.size(); ++i)
                if (layer[i].depth > -1e29)
                    pixels_[i].color = layer[i].color;
        }
    }

    ColorImage picture() const {
        ColorImage image(size_);
        const auto byte = [](double v) {
            return std::uint8_t(std::clamp(std::sqrt(std::max(v, 0.0)) * 255, 0.0, 255.0));
        };
        for (std::size_t i = 0; i < pixels_.size(); ++i)
            image.pixels[i] = {byte(pixels_[i].color.x), byte(pixels_[i].color.y),
                               byte(pixels_[i].color.z)};
        return image;
    }

private:
    Vec3 shaded(Rgb color, Vec3 normal) const {
        const double diffuse = std::max(0.0, dot(normal, light_));
        const Vec3 half = normalized(light_ + view_);
        const double gloss = std::pow(std::max(0.0, dot(normal, half)), 40) * 0.25;
        const auto linear = [&](std::uint8_t c) { return (c / 255.0) * (c / 255.0); };
        const Vec3 base{linear(color.r), linear(color.g), linear(color.b)};
        return base * (0.22 + 0.85 * diffuse) + Vec3{gloss, gloss, gloss};
    }

    Vec3 project(medical::Vec3f position) const {
        const Vec3 p = medical::to_double(position) - center_;
        return {size_.width / 2.0 + dot(p, right_) / mm_per_pixel_,
                size_.height / 2.0 - dot(p, up_) / mm_per_pixel_, dot(p, view_)};
    }

    template <class Action>
    void each_pixel(const Mesh& mesh, Action action) const {
        for (const medical::Triangle& t : mesh.triangles) {
            const Vec3 a = project(mesh.positions[t[0]]), b = project(mesh.positions[t[1]]),
                       c = project(mesh.positions[t[2]]);
            const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            if (std::abs(area) < 1e-12)
                continue;
            const int x0 = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}))));
            const int x1 = std::min(size_.width - 1, int(std::floor(std::max({a.x, b.x, c.x}))));
            const int y0 = std::max(0, int(std::ceil(std::min({a.y, b.y, c.y}))));
            const int y1 = std::min(size_.height - 1, int(std::floor(std::max({a.y, b.y, c.y}))));
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x) {
                    const double v = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
                    const double w = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
                    if (v < 0 || w < 0 || v + w > 1)
                        continue;
                    const Vec3 normal = medical::to_double(mesh.normals[t[0]]) * (1 - v - w) +
                                        medical::to_double(mesh.normals[t[1]]) * v +
                                        medical::to_double(mesh.normals[t[2]]) * w;
                    const double l = length(normal);
                    action(std::size_t(y) * std::size_t(size_.width) + std::size_t(x),
                           a.z + (b.z - a.z) * v + (c.z - a.z) * w,
                           l > 1e-9 ? normal * (1 / l) : view_);
                }
        }
    }

    Size size_;
    Vec3 center_;
    double mm_per_pixel_;
    Vec3 right_, up_, view_, light_;
    std::vector<Pixel> pixels_;
};

}  // namespace

ColorImage picture_of_parts(const LoadedCase& loaded, Size size, PartsView view) {
    const Camera camera = camera_of(view);
    Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (std::size_t i = 0; i < loaded.meshes.size(); ++i) {
        if (loaded.manifest.parts[i].opacity == 0)
            continue;
        const medical::Box box = medical::box_of(loaded.meshes[i]);
        low = {std::min(low.x, box.low_mm.x), std::min(low.y, box.low_mm.y),
               std::min(low.z, box.low_mm.z)};
        high = {std::max(high.x, box.high_mm.x), std::max(high.y, box.high_mm.y),
                std::max(high.z, box.high_mm.z)};
    }
    const Vec3 extent = high - low;
    const auto shown = [&](Vec3 axis) {
        return std::max(1.0, std::abs(axis.x) * extent.x + std::abs(axis.y) * extent.y +
                                 std::abs(axis.z) * extent.z);
    };
    constexpr double margin = 1.08;
    const double mm_per_pixel =
        margin * std::max(shown(camera.right) / size.width, shown(camera.up) / size.height);
    Canvas canvas(size, (low + high) * 0.5, mm_per_pixel, camera);
    for (std::size_t i = 0; i < loaded.meshes.size(); ++i)
        if (loaded.manifest.parts[i].opacity == 1)
            canvas.draw(loaded.meshes[i], loaded.manifest.parts[i].color);
    for (std::size_t i = 0; i < loaded.meshes.size(); ++i) {
        const medical::Part& part = loaded.manifest.parts[i];
        if (part.opacity > 0 && part.opacity < 1)
            canvas.draw_over(loaded.meshes[i], part.color, part.opacity);
    }
    return canvas.picture();
}

}  // namespace theatron::cases
