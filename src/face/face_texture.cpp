// SPDX-License-Identifier: Apache-2.0
#include "face/face_texture.h"

#include <cassert>
#include <map>
#include <numbers>
#include <tuple>

#include "face/raster.h"

namespace theatron::face {
namespace {

constexpr Size texture_size{texture_side, texture_side};
constexpr double least_depth_mm = 10;
// Sides of the picture of depths: no finer than needed.
constexpr double most_depth_side = 1024;
// A texel this much behind the nearest surface is hidden.
constexpr float hidden_mm = 3;
// Cosines of the angle between skin and view: from the lower one on a texel is seen at all, from
// the higher one on it is seen as well as from the front.
constexpr double least_facing = 0.25, full_facing = 0.7;
// How far from its mirror image a texel may be.
constexpr double mirror_mm = 4;
// Texels of this weight are taken as they are seen.
constexpr double known_well = 0.3;
// Skin this near to the outline of the head, as a share of its height, is not taken.
constexpr double rim_share = 0.025;
constexpr std::size_t least_part_pixels = 20;
constexpr float least_gain = 0.5F, most_gain = 2;

float smooth_step(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return float(t * t * (3 - 2 * t));
}

// Corners of a triangle in a picture, and their depths.
struct SeenTriangle {
    std::array<Vec2, 3> at;
    std::array<double, 3> z{};
    bool is_ahead = true;
};

SeenTriangle seen_triangle(const FaceMesh& mesh, const FaceCamera& camera,
                           const std::array<std::uint32_t, 3>& corners) {
    SeenTriangle seen;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = camera.project(mesh.point(corners[k]));
        seen.at[k] = {p.x, p.y};
        seen.z[k] = p.z;
        seen.is_ahead = seen.is_ahead && p.z >= least_depth_mm;
    }
    return seen;
}

// The nearest surface of a face in a picture, of the part of the picture that shows it.
class DepthPicture {
public:
    DepthPicture(const FaceMesh& mesh, const FaceCamera& camera) {
        Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const Vec3 p = camera.project(mesh.point(i));
            if (p.z < least_depth_mm)
                continue;
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        const double wide = std::max({high.x - low.x, high.y - low.y, 1.0});
        scale_ = std::min(1.0, most_depth_side / wide);
        low_ = low;
        size_ = {int(std::max(0.0, high.x - low.x) * scale_) + 1,
                 int(std::max(0.0, high.y - low.y) * scale_) + 1};
        depth_.assign(size_.area(), 1e9F);
        triangle_.assign(size_.area(), TextureMap::nothing);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            SeenTriangle seen = seen_triangle(mesh, camera, mesh.triangles[t]);
            if (!seen.is_ahead)
                continue;
            for (Vec2& at : seen.at)
                at = {(at.x - low_.x) * scale_, (at.y - low_.y) * scale_};
            raster(seen.at, size_, [&](int x, int y, std::array<double, 3> shares) {
                const auto z = float(to_space(shares, seen.z));
                const auto pixel = std::size_t(y) * std::size_t(size_.width) + std::size_t(x);
                if (z >= depth_[pixel])
                    return;
                depth_[pixel] = z;
                triangle_[pixel] = std::uint32_t(t);
            });
        }
    }

    bool hides(Vec3 seen) const {
        const auto pixel = pixel_of(seen);
        return !pixel || float(seen.z) > depth_[*pixel] + hidden_mm;
    }
    // The background is so near to this place that a face which was fitted a little too large would
    // have it on its skin.
    bool is_on_rim(Vec3 seen, double share = rim_share) const {
        const double radius = share * std::max(size_.width, size_.height) / scale_;
        for (int k = 0; k < 8; ++k) {
            const double turn = k * std::numbers::pi / 4;
            const auto pixel = pixel_of(
                {seen.x + radius * std::cos(turn), seen.y + radius * std::sin(turn), seen.z});
            if (!pixel || triangle_[*pixel] == TextureMap::nothing)
                return true;
        }
        return false;
    }
    // Calls visit(x, y, triangle) for each pixel of the face, in places of the whole picture.
    template <class Visit>
    void for_each_pixel(Visit&& visit) const {
        for (std::size_t i = 0; i < triangle_.size(); ++i)
            if (triangle_[i] != TextureMap::nothing)
                visit(low_.x + (double(i % std::size_t(size_.width)) + 0.5) / scale_,
                      low_.y + (double(i / std::size_t(size_.width)) + 0.5) / scale_, triangle_[i]);
    }

private:
    std::optional<std::size_t> pixel_of(Vec3 seen) const {
        const double x = (seen.x - low_.x) * scale_, y = (seen.y - low_.y) * scale_;
        if (!(x >= 0 && y >= 0 && x < size_.width && y < size_.height))
            return std::nullopt;
        return std::size_t(y) * std::size_t(size_.width) + std::size_t(x);
    }

    Size size_;
    Vec2 low_;
    double scale_ = 1;
    std::vector<float> depth_;
    std::vector<std::uint32_t> triangle_;
};

// The middle of `span` pixels a side round a place, so that a large photo makes no false patterns.
Light averaged(ColorView photo, double x, double y, int span) {
    Light sum{};
    for (int i = 0; i < span * span; ++i) {
        const Light one =
            sample(photo, x + i % span - (span - 1) / 2.0, y + int(i / span) - (span - 1) / 2.0);
        for (std::size_t k = 0; k < 3; ++k)
            sum[k] += one[k] / float(span * span);
    }
    return sum;
}

// Light without a weight is taken smoothly from round it: coarser and coarser pictures of what is
// known, and back. (Gortler et al., "The Lumigraph", SIGGRAPH 1996.)
void fill_smoothly(std::vector<Light>& light, std::vector<float> weights, int width) {
    if (width == 1)
        return;
    const int half = width / 2;
    std::vector<Light> coarse(std::size_t(half) * std::size_t(half));
    std::vector<float> coarse_weights(coarse.size());
    const auto each = [&](auto&& visit) {
        for (int y = 0; y < half; ++y)
            for (int x = 0; x < half; ++x)
                for (int k = 0; k < 4; ++k)
                    visit(std::size_t(y) * std::size_t(half) + std::size_t(x),
                          std::size_t(2 * y + k / 2) * std::size_t(width) +
                              std::size_t(2 * x + k % 2));
    };
    each([&](std::size_t of, std::size_t from) {
        for (std::size_t c = 0; c < 3; ++c)
            coarse[of][c] += weights[from] * light[from][c];
        coarse_weights[of] += weights[from];
    });
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        for (float& value : coarse[i])
            value /= std::max(coarse_weights[i], 1e-9F);
        coarse_weights[i] = std::min(coarse_weights[i], 1.F);
    }
    fill_smoothly(coarse, coarse_weights, half);
    const auto at = [&](int x, int y) -> const Light& {
        x = std::clamp(x, 0, half - 1);
        y = std::clamp(y, 0, half - 1);
        return coarse[std::size_t(y) * std::size_t(half) + std::size_t(x)];
    };
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x) {
            const auto to = std::size_t(y) * std::size_t(width) + std::size_t(x);
            const float known = std::min(weights[to], 1.F);
            if (known >= 1)
                continue;
            // Three quarters of the nearer one each way.
            const int cx = x / 2, cy = y / 2, nx = cx + (x % 2 ? 1 : -1),
                      ny = cy + (y % 2 ? 1 : -1);
            for (std::size_t c = 0; c < 3; ++c) {
                const float smooth = 0.75F * (0.75F * at(cx, cy)[c] + 0.25F * at(nx, cy)[c]) +
                                     0.25F * (0.75F * at(cx, ny)[c] + 0.25F * at(nx, ny)[c]);
                light[to][c] = known * light[to][c] + (1 - known) * smooth;
            }
        }
}

// `own` where it is seen, and elsewhere `other`, changed by what differs where both are.
std::vector<Light> joined(const TexturePart& own, const TexturePart& other) {
    std::vector<Light> differences(texel_count);
    std::vector<float> known(texel_count);
    for (std::size_t i = 0; i < texel_count; ++i) {
        known[i] = own.weights[i] * other.weights[i];
        for (std::size_t c = 0; c < 3; ++c)
            differences[i][c] = own.light[i][c] - other.light[i][c];
    }
    fill_smoothly(differences, known, texture_side);
    std::vector<Light> result(texel_count);
    for (std::size_t i = 0; i < texel_count; ++i) {
        const float own_share = own.weights[i];
        const float other_share = (1 - own_share) * other.weights[i];
        for (std::size_t c = 0; c < 3; ++c)
            result[i][c] = (own_share * own.light[i][c] +
                            other_share * (other.light[i][c] + differences[i][c])) /
                           std::max(own_share + other_share, 1e-9F);
    }
    return result;
}

Vec3 point_of(const FaceMesh& mesh, const TextureMap::Texel& texel) {
    const auto& corners = mesh.triangles[texel.triangle];
    return (1 - double(texel.of_b) - double(texel.of_c)) * mesh.point(corners[0]) +
           double(texel.of_b) * mesh.point(corners[1]) +
           double(texel.of_c) * mesh.point(corners[2]);
}

}  // namespace

TextureMap::TextureMap(const MorphModel& model)
    : texels_(texel_count), mirrored_(texel_count, nothing) {
    const FaceMesh mesh = mesh_of(model, {}, Channels{});
    for (std::size_t t = 0; t < mesh.skin_size(); ++t) {
        std::array<Vec2, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = mesh.triangles[t][k];
            at[k] = {mesh.places[2 * corner] * double(texture_side),
                     mesh.places[2 * corner + 1] * double(texture_side)};
        }
        raster(at, texture_size, [&](int x, int y, const std::array<double, 3>& shares) {
            texels_[std::size_t(y) * texture_side + std::size_t(x)] = {
                std::uint32_t(t), float(shares[1]), float(shares[2])};
        });
    }
    // Texels by the cell of space in which they are.
    const auto cell_of = [](Vec3 p) {
        return std::tuple(int(std::floor(p.x / mirror_mm)), int(std::floor(p.y / mirror_mm)),
                          int(std::floor(p.z / mirror_mm)));
    };
    std::map<std::tuple<int, int, int>, std::vector<std::uint32_t>> cells;
    std::vector<Vec3> points(texel_count);
    for (std::size_t i = 0; i < texel_count; ++i)
        if (texels_[i].triangle != nothing) {
            points[i] = point_of(mesh, texels_[i]);
            cells[cell_of(points[i])].push_back(std::uint32_t(i));
        }
    for (std::size_t i = 0; i < texel_count; ++i) {
        if (texels_[i].triangle == nothing)
            continue;
        const Vec3 wanted{-points[i].x, points[i].y, points[i].z};
        const auto [cx, cy, cz] = cell_of(wanted);
        double best = mirror_mm * mirror_mm;
        for (int k = 0; k < 27; ++k) {
            const auto found = cells.find({cx + k % 3 - 1, cy + k / 3 % 3 - 1, cz + k / 9 - 1});
            if (found == cells.end())
                continue;
            for (const std::uint32_t other : found->second) {
                const Vec3 away = points[other] - wanted;
                if (dot(away, away) < best) {
                    best = dot(away, away);
                    mirrored_[i] = other;
                }
            }
        }
    }
}

namespace {

// In this share of the face at its rim only colour tells skin from background: landmarks are a few
// per cent of the face off, more so those of the jaw.
constexpr double doubtful_rim_share = 4 * rim_share;
// Natural logarithms of ratios: skin in shade and in light differs by less from the face's usual
// brightness and colour.
constexpr float most_brightness_ratio = 0.9F, most_color_ratio = 0.5F;

// Red, green and blue that half of the seen texels exceed.
Light usual_light(const TexturePart& part) {
    Light usual{};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (std::size_t i = 0; i < texel_count; ++i)
            if (part.weights[i] > 0.5F)
                values.push_back(part.light[i][c]);
        if (values.empty())
            return usual;
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        usual[c] = *middle;
    }
    return usual;
}

bool is_like_skin(const Light& light, const Light& usual) {
    constexpr float least = 1e-3F;
    std::array<float, 3> ratio{};
    for (std::size_t c = 0; c < 3; ++c)
        ratio[c] = std::log(std::max(light[c], least) / std::max(usual[c], least));
    const float brightness = (ratio[0] + ratio[1] + ratio[2]) / 3;
    return std::fabs(brightness) < most_brightness_ratio &&
           std::fabs(ratio[0] - ratio[2]) < most_color_ratio;
}

// One of the texels round this one, which mix skin and background, or itself.
bool has_near(const std::vector<bool>& is_background, std::size_t texel) {
    constexpr int reach = 7;
    const int x = int(texel % texture_side), y = int(texel / texture_side);
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, texture_side - 1); ++v)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, texture_side - 1); ++u)
            if (is_background[std::size_t(v) * texture_side + std::size_t(u)])
                return true;
    return false;
}

}  // namespace

TexturePart unwrap_photo(const TextureMap& map, const FaceMesh& mesh, const FaceCamera& camera,
                         ColorView photo) {
    std::vector<std::size_t> doubtful;
    TexturePart part{std::vector<Light>(texel_count), std::vector<float>(texel_count)};
    const DepthPicture depth(mesh, camera);
    const std::vector<Vec3> normals = normals_of(mesh);
    const Vec3 eye = inverse(camera.camera_from_face).translation;
    // A texel of the middle of the face, in pixels of the photo.
    double left = 1e9, right = -1e9;
    for (const auto& corners : std::span(mesh.triangles).first(mesh.skin_size())) {
        const double x = camera.project(mesh.point(corners[0])).x;
        left = std::min(left, x);
        right = std::max(right, x);
    }
    const int span = std::clamp(int((right - left) / texture_side + 0.5), 1, 16);
    for (std::size_t i = 0; i < texel_count; ++i) {
        const TextureMap::Texel& texel = map.texels()[i];
        if (texel.triangle == TextureMap::nothing)
            continue;
        const auto& corners = mesh.triangles[texel.triangle];
        const Vec3 point = point_of(mesh, texel), seen = camera.project(point);
        if (!(seen.z >= least_depth_mm) || !(seen.x >= 1 && seen.x < photo.size.width - 1) ||
            !(seen.y >= 1 && seen.y < photo.size.height - 1) || depth.hides(seen) ||
            depth.is_on_rim(seen))
            continue;
        const Vec3 normal = (1 - double(texel.of_b) - double(texel.of_c)) * normals[corners[0]] +
                            double(texel.of_b) * normals[corners[1]] +
                            double(texel.of_c) * normals[corners[2]];
        const Vec3 view = eye - point;
        const double facing = dot(normal, view) / std::max(length(normal) * length(view), 1e-9);
        part.weights[i] = smooth_step(least_facing, full_facing, facing);
        if (part.weights[i] > 0) {
            part.light[i] = averaged(photo, seen.x, seen.y, span);
            if (depth.is_on_rim(seen, doubtful_rim_share))
                doubtful.push_back(i);
        }
    }
    const Light usual = usual_light(part);
    std::vector<bool> is_background(texel_count);
    for (const std::size_t texel : doubtful)
        is_background[texel] = !is_like_skin(part.light[texel], usual);
    for (const std::size_t texel : doubtful)
        if (has_near(is_background, texel))
            part.weights[texel] = 0;
    return part;
}

std::array<std::optional<Rgb>, part_count> colors_of_parts(const FaceMesh& mesh,
                                                           const FaceCamera& camera,
                                                           ColorView photo) {
    std::array<std::array<std::vector<std::uint8_t>, 3>, part_count> values;
    DepthPicture(mesh, camera).for_each_pixel([&](double x, double y, std::size_t triangle) {
        if (!(x >= 0 && x < photo.size.width) || !(y >= 0 && y < photo.size.height))
            return;
        const Rgb pixel = photo.row(int(y))[int(x)];
        auto& of_part = values[std::size_t(mesh.part_of(triangle))];
        of_part[0].push_back(pixel.r);
        of_part[1].push_back(pixel.g);
        of_part[2].push_back(pixel.b);
    });
    std::array<std::optional<Rgb>, part_count> colors;
    for (std::size_t i = 0; i < part_count; ++i) {
        if (values[i][0].size() < least_part_pixels)
            continue;
        const std::size_t middle = values[i][0].size() / 2;
        for (auto& one : values[i])
            std::nth_element(one.begin(), one.begin() + std::ptrdiff_t(middle), one.end());
        colors[i] = Rgb{values[i][0][middle], values[i][1][middle], values[i][2][middle]};
    }
    return colors;
}

std::vector<Light> completed(const TextureMap& map, const TexturePart& seen) {
    TexturePart other{std::vector<Light>(texel_count), std::vector<float>(texel_count)};
    for (std::size_t i = 0; i < texel_count; ++i)
        if (const std::uint32_t from = map.mirrored(i); from != TextureMap::nothing) {
            other.light[i] = seen.light[from];
            other.weights[i] = seen.weights[from];
        }
    std::vector<Light> light = joined(seen, other);
    std::vector<float> known(texel_count);
    for (std::size_t i = 0; i < texel_count; ++i)
        known[i] =
            smooth_step(0, known_well, seen.weights[i] + (1 - seen.weights[i]) * other.weights[i]);
    fill_smoothly(light, std::move(known), texture_side);
    return light;
}

std::vector<Light> completed(const TexturePart& seen, const TexturePart& first,
                             const std::vector<Light>& first_completed) {
    Light own_sum{}, first_sum{};
    for (std::size_t i = 0; i < texel_count; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const float weight = seen.weights[i] * first.weights[i];
            own_sum[c] += weight * seen.light[i][c];
            first_sum[c] += weight * first.light[i][c];
        }
    TexturePart balanced = seen;
    for (std::size_t c = 0; c < 3; ++c) {
        const float gain =
            own_sum[c] > 0 ? std::clamp(first_sum[c] / own_sum[c], least_gain, most_gain) : 1;
        for (Light& light : balanced.light)
            light[c] *= gain;
    }
    return joined(balanced, {first_completed, std::vector<float>(texel_count, 1.F)});
}

ColorImage texture_of(const std::vector<Light>& light) {
    assert(light.size() == texel_count);
    ColorImage texture(texture_size);
    for (std::size_t i = 0; i < texel_count; ++i)
        texture.pixels[i] = to_srgb(light[i]);
    return texture;
}

}  // namespace theatron::face
