// SPDX-License-Identifier: Apache-2.0
#include "compare_judging.h"

#include <algorithm>
#include <utility>

#include "compare_sights.h"
#include "render/picture_quality.h"

namespace theatron::bench {
namespace {

// Pixels in which something is drawn.
Image<std::uint8_t> drawn_mask(DepthView drawn_mm) {
    Image<std::uint8_t> mask(drawn_mm.size);
    for (int y = 0; y < mask.size.height; ++y)
        for (int x = 0; x < mask.size.width; ++x)
            mask.view().row(y)[x] = drawn_mm.row(y)[x] != 0;
    return mask;
}

// Sums the differences of drawn pictures from the exact ones.
class LikenessSum {
public:
    void add(const render::Picture& drawn, const ViewBenchPlace& place) {
        error_.add(drawn.color.view(), place.exact_color.view(), place.seen.view());
        similarity_.add(drawn.color.view(), place.exact_color.view(), place.seen.view());
        holes_.add(drawn.depth_mm.view(), place.exact_mm.view(), place.seen.view());
        const Image<std::uint8_t> is_drawn = drawn_mask(drawn.depth_mm.view());
        for (std::size_t i = 0; i < is_drawn.pixels.size(); ++i) {
            undrawn_ += !is_drawn.pixels[i];
            undrawn_unseen_ += !is_drawn.pixels[i] && !place.seen.pixels[i];
        }
        pixels_ += double(is_drawn.pixels.size());
        see_through_.add(drawn.depth_mm.view(), place.exact_mm.view(), is_drawn.view());
    }
    CompareLikeness result() const {
        return {.psnr_db = error_.psnr_db(),
                .ssim = similarity_.mean(),
                .holes_percent = holes_.percent(),
                .undrawn_percent = 100 * undrawn_ / pixels_,
                .undrawn_unseen_percent = 100 * undrawn_unseen_ / pixels_,
                .see_through_percent = see_through_.percent()};
    }

private:
    render::SquaredError error_;
    render::Similarity similarity_;
    render::Holes holes_, see_through_;
    double undrawn_ = 0, undrawn_unseen_ = 0, pixels_ = 0;
};

CompareCloseUp judged_close_up(const ViewBenchPlace& exact, render::Picture drawn,
                               const std::vector<CauseCamera>& cameras) {
    LikenessSum likeness;
    likeness.add(drawn, exact);
    const Image<std::uint8_t> is_drawn = drawn_mask(drawn.depth_mm.view());
    CauseInput input{exact.view, drawn.depth_mm.view(), exact.exact_mm.view(), exact.seen.view(),
                     is_drawn.view()};
    const CompareCauses see_through = causes_of(input, cameras);
    constexpr int behind_instruments_mm = 20;
    input.where = exact.instrument.view();
    input.jump_mm = behind_instruments_mm;
    const CompareCauses instruments = causes_of(input, cameras);
    return {std::move(drawn.color), likeness.result(), see_through, instruments};
}

ExactSurfaces surfaces_of(const ViewBenchPlace& place) {
    return {place.view, place.exact_mm.view()};
}

void judge_wound(CompareMethod& method, const CompareViews& exact) {
    Image<std::uint8_t> whole(exact.close_up.exact_mm.size);
    std::fill(whole.pixels.begin(), whole.pixels.end(), std::uint8_t(1));
    method.wound = {shares_of(*method.sights, exact.near_wound.view()),
                    shares_of(*method.sights, std::as_const(whole).view()),
                    {}};
}

}  // namespace

CompareOwnView own_view_of(const ColorImage& exact, const ColorImage& arrived) {
    Image<std::uint8_t> all(exact.size);
    std::fill(all.pixels.begin(), all.pixels.end(), 255);
    render::SquaredError error;
    render::Similarity similarity;
    error.add(arrived.view(), exact.view(), all.view());
    similarity.add(arrived.view(), exact.view(), all.view());
    return {error.psnr_db(), similarity.mean()};
}

void judge(CompareMethod& method, const CompareViews& exact, DrawnViews drawn,
           const std::vector<CauseCamera>& cameras, Image<float> details) {
    LikenessSum all;
    for (std::size_t i = 0; i < drawn.places.size(); ++i) {
        LikenessSum one;
        one.add(drawn.places[i], exact.places[i]);
        all.add(drawn.places[i], exact.places[i]);
        method.from_place.push_back(one.result());
        method.pictures.push_back(std::move(drawn.places[i].color));
    }
    method.expert = all.result();
    const ViewBenchPlace& place = exact.close_up;
    const DepthView drawn_mm = drawn.close_up.depth_mm.view();
    method.sights = sights_of_drawn(surfaces_of(place), drawn_mm, std::move(details));
    judge_wound(method, exact);
    method.wound->lost = causes_of({place.view, drawn_mm, place.exact_mm.view(), place.seen.view(),
                                    exact.near_wound.view(), shown_within_mm},
                                   cameras, *method.sights);
    method.close_up = judged_close_up(place, std::move(drawn.close_up), cameras);
}

void judge_video(CompareMethod& method, const CompareViews& exact, Image<float> details) {
    method.sights = sights_of_video(surfaces_of(exact.close_up), std::move(details));
    judge_wound(method, exact);
}

void judge_pair(CompareMethod& method, const CompareViews& exact, const CompareMethod& one,
                const CompareMethod& other) {
    method.sights = sights_of_both(*one.sights, *other.sights);
    judge_wound(method, exact);
}

}  // namespace theatron::bench
