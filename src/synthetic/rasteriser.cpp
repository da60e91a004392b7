// SPDX-License-Identifier: Apache-2.0
#include "synthetic/rasteriser.h"

namespace theatron::synthetic {
namespace {

constexpr float near_plane = 0.03f;

struct P2 {
    float x, y;
};

// The approximate image of a point, used only to bound the pixels to test. Points beyond the
// lens' limit are moved to the limit.
P2 bound_projection(const CameraModel& c, F3 p, float& pulled) {
    float x = p.x / p.z, y = p.y / p.z;
    float r2 = x * x + y * y;
    const auto limit = float(c.max_radius > 0 ? c.max_radius : 1e4);
    if (r2 > limit * limit) {
        const float s = limit / std::sqrt(r2);
        x *= s;
        y *= s;
        r2 = limit * limit;
        pulled = std::max(pulled, 1.0f);
    }
    const float radial = (1 + r2 * (float(c.k[0]) + r2 * (float(c.k[1]) + r2 * float(c.k[2])))) /
                         (1 + r2 * (float(c.k[3]) + r2 * (float(c.k[4]) + r2 * float(c.k[5]))));
    return {x * radial * float(c.fx) + float(c.cx), y * radial * float(c.fy) + float(c.cy)};
}

struct Raster {
    const SampleGrid& grid;
    Visibility& seen;

    void draw(F3 a, F3 b, F3 c, P2 pa, P2 pb, P2 pc, float margin, std::uint32_t id) {
        const auto s = float(grid.per_side);
        const float spread =
            std::max({std::abs(pa.x - pb.x), std::abs(pb.x - pc.x), std::abs(pc.x - pa.x),
                      std::abs(pa.y - pb.y), std::abs(pb.y - pc.y), std::abs(pc.y - pa.y)});
        // Distortion bends straight edges by a share of their length.
        margin += 0.05f + grid.shift + 0.0004f * spread * spread;
        const Size size = seen.depth.size;
        const auto low = [&](float v) { return int(std::ceil((v - margin + 0.5f) * s - 0.5f)); };
        const auto high = [&](float v) { return int(std::floor((v + margin + 0.5f) * s - 0.5f)); };
        const int x0 = std::max(0, low(std::min({pa.x, pb.x, pc.x})));
        const int x1 = std::min(size.width - 1, high(std::max({pa.x, pb.x, pc.x})));
        const int y0 = std::max(0, low(std::min({pa.y, pb.y, pc.y})));
        const int y1 = std::min(size.height - 1, high(std::max({pa.y, pb.y, pc.y})));
        if (x0 > x1 || y0 > y1)
            return;

        const F3 n = cross(b - a, c - a);
        const float distance = dot(n, a);
        // Each edge plane is computed in the same order for both triangles of the edge, so
        // that they agree to the last bit and no ray passes between them.
        const F3 ea = edge(b, c), eb = edge(c, a), ec = edge(a, b);
        const float zmin = std::min({a.z, b.z, c.z}), zmax = std::max({a.z, b.z, c.z});
        for (int y = y0; y <= y1; ++y) {
            const Ray* rays = grid.rays.view().row(y);
            float* depth = seen.depth.view().row(y);
            std::uint32_t* ids = seen.triangles.view().row(y);
            for (int x = x0; x <= x1; ++x) {
                const Ray r = rays[x];
                const float wa = ea.x * r.x + ea.y * r.y + ea.z;
                const float wb = eb.x * r.x + eb.y * r.y + eb.z;
                const float wc = ec.x * r.x + ec.y * r.y + ec.z;
                // All three edges against the normal: the ray hits the front face.
                if (wa > 0 || wb > 0 || wc > 0 || r.x == no_ray)
                    continue;
                const float across = n.x * r.x + n.y * r.y + n.z;
                if (across >= 0)
                    continue;
                const float z = std::clamp(distance / across, zmin, zmax);
                if (z < depth[x]) {
                    depth[x] = z;
                    ids[x] = id;
                }
            }
        }
    }

    static F3 edge(F3 p, F3 q) {
        const bool swap = p.x != q.x ? p.x > q.x : p.y != q.y ? p.y > q.y : p.z > q.z;
        return swap ? -cross(q, p) : cross(p, q);
    }

    // Draws the part of the triangle beyond the near plane, as a fan.
    void draw_clipped(const F3 (&corners)[3], std::uint32_t id) {
        F3 kept[4];
        int count = 0;
        for (int i = 0; i < 3; ++i) {
            const F3 p = corners[i], q = corners[(i + 1) % 3];
            if (p.z >= near_plane)
                kept[count++] = p;
            if ((p.z >= near_plane) != (q.z >= near_plane))
                kept[count++] = mix(p, q, (near_plane - p.z) / (q.z - p.z));
        }
        for (int i = 1; i + 1 < count; ++i) {
            float pulled = 0;
            const P2 a = bound_projection(grid.camera, kept[0], pulled),
                     b = bound_projection(grid.camera, kept[i], pulled),
                     c = bound_projection(grid.camera, kept[i + 1], pulled);
            draw(kept[0], kept[i], kept[i + 1], a, b, c, 1e4f, id);
        }
    }
};

void bound_rays(SampleGrid& grid) {
    for (const Ray& r : grid.rays.pixels)
        if (r.x != no_ray) {
            grid.side_x = std::max(grid.side_x, std::abs(r.x));
            grid.side_y = std::max(grid.side_y, std::abs(r.y));
        }
}

}  // namespace

SampleGrid make_grid(const CameraModel& camera) {
    SampleGrid grid{camera, 1, make_ray_table(camera)};
    bound_rays(grid);
    return grid;
}

SampleGrid make_fine_grid(const CameraModel& camera, const Image<Ray>& centres, int per_side,
                          Vec2 shift) {
    const Size size = camera.size;
    SampleGrid grid{camera, per_side, Image<Ray>({size.width * per_side, size.height * per_side})};
    grid.shift = float(std::max(std::abs(shift.x), std::abs(shift.y))) / float(per_side);
    const auto step = 1.0f / float(per_side);
    for (int y = 0; y < grid.rays.size.height; ++y)
        for (int x = 0; x < grid.rays.size.width; ++x) {
            const float px = (float(x) + 0.5f + float(shift.x)) * step - 0.5f;
            const float py = (float(y) + 0.5f + float(shift.y)) * step - 0.5f;
            const int ix = std::clamp(int(std::floor(px)), 0, size.width - 2);
            const int iy = std::clamp(int(std::floor(py)), 0, size.height - 2);
            const Ray* upper = centres.view().row(iy) + ix;
            const Ray* lower = centres.view().row(iy + 1) + ix;
            Ray& out = grid.rays.view().row(y)[x];
            if (upper[0].x == no_ray || upper[1].x == no_ray || lower[0].x == no_ray ||
                lower[1].x == no_ray) {
                out = {no_ray, no_ray};
                continue;
            }
            const float fx = px - float(ix), fy = py - float(iy);
            out.x = mix(mix(upper[0].x, upper[1].x, fx), mix(lower[0].x, lower[1].x, fx), fy);
            out.y = mix(mix(upper[0].y, upper[1].y, fx), mix(lower[0].y, lower[1].y, fx), fy);
        }
    bound_rays(grid);
    return grid;
}

void Visibility::clear(Size size) {
    depth.resize(size);
    triangles.resize(size);
    std::fill(depth.pixels.begin(), depth.pixels.end(), nothing_seen);
    std::fill(triangles.pixels.begin(), triangles.pixels.end(), no_triangle);
}

void transform(std::span<const F3> room, const Affine& camera_from_room, std::vector<F3>& out) {
    out.resize(room.size());
    for (std::size_t i = 0; i < room.size(); ++i)
        out[i] = camera_from_room * room[i];
}

void rasterise(const SampleGrid& grid, std::span<const F3> points,
               std::span<const Triangle> triangles, std::uint32_t first, Visibility& seen,
               const Pulse& pulse) {
    constexpr std::size_t triangles_of_a_pulse = 1024;
    struct Bound {
        P2 at;
        float margin;  // negative: behind the near plane
    };
    std::vector<Bound> bounds(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        float pulled = 0;
        if (points[i].z < near_plane)
            bounds[i] = {{0, 0}, -1};
        else
            bounds[i] = {bound_projection(grid.camera, points[i], pulled), pulled * 4};
    }
    Raster raster{grid, seen};
    const float side_x = grid.side_x, side_y = grid.side_y;
    const auto outside = [&](F3 a, F3 b, F3 c) {
        const auto right = [&](F3 p) { return p.x > side_x * p.z; };
        const auto left = [&](F3 p) { return -p.x > side_x * p.z; };
        const auto below = [&](F3 p) { return p.y > side_y * p.z; };
        const auto above = [&](F3 p) { return -p.y > side_y * p.z; };
        return (right(a) && right(b) && right(c)) || (left(a) && left(b) && left(c)) ||
               (below(a) && below(b) && below(c)) || (above(a) && above(b) && above(c));
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (pulse && i % triangles_of_a_pulse == 0)
            pulse();
        const Triangle& t = triangles[i];
        const F3 a = points[t.a], b = points[t.b], c = points[t.c];
        if (dot(cross(b - a, c - a), a) >= 0)
            continue;  // faces away
        if (outside(a, b, c))
            continue;
        const Bound &ba = bounds[t.a], &bb = bounds[t.b], &bc = bounds[t.c];
        const auto id = first + std::uint32_t(i);
        const int behind = (ba.margin < 0) + (bb.margin < 0) + (bc.margin < 0);
        if (behind == 0)
            raster.draw(a, b, c, ba.at, bb.at, bc.at, std::max({ba.margin, bb.margin, bc.margin}),
                        id);
        else if (behind < 3)
            raster.draw_clipped({a, b, c}, id);
    }
}

}  // namespace theatron::synthetic
