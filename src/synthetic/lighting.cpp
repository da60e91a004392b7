// SPDX-License-Identifier: Apache-2.0
#include "synthetic/lighting.h"

namespace theatron::synthetic {
namespace {

constexpr int map_side = 384;
constexpr float map_fov = 84;  // degrees

// Geometry nearer than this is the lamp's own body.
constexpr float lamp_body = 0.3f;

Affine from_lamp(const Lamp& lamp) {
    return to_affine(inverse(look_at(to_vec3(lamp.position), to_vec3(lamp.target), {0, 0, -1})));
}

CameraModel map_camera() {
    return pinhole({map_side, map_side}, map_fov);
}

const SampleGrid& map_grid() {
    static const SampleGrid grid = make_grid(map_camera());
    return grid;
}

// Two box filters of 2 * radius + 1 values along columns and rows: close to a Gaussian.
void blur(std::vector<float>& image, int radius) {
    const float share = 1 / float(2 * radius + 1);
    std::vector<float> source, sums(map_side);
    for (int repeat = 0; repeat < 2; ++repeat) {
        source = image;
        const auto row = [&](int y) {
            return source.data() + std::clamp(y, 0, map_side - 1) * map_side;
        };
        std::fill(sums.begin(), sums.end(), 0.0f);
        for (int y = -radius; y <= radius; ++y)
            for (int x = 0; x < map_side; ++x)
                sums[std::size_t(x)] += row(y)[x];
        for (int y = 0; y < map_side; ++y) {
            const float *enter = row(y + radius + 1), *leave = row(y - radius);
            float* out = image.data() + y * map_side;
            for (int x = 0; x < map_side; ++x) {
                out[x] = sums[std::size_t(x)] * share;
                sums[std::size_t(x)] += enter[x] - leave[x];
            }
        }
        for (int y = 0; y < map_side; ++y) {
            float* line = image.data() + y * map_side;
            std::copy(line, line + map_side, sums.begin());
            const auto at = [&](int x) {
                return sums[std::size_t(std::clamp(x, 0, map_side - 1))];
            };
            float sum = 0;
            for (int x = -radius; x <= radius; ++x)
                sum += at(x);
            for (int x = 0; x < map_side; ++x) {
                line[x] = std::max(sum * share, 0.0f);
                sum += at(x + radius + 1) - at(x - radius);
            }
        }
    }
}

// The environment reflected by a mirror: bright ceiling panels, walls, a darker floor.
F3 room_reflection(F3 d) {
    if (d.y > 0.05f) {
        const float x = d.x / d.y, z = d.z / d.y;
        const float panel = smoothstep(0.62f, 0.5f, std::abs(std::abs(x) - 0.9f)) *
                            smoothstep(1.5f, 1.3f, std::abs(z));
        const float lamp = smoothstep(0.5f, 0.3f, std::hypot(x, z));
        return mix(F3{0.42f, 0.45f, 0.45f}, F3{1.5f, 1.55f, 1.55f}, panel) +
               F3{0.9f, 0.88f, 0.8f} * lamp;
    }
    return mix(F3{0.42f, 0.46f, 0.46f}, F3{0.13f, 0.15f, 0.16f}, smoothstep(0.0f, -0.5f, d.y));
}

}  // namespace

const std::array<Lamp, lamp_count>& lamps() {
    static const std::array<Lamp, lamp_count> all{
        Lamp{{-0.5f, 2.3f, 0.14f}, {-0.02f, 1.08f, 0.0f}},
        Lamp{{0.46f, 2.36f, 0.05f}, {0.04f, 1.08f, 0.0f}}};
    return all;
}

ShadowMap::ShadowMap(const Lamp& lamp, std::span<const F3> points,
                     std::span<const Triangle> triangles)
    : lamp_from_room_(from_lamp(lamp)) {
    std::vector<F3> local;
    transform(points, lamp_from_room_, local);
    for (F3& p : local)
        if (p.z < lamp_body)
            p.z = 0;
    Visibility seen;
    seen.clear({map_side, map_side});
    rasterise(map_grid(), local, triangles, 0, seen);
    spread(seen.depth);
}

ShadowMap::ShadowMap(const Lamp& lamp, std::span<const F3> dense_points)
    : lamp_from_room_(from_lamp(lamp)) {
    Image<float> depth({map_side, map_side});
    std::fill(depth.pixels.begin(), depth.pixels.end(), nothing_seen);
    const CameraModel& camera = map_grid().camera;
    for (const F3 point : dense_points) {
        const F3 p = lamp_from_room_ * point;
        if (p.z < lamp_body)
            continue;
        const int x = int(p.x / p.z * float(camera.fx) + float(camera.cx));
        const int y = int(p.y / p.z * float(camera.fy) + float(camera.cy));
        if (x < 0 || y < 0 || x >= map_side - 1 || y >= map_side - 1)
            continue;
        for (const int dy : {0, 1})
            for (const int dx : {0, 1}) {
                float& d = depth.view().row(y + dy)[x + dx];
                d = std::min(d, p.z);
            }
    }
    spread(depth);
}

void ShadowMap::spread(const Image<float>& depth) {
    Layer sharp{std::vector<float>(depth.pixels.size()), std::vector<float>(depth.pixels.size())};
    for (std::size_t i = 0; i < depth.pixels.size(); ++i)
        if (depth.pixels[i] < nothing_seen) {
            sharp.cover[i] = 1;
            sharp.covered_depth[i] = depth.pixels[i];
        }
    static constexpr int radii[3] = {2, 7, 24};
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        layers_[i] = sharp;
        blur(layers_[i].cover, radii[i]);
        blur(layers_[i].covered_depth, radii[i]);
    }
}

ShadowMap::Shadow ShadowMap::at(F3 room_point) const {
    static const CameraModel camera = map_camera();
    const F3 p = lamp_from_room_ * room_point;
    if (p.z < 0.2f)
        return {};
    const float x = p.x / p.z * float(camera.fx) + float(camera.cx);
    const float y = p.y / p.z * float(camera.fy) + float(camera.cy);
    if (!(x >= 0 && y >= 0 && x < map_side - 1 && y < map_side - 1))
        return {};
    const int ix = int(x), iy = int(y);
    const float fx = x - float(ix), fy = y - float(iy);
    const std::size_t at = std::size_t(iy) * map_side + std::size_t(ix);
    if (layers_[2].cover[at] < 1e-4f)
        return {};
    const auto read = [&](const std::vector<float>& v) {
        return mix(mix(v[at], v[at + 1], fx), mix(v[at + map_side], v[at + map_side + 1], fx), fy);
    };
    float hidden[3], behind[3];
    for (int i = 0; i < 3; ++i) {
        const float cover = read(layers_[std::size_t(i)].cover);
        const float depth =
            cover > 1e-4f ? read(layers_[std::size_t(i)].covered_depth) / cover : p.z;
        behind[i] = p.z - depth;
        const float from = i == 0 ? 0.008f : 0.015f, to = i == 0 ? 0.04f : 0.09f;
        hidden[i] = cover * smoothstep(from, to, behind[i]);
    }
    // Shadows get softer with the distance from their caster.
    const float soft = smoothstep(0.02f, 0.3f, behind[1]);
    const float shadow = mix(std::max(hidden[0], 0.8f * hidden[1]), hidden[1], soft);
    return {1 - shadow, 1 - 0.55f * hidden[2] - 0.2f * hidden[1]};
}

LitPoint light_point(const Appearance& look, F3 p, F3 toward_eye, float openness) {
    LitPoint lit;
    const F3 n = look.normal;
    // Ambient light from above, from the sides, and reflected by the floor.
    const float up = 0.5f + 0.5f * n.y;
    const F3 ambient = mix(F3{0.36f, 0.375f, 0.37f}, F3{0.74f, 0.77f, 0.77f}, up);
    const float shade = openness * openness * 0.5f + openness * 0.5f;
    lit.base = look.color * ambient * shade + look.glow;
    const float facing_eye = clamp01(dot(n, toward_eye));
    if (look.mirror > 0) {
        const F3 reflected = n * (2 * dot(n, toward_eye)) - toward_eye;
        const float fresnel =
            look.mirror + (1 - look.mirror) * 0.35f * std::pow(1 - facing_eye, 5.0f);
        lit.base += room_reflection(reflected) * (fresnel * shade);
        lit.base = lit.base - look.color * ambient * (shade * look.mirror * 0.8f);
    }
    for (int i = 0; i < lamp_count; ++i) {
        const Lamp& lamp = lamps()[std::size_t(i)];
        const F3 to_lamp = lamp.position - p;
        const float distance = length(to_lamp);
        const F3 l = to_lamp * (1 / distance);
        const F3 axis = normalized(lamp.target - lamp.position);
        const float off = std::acos(std::clamp(-dot(l, axis), -1.0f, 1.0f));
        const float pool =
            0.5f * smoothstep(0.36f, 0.09f, off) + 0.3f * smoothstep(0.95f, 0.2f, off);
        const float strength = 1.0f * pool / std::max(distance * distance, 0.04f) *
                               smoothstep(-0.02f, 0.2f, -dot(l, axis));
        const F3 color{1.05f, 1.0f, 0.93f};
        const float facing = dot(n, l);
        const float diffuse =
            clamp01((facing + look.through) / (1 + look.through)) * (0.6f + 0.4f * openness);
        F3 out = look.color * (diffuse * strength);
        if (look.through > 0)  // light that went through is redder
            out += look.color * F3{1, 0.5f, 0.4f} *
                   (look.through * 0.3f * strength * clamp01(1 - std::abs(facing)));
        if (look.specular > 0 && facing > 0) {
            // Lamps are half a metre wide, so their highlights are broad.
            const F3 half = normalized(l + toward_eye);
            const float h = clamp01(dot(n, half));
            const float peak = std::pow(h, look.gloss) * (look.gloss + 8) * 0.02f;
            out += F3{1, 1, 1} * (look.specular * peak * strength * facing);
        }
        lit.lamp[std::size_t(i)] = out * color;
    }
    return lit;
}

Rgb tone_map(F3 light) {
    // Filmic curve (a rational fit), tabulated over the square root of light.
    static const auto table = [] {
        std::array<std::uint8_t, 4096> t{};
        for (int i = 0; i < 4096; ++i) {
            const float root = float(i) / 4095 * 4;
            const float x = root * root * 0.92f;
            const float y = clamp01(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f));
            const float s = y <= 0.0031308f ? 12.92f * y : 1.055f * std::pow(y, 1 / 2.4f) - 0.055f;
            t[std::size_t(i)] = std::uint8_t(std::lround(255 * s));
        }
        return t;
    }();
    const auto one = [](float v) {
        return table[std::size_t(std::min(std::sqrt(std::max(v, 0.0f)) * (4095.0f / 4), 4095.0f))];
    };
    return {one(light.x), one(light.y), one(light.z)};
}

}  // namespace theatron::synthetic
