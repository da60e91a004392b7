// SPDX-License-Identifier: Apache-2.0
// A face with fewer vertices.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "face/face_triangles.h"
#include "face/sent_face.h"

namespace theatron::face {
namespace {

constexpr std::size_t shape_count = move_count + 1;  // at rest, and each move at full strength
// The cosine of the largest angle by which a triangle may turn.
constexpr double least_turn = 0.3;

// The sum of squared distances from planes.
struct Quadric {
    std::array<double, 10> q{};

    void add_plane(Vec3 normal, double distance, double weight) {
        const double n[4] = {normal.x, normal.y, normal.z, -distance};
        std::size_t i = 0;
        for (int a = 0; a < 4; ++a)
            for (int b = a; b < 4; ++b)
                q[i++] += weight * n[a] * n[b];
    }
    void add(const Quadric& other) {
        for (std::size_t i = 0; i < q.size(); ++i)
            q[i] += other.q[i];
    }
    double at(Vec3 p) const {
        return q[0] * p.x * p.x + q[4] * p.y * p.y + q[7] * p.z * p.z +
               2 * (q[1] * p.x * p.y + q[2] * p.x * p.z + q[5] * p.y * p.z + q[3] * p.x +
                    q[6] * p.y + q[8] * p.z) +
               q[9];
    }
};

class Thinning {
public:
    explicit Thinning(const EnrolledFace& face)
        : face_(face),
          triangles_(face.rest.triangles),
          of_vertex_(face.rest.vertex_count()),
          stays_(face.rest.vertex_count()),
          gone_(face.rest.vertex_count()),
          version_(face.rest.vertex_count()),
          quadrics_(face.rest.vertex_count()) {
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (const std::uint32_t corner : triangles_[t])
                of_vertex_[corner].push_back(t);
        keep_borders();
        add_planes();
    }

    void run(std::size_t most_vertices) {
        std::size_t left = 0;
        for (const auto& triangles : of_vertex_)
            left += !triangles.empty();
        for (std::uint32_t v = 0; v < of_vertex_.size() && left > most_vertices; ++v)
            push(v);
        while (left > most_vertices && !queue_.empty()) {
            const Candidate next = queue_.top();
            queue_.pop();
            if (gone_[next.from] || gone_[next.to] || version_[next.from] != next.version)
                continue;
            // Triangles that came to the other end meanwhile may stand in the way.
            if (!is_sound(next.from, next.to)) {
                push(next.from);
                continue;
            }
            collapse(next.from, next.to);
            --left;
        }
    }

    // Those whose corners are three vertices still; others have none.
    const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

private:
    struct Candidate {
        double cost = 0;
        std::uint32_t from = 0, to = 0, version = 0;
        bool operator<(const Candidate& other) const {
            return std::tie(cost, from, to) > std::tie(other.cost, other.from, other.to);
        }
    };

    Vec3 point(std::size_t shape, std::uint32_t vertex) const {
        Vec3 p = face_.rest.point(vertex);
        if (shape > 0) {
            const float* offset = &face_.moves[shape - 1][3 * std::size_t(vertex)];
            p = p + Vec3{offset[0], offset[1], offset[2]};
        }
        return p;
    }

    // Vertices that were parted for the texture, at edges of one triangle, and between two parts.
    void keep_borders() {
        std::map<std::array<float, 3>, std::uint32_t> at;
        for (std::uint32_t v = 0; v < of_vertex_.size(); ++v) {
            const float* p = &face_.rest.points[3 * std::size_t(v)];
            const auto [there, is_new] = at.try_emplace({p[0], p[1], p[2]}, v);
            if (!is_new)
                stays_[v] = stays_[there->second] = true;
        }
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const auto& corners : triangles_)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
                ++edges[{std::min(a, b), std::max(a, b)}];
            }
        for (const auto& [edge, count] : edges)
            if (count != 2)
                stays_[edge.first] = stays_[edge.second] = true;
        for (std::uint32_t v = 0; v < of_vertex_.size(); ++v)
            for (const std::uint32_t t : of_vertex_[v])
                if (face_.rest.part_of(t) != face_.rest.part_of(of_vertex_[v].front()))
                    stays_[v] = true;
    }

    void add_planes() {
        for (std::size_t s = 0; s < shape_count; ++s)
            for (const auto& corners : triangles_) {
                const Vec3 a = point(s, corners[0]);
                const Vec3 normal = cross(point(s, corners[1]) - a, point(s, corners[2]) - a);
                const double area = length(normal);
                if (!(area > 0))
                    continue;
                const Vec3 unit = (1 / area) * normal;
                for (const std::uint32_t corner : corners)
                    quadrics_[corner][s].add_plane(unit, dot(unit, a), area);
            }
    }

    // The cheapest collapse of this vertex, if it may go.
    void push(std::uint32_t from) {
        if (stays_[from] || gone_[from] || of_vertex_[from].empty())
            return;
        Candidate best;
        best.to = gone_vertex;
        for (const std::uint32_t t : of_vertex_[from])
            for (const std::uint32_t to : triangles_[t]) {
                if (to == from)
                    continue;
                double cost = 0;
                for (std::size_t s = 0; s < shape_count; ++s)
                    cost += quadrics_[from][s].at(point(s, to));
                if ((best.to == gone_vertex || cost < best.cost) && is_sound(from, to))
                    best = {cost, from, to, version_[from]};
            }
        if (best.to != gone_vertex)
            queue_.push(best);
    }

    // Sorted.
    std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
        std::vector<std::uint32_t> result;
        for (const std::uint32_t t : of_vertex_[vertex])
            for (const std::uint32_t corner : triangles_[t])
                if (corner != vertex)
                    result.push_back(corner);
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    // No triangle turns over, and the surface stays one of two sides.
    bool is_sound(std::uint32_t from, std::uint32_t to) const {
        std::vector<std::uint32_t> common;
        const auto a = neighbours(from), b = neighbours(to);
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        if (common.size() != 2)
            return false;
        for (const std::uint32_t t : of_vertex_[from]) {
            auto corners = triangles_[t];
            if (std::find(corners.begin(), corners.end(), to) != corners.end())
                continue;
            const Vec3 before = normal_of(corners);
            std::replace(corners.begin(), corners.end(), from, to);
            const Vec3 after = normal_of(corners);
            if (!(dot(before, after) > least_turn * length(before) * length(after)))
                return false;
        }
        return true;
    }

    Vec3 normal_of(const std::array<std::uint32_t, 3>& corners) const {
        const Vec3 a = face_.rest.point(corners[0]);
        return cross(face_.rest.point(corners[1]) - a, face_.rest.point(corners[2]) - a);
    }

    void collapse(std::uint32_t from, std::uint32_t to) {
        const auto round = neighbours(from);
        for (const std::uint32_t t : of_vertex_[from]) {
            auto& corners = triangles_[t];
            if (std::find(corners.begin(), corners.end(), to) != corners.end()) {
                for (const std::uint32_t corner : corners)
                    if (corner != from)
                        std::erase(of_vertex_[corner], t);
                corners.fill(gone_vertex);
                continue;
            }
            std::replace(corners.begin(), corners.end(), from, to);
            of_vertex_[to].push_back(t);
        }
        for (std::size_t s = 0; s < shape_count; ++s)
            quadrics_[to][s].add(quadrics_[from][s]);
        of_vertex_[from].clear();
        gone_[from] = true;
        for (const std::uint32_t near : round) {
            ++version_[near];
            push(near);
        }
    }

    const EnrolledFace& face_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::vector<std::uint32_t>> of_vertex_;
    std::vector<bool> stays_, gone_;
    std::vector<std::uint32_t> version_;
    std::vector<std::array<Quadric, shape_count>> quadrics_;
    std::priority_queue<Candidate> queue_;
};

}  // namespace

EnrolledFace thinned(const EnrolledFace& face, std::size_t most_vertices) {
    Thinning thinning(face);
    thinning.run(most_vertices);
    return with_triangles(face, thinning.triangles());
}

}  // namespace theatron::face
