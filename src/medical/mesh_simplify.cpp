// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "medical/mesh_shaping.h"

namespace theatron::medical {
namespace {

// The sum of squared distances to planes, as a symmetric 4x4 matrix.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, xw = 0, yy = 0, yz = 0, yw = 0, zz = 0, zw = 0, ww = 0;

    void add_plane(Vec3 n, double d, double weight) {
        xx += weight * n.x * n.x, xy += weight * n.x * n.y, xz += weight * n.x * n.z;
        yy += weight * n.y * n.y, yz += weight * n.y * n.z, zz += weight * n.z * n.z;
        xw += weight * n.x * d, yw += weight * n.y * d, zw += weight * n.z * d;
        ww += weight * d * d;
    }
    Quadric operator+(const Quadric& q) const {
        return {xx + q.xx, xy + q.xy, xz + q.xz, xw + q.xw, yy + q.yy,
                yz + q.yz, yw + q.yw, zz + q.zz, zw + q.zw, ww + q.ww};
    }
    double error(Vec3 p) const {
        return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + xw)) +
               p.y * (yy * p.y + 2 * (yz * p.z + yw)) + p.z * (zz * p.z + 2 * zw) + ww;
    }
    // The place with the least error; `fallback` where that is not well determined.
    Vec3 best(Vec3 fallback) const {
        const Vec3 a{xx, xy, xz}, b{xy, yy, yz}, c{xz, yz, zz};
        const double d = dot(a, cross(b, c));
        const double trace = xx + yy + zz;
        if (!(std::abs(d) > 1e-4 * trace * trace * trace))
            return fallback;
        const Vec3 right{-xw, -yw, -zw};
        return {dot(right, cross(b, c)) / d, dot(a, cross(right, c)) / d,
                dot(a, cross(b, right)) / d};
    }
};

// A heap of four children to a node: half as deep as a binary one, so that taking the least of
// millions of candidates reads half as many places of memory. Equal ones leave in any order.
template <class T>
class Heap {
public:
    bool empty() const { return items_.empty(); }
    void push(const T& item) {
        std::size_t at = items_.size();
        items_.push_back(item);
        for (std::size_t up; at > 0 && item < items_[up = (at - 1) / 4]; at = up)
            items_[at] = items_[up];
        items_[at] = item;
    }
    T take_least() {
        const T least = items_.front(), last = items_.back();
        items_.pop_back();
        const std::size_t size = items_.size();
        std::size_t at = 0;
        while (4 * at + 1 < size) {
            std::size_t child = 4 * at + 1;
            for (std::size_t i = child + 1, end = std::min(child + 4, size); i < end; ++i)
                if (items_[i] < items_[child])
                    child = i;
            if (!(items_[child] < last))
                break;
            items_[at] = items_[child];
            at = child;
        }
        if (size > 0)
            items_[at] = last;
        return least;
    }

private:
    std::vector<T> items_;
};

class Simplifier {
public:
    explicit Simplifier(Mesh& mesh) : mesh_(mesh) {
        const std::size_t count = mesh.positions.size();
        quadrics_.resize(count);
        around_.resize(count);
        changes_.resize(count);
        for (const Vec3f p : mesh.positions)
            positions_.push_back(to_double(p));
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const Triangle& t = mesh.triangles[i];
            const Vec3 a = positions_[t[0]];
            const Vec3 normal = cross(positions_[t[1]] - a, positions_[t[2]] - a);
            const double area = length(normal);
            for (const std::uint32_t v : t) {
                around_[v].push_back(std::uint32_t(i));
                if (area > 0)
                    quadrics_[v].add_plane(normal * (1 / area), -dot(normal, a) / area, area);
            }
        }
        alive_ = mesh.triangles.size();
        gone_.resize(alive_);
    }

    void run(std::size_t max_triangles) {
        if (alive_ <= max_triangles)
            return;
        for (const Triangle& t : mesh_.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                if (t[i] < t[(i + 1) % 3])
                    offer(t[i], t[(i + 1) % 3]);
        while (alive_ > max_triangles && !queue_.empty()) {
            const Candidate next = queue_.take_least();
            if (changes_[next.a] == next.changes_a && changes_[next.b] == next.changes_b)
                collapse(next);
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
            if (!gone_[i])
                mesh_.triangles[kept++] = mesh_.triangles[i];
        mesh_.triangles.resize(kept);
        for (std::size_t i = 0; i < positions_.size(); ++i)
            mesh_.positions[i] = to_float(positions_[i]);
    }

private:
    struct Candidate {
        double error;
        std::uint32_t a, b;
        std::uint32_t changes_a, changes_b;  // when it was offered
        bool operator<(const Candidate& other) const {
            if (error != other.error)
                return error < other.error;
            return a != other.a ? a < other.a : b < other.b;
        }
    };

    Vec3 place(std::uint32_t a, std::uint32_t b) const {
        const Vec3 middle = (positions_[a] + positions_[b]) * 0.5;
        const Quadric sum = quadrics_[a] + quadrics_[b];
        const Vec3 best = sum.best(middle);
        // The least error of nearly flat places may lie far away.
        const double reach = length(positions_[a] - positions_[b]);
        return length(best - middle) <= reach ? best : middle;
    }

    void offer(std::uint32_t a, std::uint32_t b) {
        const Quadric sum = quadrics_[a] + quadrics_[b];
        const Vec3 edge = positions_[a] - positions_[b];
        // Short edges first where nothing else decides.
        const double error = std::max(0.0, sum.error(place(a, b))) + 1e-9 * dot(edge, edge);
        queue_.push({error, a, b, changes_[a], changes_[b]});
    }

    void neighbours_of(std::uint32_t v, std::vector<std::uint32_t>& out) const {
        out.clear();
        for (const std::uint32_t t : around_[v])
            for (const std::uint32_t other : mesh_.triangles[t])
                if (other != v)
                    out.push_back(other);
        std::sort(out.begin(), out.end());
    }

    // Each neighbour of a vertex inside a surface is in two of its triangles.
    static bool is_inside(const std::vector<std::uint32_t>& sorted) {
        if (sorted.size() % 2)
            return false;
        for (std::size_t i = 0; i < sorted.size(); i += 2)
            if (sorted[i] != sorted[i + 1] || (i > 0 && sorted[i] == sorted[i - 1]))
                return false;
        return true;
    }

    // The link condition (Dey et al. 1999): the two vertices have the two neighbours in common that
    // their triangles say, so that nothing is pinched. A tetrahedron stays.
    bool keeps_manifold(std::uint32_t a, std::uint32_t b) {
        neighbours_of(a, near_a_);
        neighbours_of(b, near_b_);
        if (!is_inside(near_a_) || !is_inside(near_b_))
            return false;
        near_a_.erase(std::unique(near_a_.begin(), near_a_.end()), near_a_.end());
        near_b_.erase(std::unique(near_b_.begin(), near_b_.end()), near_b_.end());
        common_.clear();
        std::set_intersection(near_a_.begin(), near_a_.end(), near_b_.begin(), near_b_.end(),
                              std::back_inserter(common_));
        return common_.size() == 2 && near_a_.size() + near_b_.size() > 8 - 1;
    }

    // True if moving `v` to `to` turns one of its remaining triangles over or makes it a sliver.
    bool turns(std::uint32_t v, std::uint32_t other, Vec3 to) const {
        for (const std::uint32_t index : around_[v]) {
            const Triangle& t = mesh_.triangles[index];
            if (t[0] == other || t[1] == other || t[2] == other)
                continue;
            Vec3 corners[3], moved[3];
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = positions_[t[i]];
                moved[i] = t[i] == v ? to : corners[i];
            }
            const Vec3 before = cross(corners[1] - corners[0], corners[2] - corners[0]);
            const Vec3 after = cross(moved[1] - moved[0], moved[2] - moved[0]);
            if (dot(before, after) < 0.2 * length(before) * length(after))
                return true;
        }
        return false;
    }

    void collapse(const Candidate& edge) {
        const std::uint32_t a = edge.a, b = edge.b;
        const Vec3 to = place(a, b);
        if (!keeps_manifold(a, b) || turns(a, b, to) || turns(b, a, to))
            return;
        positions_[a] = to;
        quadrics_[a] = quadrics_[a] + quadrics_[b];
        for (const std::uint32_t index : around_[b]) {
            Triangle& t = mesh_.triangles[index];
            if (t[0] == a || t[1] == a || t[2] == a) {
                gone_[index] = true;
                --alive_;
                for (const std::uint32_t v : t)
                    if (v != b)
                        std::erase(around_[v], index);
                continue;
            }
            std::replace(t.begin(), t.end(), b, a);
            around_[a].push_back(index);
        }
        around_[b] = {};
        ++changes_[b];
        ++changes_[a];
        neighbours_of(a, near_a_);
        near_a_.erase(std::unique(near_a_.begin(), near_a_.end()), near_a_.end());
        for (const std::uint32_t other : near_a_)
            offer(std::min(a, other), std::max(a, other));
    }

    Mesh& mesh_;
    std::vector<Vec3> positions_;
    std::vector<Quadric> quadrics_;
    std::vector<std::vector<std::uint32_t>> around_;  // triangles of each vertex
    std::vector<std::uint32_t> changes_;              // of each vertex, to know old candidates
    std::vector<bool> gone_;
    std::size_t alive_ = 0;  // triangles
    Heap<Candidate> queue_;
    std::vector<std::uint32_t> near_a_, near_b_, common_;
};

}  // namespace

void simplify(Mesh& mesh, std::size_t max_triangles) {
    Simplifier(mesh).run(max_triangles);
    weld(mesh);
}

}  // namespace theatron::medical
