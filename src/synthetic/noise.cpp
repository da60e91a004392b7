// SPDX-License-Identifier: Apache-2.0
#include "synthetic/noise.h"

namespace theatron::synthetic {
namespace {

float lattice(int x, int y, int z) {
    return float(int(hash(x, y, z) >> 8)) * (2.0f / 16777216.0f) - 1;
}

}  // namespace

float noise(F3 p) {
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    const int x = int(fx), y = int(fy), z = int(fz);
    const auto ease = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const float u = ease(p.x - fx), v = ease(p.y - fy), w = ease(p.z - fz);
    const auto edge = [&](int dy, int dz) {
        return mix(lattice(x, y + dy, z + dz), lattice(x + 1, y + dy, z + dz), u);
    };
    return mix(mix(edge(0, 0), edge(1, 0), v), mix(edge(0, 1), edge(1, 1), v), w);
}

float fractal(F3 p, int octaves) {
    float sum = 0, strength = 0.55f;
    for (int i = 0; i < octaves; ++i) {
        sum += strength * noise(p);
        // Not exactly 2, so that the lattices of the octaves do not coincide.
        p = F3{p.z, p.x, p.y} * 2.03f + F3{17.3f, 5.1f, 9.7f};
        strength *= 0.5f;
    }
    return sum;
}

float cells(F3 p, float* second) {
    const int cx = int(std::floor(p.x)), cy = int(std::floor(p.y)), cz = int(std::floor(p.z));
    float first = 9, next = 9;
    for (int z = cz - 1; z <= cz + 1; ++z)
        for (int y = cy - 1; y <= cy + 1; ++y)
            for (int x = cx - 1; x <= cx + 1; ++x) {
                const std::uint32_t h = hash(x, y, z);
                const F3 d =
                    F3{float(x) + hash01(h), float(y) + hash01(h + 1), float(z) + hash01(h + 2)} -
                    p;
                const float d2 = dot(d, d);
                if (d2 < first) {
                    next = first;
                    first = d2;
                } else {
                    next = std::min(next, d2);
                }
            }
    if (second)
        *second = std::sqrt(next);
    return std::sqrt(first);
}

}  // namespace theatron::synthetic
