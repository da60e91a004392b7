// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "cases/case_pictures.h"
#include "medical/mesh_measures.h"

namespace theatron::cases {
namespace {

using medical::Mesh;

// From the front, turned and tilted a little: x of the picture to the patient's left.
constexpr Vec3 to_right{0.94, 0.34, 0};
constexpr Vec3 to_viewer{0.33, -0.91, 0.25};
constexpr Vec3 light{-0.35, -0.72, 0.6};

struct Pixel {
    double depth = -1e30;  // towards the viewer
    Vec3 color{0.055, 0.06, 0.075};
};

class Canvas {
public:
    Canvas(Size size, Vec3 center, double mm_per_pixel)
        : size_(size), center_(center), mm_per_pixel_(mm_per_pixel), pixels_(size.area()) {}

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
        const double diffuse = std::max(0.0, dot(normal, normalized(light)));
        const Vec3 half = normalized(normalized(light) + view_);
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
    Vec3 view_ = normalized(to_viewer);
    Vec3 right_ = normalized(to_right - view_ * dot(to_right, view_));
    Vec3 up_ = cross(view_, right_);
    std::vector<Pixel> pixels_;
};

}  // namespace

ColorImage picture_of_parts(const LoadedCase& loaded, Size size) {
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
    const double width = std::max(high.x - low.x, 1.0), height = std::max(high.z - low.z, 1.0);
    Canvas canvas(size, (low + high) * 0.5,
                  std::max(1.2 * width / size.width, 1.25 * height / size.height));
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
