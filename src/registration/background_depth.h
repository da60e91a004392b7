// SPDX-License-Identifier: Apache-2.0
// The distance of a board's background, and the brightness expected at that distance.
#pragma once

#include <algorithm>
#include <array>

#include "registration/lattice_edges.h"

namespace theatron::registration {

inline constexpr double background_reflectivity = 0.6;  // in that of the board
inline constexpr double light_reach_m = 0.03;           // around edges; background counts there

// Mean depths beyond each edge of the outline and through each hole.
class BackgroundDepth {
public:
    void add(const FacePattern& pattern, Vec2 p, double z_m) {
        const FacePattern::Inside inside = pattern.inside(p.x, p.y);
        if (inside.edge() > light_reach_m)
            return;
        const bool is_beyond = inside.outline < 0;
        Mean& own = is_beyond ? beyond_[std::size_t(pattern.side_beyond(p.x, p.y))]
                              : through_[std::size_t(pattern.nearest_cell(p.x, p.y))];
        for (Mean* mean : {&own, &all_}) {
            mean->sum += z_m;
            ++mean->n;
        }
    }

    // The expected light, for a face at a distance of about `face_m` metres.
    BackgroundLight light(double face_m) const {
        const auto light_of = [&](const Mean& mean) {
            const double behind_m = depth(mean, face_m);
            return background_reflectivity / (behind_m * behind_m);
        };
        BackgroundLight result;
        std::transform(beyond_.begin(), beyond_.end(), result.outline.begin(), light_of);
        std::transform(through_.begin(), through_.end(), result.cells.begin(), light_of);
        return result;
    }

    // Mean depth through a hole in metres; if too few were measured, of all; else twice `face_m`.
    double through(int cell_index, double face_m) const {
        return depth(through_[std::size_t(cell_index)], face_m);
    }
    double beyond(int side, double face_m) const {
        return depth(beyond_[std::size_t(side)], face_m);
    }

private:
    struct Mean {
        double sum = 0;
        int n = 0;
    };
    double depth(const Mean& mean, double face_m) const {
        constexpr int enough = 10;
        const Mean& used = mean.n >= enough ? mean : all_;
        return used.n > 0 ? used.sum / used.n : 2 * face_m;
    }
    Mean all_;
    std::array<Mean, 4> beyond_{};
    std::array<Mean, FacePattern::cell_count> through_{};
};

}  // namespace theatron::registration
