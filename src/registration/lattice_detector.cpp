// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_detector.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace theatron::registration {
namespace {

constexpr int sparse_step = 2;
// Shares of the board's area: parts may be hidden, and other objects may lie in its plane.
constexpr double least_area_share = 0.45, largest_area_share = 1.7;
// A fit with a larger distance between its edges and those of the image is no board.
constexpr double largest_edge_rms = 0.42;
// With this agreement no better one is looked for.
constexpr double sure_agreement = 0.97;

}  // namespace

LatticeDetector::LatticeDetector(const CameraModel& camera, double depth_unit_mm,
                                 const LatticeTarget& target)
    : camera_(camera),
      metres_per_unit_(depth_unit_mm / 1000),
      target_(target),
      rays_(make_ray_table(camera)),
      pixels_(camera, rays_) {
    assert(is_valid(target));
    sparse_rays_.resize({camera.size.width / sparse_step, camera.size.height / sparse_step});
    for (int y = 0; y < sparse_rays_.size.height; ++y)
        for (int x = 0; x < sparse_rays_.size.width; ++x)
            sparse_rays_.view().row(y)[x] = rays_.view().row(y * sparse_step)[x * sparse_step];
    sparse_.size = sparse_rays_.size;
    sparse_.inverse_m.resize(sparse_.size.area());
}

std::optional<Detection> LatticeDetector::detect(DepthView depth, FitEffort effort) {
    assert(depth.size == camera_.size);
    sparse_.rays = &sparse_rays_;
    for (int y = 0; y < sparse_.size.height; ++y) {
        const std::uint16_t* row = depth.row(y * sparse_step);
        const Ray* rays = sparse_rays_.view().row(y);
        float* out = &sparse_.inverse_m[std::size_t(y) * std::size_t(sparse_.size.width)];
        for (int x = 0; x < sparse_.size.width; ++x) {
            const std::uint16_t units = row[x * sparse_step];
            out[x] = units == 0 || rays[x].x == no_ray ? 0 : 1 / (units * float(metres_per_unit_));
        }
    }
    const SurfaceSize wanted{std::hypot(target_.width_m, target_.height_m) * 1.05,
                             solid_area_m2(target_) * least_area_share,
                             solid_area_m2(target_) * largest_area_share};
    const DepthLookup lookup{depth, &camera_, &pixels_, metres_per_unit_};
    // The most board-like area first: mostly it is the board, and the others are left alone.
    std::vector<FoundPlane> planes = find_planes(sparse_, wanted, explained_);
    const double solid = solid_area_m2(target_);
    std::sort(planes.begin(), planes.end(), [&](const FoundPlane& a, const FoundPlane& b) {
        return std::abs(std::log(a.area_m2 / solid)) < std::abs(std::log(b.area_m2 / solid));
    });
    std::optional<Detection> best;
    for (const FoundPlane& plane : planes) {
        const auto match = match_lattice(lookup, plane, target_);
        if (!match || (best && best->match.agreement >= match->agreement))
            continue;
        const auto fit = fit_lattice(lookup, rays_, *match, target_, effort);
        if (!fit || fit->edge_rms > largest_edge_rms)
            continue;
        best = Detection{fit->camera_from_face * inverse(board_from_face(target_, match->face)),
                         *match, *fit};
        if (match->agreement > sure_agreement)
            break;
    }
    return best;
}

}  // namespace theatron::registration
