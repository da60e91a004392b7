// SPDX-License-Identifier: Apache-2.0
#include "render/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/vec.h"

namespace theatron::render {
namespace {

// The light from a direction (unit length).
Vec3 light_from(Vec3 d) {
    const double up = std::clamp(0.5 + 0.5 * d.y, 0.0, 1.0);
    Vec3 light = Vec3{0.10, 0.11, 0.11} * (1 - up) + Vec3{0.42, 0.45, 0.46} * up;
    // Four panels in a ceiling 1.5 m above.
    if (d.y > 0.2) {
        const double x = 1.5 * d.x / d.y, z = 1.5 * d.z / d.y;
        const auto in_panel = [](double v) { return std::abs(std::abs(v) - 1.0) < 0.35; };
        if (in_panel(x) && in_panel(z))
            light = light + Vec3{4.0, 3.9, 3.7};
    }
    return light;
}

Vec3 direction(int face, double u, double v) {
    switch (face) {
        case 0:
            return normalized(Vec3{1, -v, -u});
        case 1:
            return normalized(Vec3{-1, -v, u});
        case 2:
            return normalized(Vec3{u, 1, v});
        case 3:
            return normalized(Vec3{u, -1, -v});
        case 4:
            return normalized(Vec3{u, -v, 1});
        default:
            return normalized(Vec3{-u, -v, -1});
    }
}

// The mean light around `n` as a surface of this roughness gathers it (GGX; 1: diffuse).
Vec3 gathered(Vec3 n, double roughness, int samples) {
    const Vec3 side = normalized(cross(std::abs(n.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n));
    const Vec3 other = cross(n, side);
    Vec3 sum;
    double weight = 0;
    for (int i = 0; i < samples; ++i) {
        const double a = (i + 0.5) / samples;
        const double around = 2 * std::numbers::pi * std::fmod(i * 0.6180339887, 1.0);
        Vec3 d;
        if (roughness >= 1) {
            const double c = std::sqrt(1 - a), s = std::sqrt(a);
            d = n * c + side * (s * std::cos(around)) + other * (s * std::sin(around));
        } else {
            const double alpha = roughness * roughness;
            const double c = std::sqrt((1 - a) / (1 + (alpha * alpha - 1) * a));
            const double s = std::sqrt(std::max(0.0, 1 - c * c));
            const Vec3 half =
                n * c + side * (s * std::cos(around)) + other * (s * std::sin(around));
            d = half * (2 * dot(half, n)) - n;
        }
        const double w = roughness >= 1 ? 1 : std::max(dot(d, n), 0.0);
        sum = sum + light_from(d) * w;
        weight += w;
    }
    return sum * (1 / std::max(weight, 1e-9));
}

}  // namespace

Texture make_environment() {
    Texture texture;
    glBindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
    glTexStorage2D(GL_TEXTURE_CUBE_MAP, environment_levels, GL_RGBA16F, environment_side,
                   environment_side);
    for (int level = 0; level < environment_levels; ++level) {
        const int side = environment_side >> level;
        const double roughness = double(level) / (environment_levels - 1);
        std::vector<float> texels(std::size_t(side * side) * 4);
        for (int face = 0; face < 6; ++face) {
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const Vec3 n =
                        direction(face, 2 * (x + 0.5) / side - 1, 2 * (y + 0.5) / side - 1);
                    const Vec3 light =
                        level == 0 ? light_from(n) : gathered(n, roughness, 16 << level);
                    float* texel = &texels[std::size_t(y * side + x) * 4];
                    texel[0] = float(light.x);
                    texel[1] = float(light.y);
                    texel[2] = float(light.z);
                    texel[3] = 1;
                }
            glTexSubImage2D(GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face), level, 0, 0, side, side,
                            GL_RGBA, GL_FLOAT, texels.data());
        }
    }
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace theatron::render
