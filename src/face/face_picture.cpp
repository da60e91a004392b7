// SPDX-License-Identifier: Apache-2.0
#include "face/face_picture.h"

#include <cassert>

#include "face/linear_light.h"
#include "face/raster.h"

namespace theatron::face {
namespace {

// Pixels are drawn this many times finer each way.
constexpr int finer = 2;
constexpr double least_z_mm = 10;
// A pupil, as a share of the iris's width in its texture.
constexpr float pupil = 0.14F;

struct Canvas {
    Size size;
    std::vector<Light> light;
    std::vector<float> depth;

    Canvas(Size s, Rgb background)
        : size(s), light(s.area(), to_linear(background)), depth(s.area(), 1e9F) {}
};

ColorImage shrunk(const Canvas& fine) {
    ColorImage out({fine.size.width / finer, fine.size.height / finer});
    for (int y = 0; y < out.size.height; ++y)
        for (int x = 0; x < out.size.width; ++x) {
            Light sum{};
            for (int k = 0; k < finer * finer; ++k) {
                const auto at = std::size_t(y * finer + k / finer) * std::size_t(fine.size.width) +
                                std::size_t(x * finer + k % finer);
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += fine.light[at][c] / (finer * finer);
            }
            out.view().row(y)[x] = to_srgb(sum);
        }
    return out;
}

}  // namespace

std::array<Rgb, part_count> usual_colors() {
    std::array<Rgb, part_count> colors{};
    colors[std::size_t(HeadPart::skin)] = {198, 160, 138};
    colors[std::size_t(HeadPart::head)] = {186, 148, 127};
    colors[std::size_t(HeadPart::gums)] = {148, 72, 70};
    colors[std::size_t(HeadPart::teeth)] = {226, 218, 202};
    colors[std::size_t(HeadPart::sclera)] = {226, 220, 214};
    colors[std::size_t(HeadPart::iris)] = {94, 76, 58};
    return colors;
}

ColorImage draw_face(const FaceMesh& mesh, const FaceCamera& camera, const FaceLook& look,
                     Size size) {
    assert(is_valid(size));
    Canvas canvas({size.width * finer, size.height * finer}, look.background);
    const std::vector<Vec3> normals = normals_of(mesh);
    std::vector<Vec3> seen(mesh.vertex_count());
    for (std::size_t i = 0; i < seen.size(); ++i)
        seen[i] = camera.project(mesh.point(i));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& corners = mesh.triangles[t];
        std::array<Vec2, 3> at;
        std::array<double, 3> z{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = seen[corners[k]];
            at[k] = {p.x * finer, p.y * finer};
            z[k] = p.z;
        }
        if (std::min({z[0], z[1], z[2]}) < least_z_mm)
            continue;
        // In a picture whose y points down, what is seen from outside turns the other way.
        if ((at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[2].x - at[0].x) * (at[1].y - at[0].y) >=
            0)
            continue;
        const HeadPart part = mesh.part_of(t);
        raster(at, canvas.size, [&](int x, int y, std::array<double, 3> shares) {
            const auto depth = float(to_space(shares, z));
            const auto pixel = std::size_t(y) * std::size_t(canvas.size.width) + std::size_t(x);
            if (depth >= canvas.depth[pixel])
                return;
            canvas.depth[pixel] = depth;
            Vec3 normal;
            float u = 0, v = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                normal = normal + shares[k] * normals[corners[k]];
                u += float(shares[k]) * mesh.places[2 * std::size_t(corners[k])];
                v += float(shares[k]) * mesh.places[2 * std::size_t(corners[k]) + 1];
            }
            Light light = to_linear(look.colors[std::size_t(part)]);
            if (part == HeadPart::skin && look.texture.pixels)
                light = sample(look.texture, u * float(look.texture.size.width),
                               v * float(look.texture.size.height));
            if (part == HeadPart::iris && std::hypot(u - 0.5F, v - 0.5F) < pupil)
                light = {0.01F, 0.01F, 0.01F};
            const double facing =
                std::max(0.0, dot(normal, look.to_light)) / std::max(length(normal), 1e-9);
            for (float& value : light)
                value *= float(1 - look.shade + look.shade * facing);
            canvas.light[pixel] = light;
        });
    }
    return shrunk(canvas);
}

FaceCamera portrait_camera(const FaceMesh& mesh, Size size, double yaw_degrees) {
    Vec3 low = mesh.point(0), high = low;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3 p = mesh.point(i);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 middle = 0.5 * (low + high);
    constexpr double distance_mm = 900, margin = 0.86;
    FaceCamera camera;
    camera.camera_from_face.rotation = rotation_about({1, 0, 0}, std::numbers::pi) *
                                       rotation_about({0, 1, 0}, radians_of(yaw_degrees));
    camera.camera_from_face.translation =
        Vec3{0, 0, distance_mm} - rotate(camera.camera_from_face.rotation, middle);
    camera.focal_px = margin * (distance_mm - 0.5 * (high.z - low.z)) *
                      std::min(size.height / (high.y - low.y), size.width / (high.x - low.x));
    camera.centre_px = {size.width / 2.0, size.height / 2.0};
    return camera;
}

}  // namespace theatron::face
