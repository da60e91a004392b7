// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "codec/strata_reference.h"
#include "codec/strata_values.h"
#include "codec/test_images.h"
#include "testing/every_target.h"

namespace theatron::codec {
namespace {

using namespace strata;

// A model with planes of its own.
struct Planes {
    explicit Planes(Size size)
        : layout(layout_of(size)),
          depth(layout.plane_values()),
          valid(layout.plane_steps()),
          pixels(layout.coded_values()),
          token(layout.coded_values()),
          extra(layout.coded_values()),
          has_extra(std::size_t(layout.steps)) {}

    void encode(const DepthImage& image, const Planes* before, const Weights& weights, bool blend) {
        Model model;
        model.layout = layout;
        model.depth = depth.data();
        model.valid = valid.data();
        model.weights = weights;
        model.blend = blend;
        if (before != nullptr) {
            model.reference_depth = before->depth.data();
            model.reference_valid = before->valid.data();
        }
        rows_to_steps(layout, image.view(), pixels.data());
        counts = {};
        encode_model(model, pixels.data(), {token.data(), extra.data(), has_extra.data(), &counts});
    }

    Layout layout;
    std::vector<std::uint16_t> depth;
    std::vector<std::uint64_t> valid;
    std::vector<std::uint16_t> pixels, token, extra;
    std::vector<std::uint8_t> has_extra;
    TokenCounts counts;
};

// Two frames, the second refers to the first, and the reference model's result.
struct ReferenceCase {
    ReferenceCase(Size size, bool blend) : blend(blend) {
        ReferenceModel first(size, weights, blend), second(size, weights, blend);
        images = {scene(size, 1), size.width == 40 ? noise(size, 2) : scene(size, 2)};
        expected = {first.encode(images[0].view(), nullptr),
                    second.encode(images[1].view(), &first)};
    }

    static constexpr Weights weights = {9000,  -3000, 4000,  -2000, 1000, 500,
                                        12000, -4000, -3000, 2000,  1500};
    bool blend;
    std::array<DepthImage, 2> images;
    std::array<std::vector<ReferenceModel::Coded>, 2> expected;
};

// Heights that are and are not multiples of 32; widths below and above the part of the
// row after the last group that lane 0 reaches.
TEST(StrataKernel, EveryTargetEqualsTheReference) {
    std::vector<ReferenceCase> cases;
    for (const Size size : {Size{1, 1}, Size{40, 35}, Size{160, 70}, Size{100, 64}, Size{121, 32},
                            Size{122, 32}, Size{123, 32}, Size{320, 288}}) {
        for (const bool blend : {false, true})
            cases.emplace_back(size, blend);
    }
    cases.emplace_back(Size{640, 576}, true);
    testing::on_every_target([&] {
        for (const ReferenceCase& c : cases) {
            const Size size = c.images[0].size;
            SCOPED_TRACE(::testing::Message() << size.width << " x " << size.height);
            Planes planes[] = {Planes(size), Planes(size)};
            for (std::size_t frame = 0; frame < 2; ++frame) {
                planes[frame].encode(c.images[frame], frame > 0 ? &planes[0] : nullptr,
                                     ReferenceCase::weights, c.blend);
                for (int y = 0; y < size.height; ++y) {
                    for (int x = 0; x < size.width; ++x) {
                        const std::size_t at =
                            std::size_t(planes[frame].layout.step_of(x, y)) * lane_count +
                            std::size_t(y % lane_count);
                        const auto& e = c.expected[frame][std::size_t(y * size.width + x)];
                        ASSERT_EQ(planes[frame].token[at], e.token) << x << ' ' << y;
                        ASSERT_EQ(planes[frame].extra[at], e.extra) << x << ' ' << y;
                    }
                }
            }
        }
    });
}

TEST(StrataKernel, EveryTargetCountsTheTokensAndMarksFurtherBits) {
    testing::on_every_target([&] {
        for (const Size size : {Size{1, 1}, Size{160, 70}}) {
            Planes planes(size);
            planes.encode(scene(size, 3), nullptr, {}, true);
            Counts counts{}, expected{};
            for (std::size_t i = 0; i < counts.size(); ++i) {
                for (const Counts& part : planes.counts.of)
                    counts[i] += part[i];
            }
            for (int t = 0; t < planes.layout.steps; ++t) {
                bool has_extra = false;
                for (int lane = 0; lane < lane_count; ++lane) {
                    const unsigned token = planes.token[std::size_t(t * lane_count + lane)];
                    ++expected[token];
                    has_extra |= extra_bits(token % token_count) > 0;
                }
                EXPECT_EQ(planes.has_extra[std::size_t(t)], has_extra) << "step " << t;
            }
            EXPECT_EQ(counts, expected);
        }
    });
}

TEST(StrataKernel, EveryTargetFindsEachPixelsPlace) {
    testing::on_every_target([&] {
        for (const Size size : {Size{1, 1}, Size{7, 33}, Size{131, 31}, Size{132, 32},
                                Size{133, 33}, Size{150, 64}, Size{200, 70}}) {
            const DepthImage image = noise(size, 4);
            const Layout layout = layout_of(size);
            std::vector<std::uint16_t> pixels(layout.coded_values(), 0xabcd),
                expected(layout.coded_values());
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x)
                    expected[std::size_t(layout.step_of(x, y) * lane_count + y % lane_count)] =
                        image.view().row(y)[x];
            }
            rows_to_steps(layout, image.view(), pixels.data());
            ASSERT_EQ(pixels, expected) << size.width << " x " << size.height;
            DepthImage back(size);
            steps_to_rows(layout, pixels.data(), nullptr, back.view());
            ASSERT_EQ(back, image);
        }
    });
}

TEST(StrataValues, RanksOfNewValuesAreThoseOfATableMadeAnew) {
    std::mt19937 rng(5);
    for (const unsigned added : {0u, 1u, 24u, 25u, 300u}) {
        DepthImage image(Size{50, 40});
        for (std::uint16_t& depth : image.pixels) {
            const std::uint16_t kinds[] = {0, 65535, std::uint16_t(100 + 7 * (rng() % 200))};
            depth = kinds[rng() % 3];
        }
        const Layout layout = layout_of(image.size);
        strata::Values values = {100, 107, 5000};
        RankTables tables;
        std::vector<std::uint16_t> ranks(layout.coded_values()), again(layout.coded_values());
        ASSERT_TRUE(tables.to_ranks(layout, image.view(), values, ranks.data()));
        for (unsigned i = 0; i < added; ++i)
            image.pixels[rng() % image.pixels.size()] = std::uint16_t(1 + rng() % 65534);
        const strata::Values before = values;
        ASSERT_TRUE(tables.to_ranks(layout, image.view(), values, ranks.data()));
        EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
        EXPECT_TRUE(std::includes(values.begin(), values.end(), before.begin(), before.end()));
        strata::Values same = values;
        ASSERT_TRUE(RankTables().to_ranks(layout, image.view(), same, again.data()));
        EXPECT_EQ(same, values);
        EXPECT_EQ(again, ranks);
        RankTables backward;
        const std::uint16_t* const depths = backward.depths_of(values);
        rows_to_steps(layout, image.view(), again.data());
        for (std::size_t i = 0; i < ranks.size(); ++i)
            ASSERT_EQ(depths[ranks[i]], again[i]);
    }
}

}  // namespace
}  // namespace theatron::codec
