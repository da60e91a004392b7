// SPDX-License-Identifier: Apache-2.0
#include "cases/synth_vessels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "cases/synth_random.h"

namespace theatron::cases {
namespace {

constexpr std::size_t portal_ends = 190;
constexpr std::size_t hepatic_ends = 150;
constexpr double stem_end_mm = 1.1;    // radius at the beginning of the last branches
constexpr double artery_share = 0.42;  // of the portal vein's radius
constexpr double least_artery_mm = 0.6;
constexpr double clearance_mm = 1.5;  // from the liver's surface
constexpr double between_mm = 0.6;    // portal vein and artery
constexpr double apart_mm = 1;        // hepatic veins and the other vessels
constexpr int pieces_per_branch = 6;
constexpr int most_tries = 60;  // for a vessel's way
constexpr std::size_t most_ends_left_out = 8;
constexpr double outside_cost = 1e6;

double artery_radius(double vein_radius) {
    return std::max(least_artery_mm, artery_share * vein_radius);
}

// From a vein of radius `r` to the artery beside it.
double distance_beside(double r) {
    return r + artery_radius(r) + between_mm;
}

// The artery's side at each place of a vein's line: perpendicular to the vein and turned as little
// as possible, as in Glisson's sheaths.
std::vector<Vec3> sides_along(const std::vector<Vec3>& line, Vec3 side) {
    std::vector<Vec3> sides{side};
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Vec3 step = line[i] - line[i - 1];
        if (length(step) > 1e-9) {
            const Vec3 along = normalized(step);
            const Vec3 across = side - along * dot(side, along);
            if (length(across) > 0.05)
                side = normalized(across);
        }
        sides.push_back(side);
    }
    return sides;
}

double radius_of(std::size_t ends) {
    return stem_end_mm * cube_root(double(ends));
}

Vec3 mean_of(std::span<const Vec3> places) {
    Vec3 sum;
    for (const Vec3 p : places)
        sum = sum + p;
    return sum * (1.0 / double(places.size()));
}

// The direction in which places are spread most, by power iteration on their covariance.
Vec3 spread(std::span<const Vec3> places, Vec3 mean) {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    for (const Vec3 p : places) {
        const Vec3 d = p - mean;
        xx += d.x * d.x, xy += d.x * d.y, xz += d.x * d.z;
        yy += d.y * d.y, yz += d.y * d.z, zz += d.z * d.z;
    }
    Vec3 v{0.8, 0.5, 0.33};
    for (int i = 0; i < 24; ++i) {
        v = {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
             xz * v.x + yz * v.y + zz * v.z};
        const double l = length(v);
        if (l < 1e-12)
            return {1, 0, 0};
        v = v * (1 / l);
    }
    return v;
}

class Grower {
public:
    Grower(const SynthLiver& liver, std::uint64_t seed) : liver_(liver), random_(mixed(seed + 2)) {}

    SynthVessels grow() {
        std::vector<Vec3> ends = scatter(portal_ends);
        const double r = radius_of(ends.size());
        has_artery_ = true;
        grow_tree(vessels_.portal_vein, inside(liver_.porta(), depth_for(r)), {0.1, -0.35, 0.9},
                  ends);
        has_artery_ = false;
        ends = scatter(hepatic_ends);
        const auto left_of = [&](double x, double slope) {
            return [=, this](Vec3 p) {
                const Vec3 q = liver_.to_model(p);
                return q.x - slope * (q.y - 30) < x;
            };
        };
        const auto right_end = std::partition(ends.begin(), ends.end(), left_of(-48, 0.5));
        const auto middle_end = std::partition(right_end, ends.end(), left_of(2, 0.1));
        const Vec3 root = liver_.confluence();
        const std::array<std::span<Vec3>, 3> veins{std::span<Vec3>(ends.begin(), right_end),
                                                   std::span<Vec3>(right_end, middle_end),
                                                   std::span<Vec3>(middle_end, ends.end())};
        for (const std::span<Vec3> vein : veins)
            if (!vein.empty())
                grow_tree(vessels_.hepatic_veins, inside(root, depth_for(radius_of(vein.size()))),
                          mean_of(vein) - root, vein);
        return std::move(vessels_);
    }

private:
    // The end of a vein that grows, and of the artery beside it.
    struct Tip {
        Vec3 vein, heading, artery, side;
        double radius_mm = 1;  // of the vein
    };

    void grow_tree(std::vector<VesselPiece>& tree, Vec3 root, Vec3 heading, std::span<Vec3> ends) {
        tree_ = &tree;
        const double r = radius_of(ends.size());
        const Vec3 side = normalized(Vec3{0.35, -0.8, 0.48});
        branch({root, normalized(heading), root + side * distance_beside(r), side, r}, ends, 0);
    }

    // The distance of a vein's line from the liver's surface: room for the artery, too.
    double depth_for(double r) const {
        return r + clearance_mm + (has_artery_ ? 2 * artery_radius(r) + between_mm : 0);
    }

    // Moves a place into the liver until the surface is `depth` away.
    Vec3 inside(Vec3 p, double depth) const {
        for (int i = 0; i < 60; ++i) {
            const double missing = liver_.distance(p) + depth;
            if (missing <= 0)
                break;
            const Vec3 out = liver_.gradient(p);
            const double l = length(out);
            p = p - out * ((missing + 0.2) / std::max(l * l, 0.2));
        }
        // Where slopes lead nowhere, straight towards the middle of the right lobe.
        const Vec3 core = liver_.core();
        while (liver_.distance(p) + depth > 0)
            p = core + (p - core) * 0.95;
        return p;
    }

    // Places all over the liver, not too near to each other: of several random proposals, the one
    // farthest from the places before.
    std::vector<Vec3> scatter(std::size_t count) {
        const medical::Box box = liver_.box();
        std::vector<Vec3> places;
        while (places.size() < count) {
            Vec3 best;
            double best_distance = -1;
            for (int candidates = 0; candidates < 8;) {
                const Vec3 p{random_.between(box.low_mm.x, box.high_mm.x),
                             random_.between(box.low_mm.y, box.high_mm.y),
                             random_.between(box.low_mm.z, box.high_mm.z)};
                if (liver_.distance(p) > -5)
                    continue;
                ++candidates;
                double nearest = 1e9;
                for (const Vec3 other : places)
                    nearest = std::min(nearest, dot(p - other, p - other));
                if (nearest > best_distance) {
                    best_distance = nearest;
                    best = p;
                }
            }
            places.push_back(best);
        }
        return places;
    }

    // A vessel from `from` towards `ends`, which it divides between two branches of its own. Where
    // there is no free way, small branches are left out, and all that would leave the liver.
    void branch(const Tip& from, std::span<Vec3> ends, int generation) {
        const Vec3 mean = mean_of(ends);
        const bool last = ends.size() == 1;
        const double share = last ? 1 : generation == 0 ? 0.3 : 0.45;
        const double r = radius_of(ends.size());
        const Vec3 to = from.vein + (mean - from.vein) * share;
        std::vector<Vec3> line;
        const double cost = find_way(from, to, r, line);
        if (cost >= outside_cost || (cost > 0 && ends.size() <= most_ends_left_out))
            return;
        const Tip arrived = add(from, line, r, last, generation);
        if (last)
            return;
        const Vec3 axis = spread(ends, mean);
        std::sort(ends.begin(), ends.end(), [&](Vec3 a, Vec3 b) {
            const double along = dot(a - b, axis);
            return along != 0 ? along < 0 : a.x < b.x;
        });
        // One branch is thicker than the other, in most places.
        const double smaller = ends.size() > 3 ? random_.between(0.3, 0.5) : 0.5;
        const auto part = std::size_t(std::max(1.0, std::floor(smaller * double(ends.size()))));
        const std::size_t first = random_.between(0, 1) < 0.5 ? part : ends.size() - part;
        branch(arrived, ends.first(first), generation + 1);
        branch(arrived, ends.subspan(first), generation + 1);
    }

    // The cheapest of several ways, which leave in the direction in which the stem arrived and bend
    // towards `to`. Returns its cost.
    double find_way(const Tip& tip, Vec3 to, double r, std::vector<Vec3>& best) {
        const double reach = length(to - tip.vein);
        const std::vector<VesselPiece> others = neighbours((tip.vein + to) * 0.5, reach + 20);
        double best_cost = 1e18;
        for (int i = 0; i < most_tries && best_cost > 0; ++i) {
            const double play = 0.12 + 0.5 * i / most_tries;
            const Vec3 bend =
                tip.vein + tip.heading * (0.35 * reach) + random_.direction() * (play * reach);
            const Vec3 end = i < 4 ? to : to + random_.direction() * ((play - 0.12) * reach);
            std::vector<Vec3> line{tip.vein};
            for (int k = 1; k <= pieces_per_branch; ++k) {
                const double t = double(k) / pieces_per_branch;
                line.push_back(inside(
                    tip.vein * ((1 - t) * (1 - t)) + bend * (2 * t * (1 - t)) + end * (t * t),
                    depth_for(r)));
            }
            const double cost = cost_of(line, tip.side, r, others);
            if (cost < best_cost) {
                best_cost = cost;
                best = std::move(line);
            }
        }
        return best_cost;
    }

    // Pieces of the vessels that hepatic veins keep clear of.
    std::vector<VesselPiece> neighbours(Vec3 middle, double reach) const {
        std::vector<VesselPiece> near;
        if (has_artery_)
            return near;
        for (const auto* tree : {&vessels_.portal_vein, &vessels_.artery})
            for (const VesselPiece& piece : *tree)
                if (length(piece.a - middle) < reach)
                    near.push_back(piece);
        return near;
    }

    // The sum of the lengths by which a vein of radius `r` comes too near to the others, and
    // `outside_cost` for each place where it or its artery leaves the liver.
    double cost_of(const std::vector<Vec3>& line, Vec3 side, double r,
                   const std::vector<VesselPiece>& others) const {
        const std::vector<Vec3> sides = sides_along(line, side);
        double sum = 0;
        for (std::size_t i = 1; i < line.size(); ++i)
            for (const double t : {0.25, 0.5, 0.75, 1.0}) {
                const Vec3 p = line[i - 1] * (1 - t) + line[i] * t;
                const double vein = liver_.distance(p) + r;
                const Vec3 across = sides[i - 1] * (1 - t) + sides[i] * t;
                const double artery =
                    has_artery_
                        ? liver_.distance(p + across * distance_beside(r)) + artery_radius(r)
                        : vein;
                if (std::max(vein, artery) > -1)
                    sum += outside_cost;
                for (const VesselPiece& piece : others)
                    sum += std::max(0.0, r + apart_mm - distance(p, piece));
            }
        return sum;
    }

    Tip add(Tip tip, const std::vector<Vec3>& line, double r, bool last, int generation) {
        // The first piece narrows from the stem's radius, the others taper.
        const double end = last ? 0.75 * r : 0.93 * r;
        double before = (tip.radius_mm + r) / 2;
        const std::vector<Vec3> sides = sides_along(line, tip.side);
        for (std::size_t i = 1; i < line.size(); ++i) {
            const double after = r + (end - r) * double(i) / double(line.size() - 1);
            tree_->push_back({tip.vein, line[i], before, after, generation});
            if (has_artery_) {
                const Vec3 artery = line[i] + sides[i] * distance_beside(after);
                vessels_.artery.push_back(
                    {tip.artery, artery, artery_radius(before), artery_radius(after), generation});
                tip.artery = artery;
            }
            const Vec3 step = line[i] - tip.vein;
            if (length(step) > 1e-9)
                tip.heading = normalized(step);
            tip.vein = line[i];
            before = after;
        }
        tip.radius_mm = before;
        tip.side = sides.back();
        return tip;
    }

    const SynthLiver& liver_;
    SynthRandom random_;
    SynthVessels vessels_;
    std::vector<VesselPiece>* tree_ = nullptr;
    bool has_artery_ = false;  // the tree that grows is the portal vein
};

}  // namespace

double distance(Vec3 p, const VesselPiece& piece) {
    const Vec3 along = piece.b - piece.a;
    const double l = dot(along, along);
    const double t = l > 0 ? std::clamp(dot(p - piece.a, along) / l, 0.0, 1.0) : 0;
    return length(p - piece.a - along * t) -
           (piece.radius_a_mm + (piece.radius_b_mm - piece.radius_a_mm) * t);
}

SynthVessels grow_vessels(const SynthLiver& liver, std::uint64_t seed) {
    return Grower(liver, seed).grow();
}

}  // namespace theatron::cases
