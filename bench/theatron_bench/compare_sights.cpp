// SPDX-License-Identifier: Apache-2.0
#include "compare_sights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "base/statistics.h"

namespace theatron::bench {
namespace {

// Two exact distances that differ by at most this are of one surface: pixels of two cameras do not
// lie at the same points of it.
constexpr double same_surface_m = 0.01;

// The surface in the room; nullopt where there is none.
std::optional<Vec3> surface_at(const ExactSurfaces& exact, int x, int y) {
    const Size size = exact.exact_mm.size;
    const double z = exact.exact_mm.row(y)[x] / 1000.0;
    if (z <= 0)
        return std::nullopt;
    const render::CameraView& view = exact.view;
    return view.room_from_eye *
           Vec3{(view.left + (view.right - view.left) * (x + 0.5) / size.width) * z,
                (view.top + (view.bottom - view.top) * (y + 0.5) / size.height) * z, z};
}

// The size of the camera's pixels at a point of the room, 0 if it does not see the point.
double detail_of(const SightCamera& camera, const Pose& lens_from_room, const CameraModel& raster,
                 Vec3 point_room) {
    const Vec3 p = lens_from_room * point_room;
    const auto place = project(raster, p);
    const Size size = raster.size;
    if (!place || place->x < 0 || place->y < 0 || place->x > size.width - 1 ||
        place->y > size.height - 1)
        return 0;
    const int x0 = int(place->x), y0 = int(place->y);
    bool is_seen = false;
    for (int y = y0; y <= std::min(y0 + 1, size.height - 1); ++y)
        for (int x = x0; x <= std::min(x0 + 1, size.width - 1); ++x) {
            const double z = camera.exact_m.row(y)[x];
            is_seen = is_seen || (z > 0 && std::abs(z - p.z) <= same_surface_m);
        }
    const double own_mm_at_1m = 1000 / camera.lens.fx;
    return is_seen
               ? std::max(std::max(own_mm_at_1m, camera.coarsest_mm_at_1m) * p.z, camera.grid_mm)
               : 0;
}

bool fits(const CompareSights& sights, Size size) {
    return sights.seen.size == size && sights.detail_mm.size == size;
}

Seen both_of(Seen one, Seen other) {
    for (const Seen seen : {Seen::nothing_there, Seen::rightly, Seen::wrongly})
        if (one == seen || other == seen)
            return seen;
    return Seen::hidden;
}

float finer_of(float one_mm, float other_mm) {
    return one_mm == 0 || other_mm == 0 ? std::max(one_mm, other_mm) : std::min(one_mm, other_mm);
}

constexpr Rgb replaced_color{255, 0, 190}, hidden_color{0, 225, 255}, region_color{255, 255, 255};
constexpr int stripe = 12, stripe_width = 5;  // pixels

bool is_border(View<const std::uint8_t> region, int x, int y) {
    if (!region.row(y)[x])
        return false;
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, region.size.height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, region.size.width - 1); ++nx)
            if (!region.row(ny)[nx])
                return true;
    return false;
}

}  // namespace

Image<float> finest_details(const ExactSurfaces& exact, const std::vector<SightCamera>& cameras) {
    std::vector<Pose> lenses_from_room;
    std::vector<CameraModel> rasters;
    for (const SightCamera& camera : cameras) {
        lenses_from_room.push_back(inverse(camera.room_from_lens));
        rasters.push_back(scaled(camera.lens, camera.exact_m.size));
    }
    const Size size = exact.exact_mm.size;
    Image<float> finest(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (const auto point = surface_at(exact, x, y))
                for (std::size_t i = 0; i < cameras.size(); ++i) {
                    const double mm =
                        detail_of(cameras[i], lenses_from_room[i], rasters[i], *point);
                    float& best = finest.view().row(y)[x];
                    best = finer_of(best, float(mm));
                }
    return finest;
}

CompareSights sights_of_video(const ExactSurfaces& exact, Image<float> details) {
    CompareSights sights{Image<Seen>(details.size), std::move(details)};
    for (int y = 0; y < exact.exact_mm.size.height; ++y)
        for (int x = 0; x < exact.exact_mm.size.width; ++x)
            if (exact.exact_mm.row(y)[x] > 0)
                sights.seen.view().row(y)[x] =
                    sights.detail_mm.view().row(y)[x] > 0 ? Seen::rightly : Seen::hidden;
    return sights;
}

CompareSights sights_of_drawn(const ExactSurfaces& exact, DepthView drawn_mm,
                              Image<float> details) {
    assert(drawn_mm.size == exact.exact_mm.size && details.size == drawn_mm.size);
    CompareSights sights{Image<Seen>(details.size), std::move(details)};
    for (int y = 0; y < drawn_mm.size.height; ++y)
        for (int x = 0; x < drawn_mm.size.width; ++x) {
            const int there = exact.exact_mm.row(y)[x], drawn = drawn_mm.row(y)[x];
            if (there > 0)
                sights.seen.view().row(y)[x] = drawn == 0 ? Seen::hidden
                                               : std::abs(drawn - there) <= shown_within_mm
                                                   ? Seen::rightly
                                                   : Seen::wrongly;
        }
    return sights;
}

CompareSights sights_of_both(const CompareSights& one, const CompareSights& other) {
    const Size size = one.seen.size;
    assert(fits(one, size) && fits(other, size));
    CompareSights both{Image<Seen>(size), Image<float>(size)};
    const auto detail_where_shown = [](const CompareSights& sights, std::size_t i) {
        return sights.seen.pixels[i] == Seen::rightly ? sights.detail_mm.pixels[i] : 0.0F;
    };
    for (std::size_t i = 0; i < size.area(); ++i) {
        both.seen.pixels[i] = both_of(one.seen.pixels[i], other.seen.pixels[i]);
        both.detail_mm.pixels[i] =
            finer_of(detail_where_shown(one, i), detail_where_shown(other, i));
    }
    return both;
}

Image<std::uint8_t> region_around(const render::CameraView& view, Size picture, Vec3 point_room,
                                  double diameter_m) {
    Image<std::uint8_t> region(picture);
    const Vec3 middle = inverse(view.room_from_eye) * point_room;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Vec3 ray{view.left + (view.right - view.left) * (x + 0.5) / picture.width,
                           view.top + (view.bottom - view.top) * (y + 0.5) / picture.height, 1};
            const Vec3 nearest = ray * (dot(middle, ray) / dot(ray, ray));
            region.view().row(y)[x] = length(nearest - middle) <= diameter_m / 2;
        }
    return region;
}

CompareShares shares_of(const CompareSights& sights, View<const std::uint8_t> region) {
    assert(fits(sights, region.size));
    std::vector<double> details;
    double all = 0, rightly = 0, wrongly = 0, finely = 0;
    for (int y = 0; y < region.size.height; ++y)
        for (int x = 0; x < region.size.width; ++x) {
            const Seen seen = sights.seen.view().row(y)[x];
            if (!region.row(y)[x] || seen == Seen::nothing_there)
                continue;
            ++all;
            wrongly += seen == Seen::wrongly;
            if (seen != Seen::rightly)
                continue;
            ++rightly;
            const double mm = sights.detail_mm.view().row(y)[x];
            finely += mm > 0 && mm <= fine_detail_mm;
            if (mm > 0)
                details.push_back(mm);
        }
    if (all == 0)
        return {};
    const double percent = 100 / all;
    return {.rightly_percent = rightly * percent,
            .wrongly_percent = wrongly * percent,
            .hidden_percent = (all - rightly - wrongly) * percent,
            .finely_percent = finely * percent,
            .detail_mm = median(std::move(details))};
}

ColorImage marked(const ColorImage& picture, const CompareSights& sights,
                  View<const std::uint8_t> region) {
    assert(fits(sights, picture.size) && region.size == picture.size);
    ColorImage out = picture;
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            Rgb& pixel = out.view().row(y)[x];
            const Seen seen = sights.seen.view().row(y)[x];
            if (seen == Seen::wrongly && (x + y) % stripe < stripe_width)
                pixel = replaced_color;
            if (seen == Seen::hidden && (x - y + picture.size.height) % stripe < stripe_width)
                pixel = hidden_color;
            if (is_border(region, x, y))
                pixel = region_color;
        }
    return out;
}

}  // namespace theatron::bench
