// SPDX-License-Identifier: Apache-2.0
// Properties of every codec of the family.
#include "codec/depth_codec.h"

#include <gtest/gtest.h>

#include "codec/payload_header.h"
#include "codec/test_images.h"

namespace theatron::codec {
namespace {

DepthSetting setting(const std::string& text) {
    const ParsedDepthSetting parsed = parse_depth_setting(text);
    EXPECT_EQ(parsed.problem, "");
    return parsed.setting;
}

// A copy of exact size, so that the sanitizers see any read past the end.
Bytes encoded(DepthCodec& codec, DepthView depth, const Reference* reference = nullptr,
              Reference* next = nullptr) {
    Bytes out(codec.max_encoded_size(depth.size));
    out.resize(codec.encode(depth, reference, out, next));
    return Bytes(out);
}

// The reference on both sides after a key frame of the image.
Reference reference_to(const DepthImage& image, DepthCodec& codec) {
    Reference reference;
    encoded(codec, image.view(), nullptr, &reference);
    return reference;
}

class EveryDepthCodec : public ::testing::TestWithParam<const char*> {
protected:
    std::unique_ptr<DepthCodec> codec_ = make_depth_codec(setting(GetParam()));
};

TEST_P(EveryDepthCodec, GivesBackAnyImage) {
    for (const Size size : {Size{1, 1}, Size{1, 7}, Size{7, 1}, Size{3, 5}, Size{64, 9}}) {
        for (unsigned seed = 0; seed < 4; ++seed) {
            for (const DepthImage& image :
                 {noise(size, seed), scene(size, seed), DepthImage(size)}) {
                const Bytes whole = encoded(*codec_, image.view());
                ASSERT_EQ(codec_->read_size(whole).value(), size);
                DepthImage decoded(size);
                ASSERT_EQ(codec_->decode(whole, nullptr, decoded.view(), nullptr), Status::ok);
                ASSERT_EQ(decoded, image) << size.width << "x" << size.height;
            }
        }
    }
}

TEST_P(EveryDepthCodec, GivesBackAnyChangeFromAnyReference) {
    const Size size{33, 17};
    DepthImage full(size);
    for (auto& pixel : full.pixels)
        pixel = 0xffff;
    const DepthImage images[] = {noise(size, 1), scene(size, 1), scene(size, 2), full,
                                 DepthImage(size)};
    for (const DepthImage& before : images) {
        for (const DepthImage& image : images) {
            const Reference reference = reference_to(before, *codec_);
            const Bytes whole = encoded(*codec_, image.view(), &reference);
            DepthImage decoded(size);
            ASSERT_EQ(codec_->decode(whole, &reference, decoded.view(), nullptr), Status::ok);
            ASSERT_EQ(decoded, image);
        }
    }
}

TEST_P(EveryDepthCodec, HandsOnWhatTheNextFrameRefersTo) {
    Reference at_encoder[2], at_decoder[2];
    for (unsigned frame = 0; frame < 6; ++frame) {
        const DepthImage image = scene({40, 30}, frame);
        const unsigned old = frame % 2, now = 1 - old;
        const Bytes whole =
            encoded(*codec_, image.view(), frame ? &at_encoder[old] : nullptr, &at_encoder[now]);
        DepthImage decoded(image.size);
        ASSERT_EQ(codec_->decode(whole, frame ? &at_decoder[old] : nullptr, decoded.view(),
                                 &at_decoder[now]),
                  Status::ok);
        ASSERT_EQ(decoded, image);
        EXPECT_EQ(at_decoder[now].depth, at_encoder[now].depth);
        EXPECT_EQ(at_decoder[now].memory, at_encoder[now].memory);
    }
}

TEST_P(EveryDepthCodec, ReadsAndWritesPartsOfLargerImages) {
    const DepthImage large = scene({50, 40}, 3);
    const Size size{31, 20};
    const DepthView part{large.pixels.data() + 50 * 7 + 9, size, 50};
    const Bytes whole = encoded(*codec_, part);

    DepthImage target({60, 30});
    const MutableDepthView out{target.pixels.data() + 60 * 3 + 5, size, 60};
    ASSERT_EQ(codec_->decode(whole, nullptr, out, nullptr), Status::ok);
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 60; ++x) {
            const bool inside = x >= 5 && x < 36 && y >= 3 && y < 23;
            const std::uint16_t expected = inside ? part.row(y - 3)[x - 5] : std::uint16_t(0);
            ASSERT_EQ(target.view().row(y)[x], expected) << x << "," << y;
        }
    }
}

TEST_P(EveryDepthCodec, RefusesEveryTruncation) {
    const Reference reference = reference_to(scene({24, 10}, 1), *codec_);
    for (const Reference* before : {static_cast<const Reference*>(nullptr), &reference}) {
        const Bytes whole = encoded(*codec_, scene({24, 10}, 2).view(), before);
        DepthImage out({24, 10});
        for (std::size_t n = 0; n < whole.size(); ++n) {
            const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
            EXPECT_NE(codec_->decode(part, before, out.view(), nullptr), Status::ok)
                << n << " of " << whole.size() << " bytes";
        }
    }
}

TEST_P(EveryDepthCodec, RefusesSurplusBytes) {
    Bytes whole = encoded(*codec_, scene({24, 10}, 2).view());
    whole.push_back(std::byte{0});
    DepthImage out({24, 10});
    EXPECT_NE(codec_->decode(whole, nullptr, out.view(), nullptr), Status::ok);
}

TEST_P(EveryDepthCodec, RefusesWhatTheHeaderForbids) {
    const DepthImage image = scene({24, 10}, 2);
    const Bytes good = encoded(*codec_, image.view());
    const auto status_with = [&](std::size_t at, int value) {
        Bytes changed = good;
        changed[at] = std::byte(value);
        DepthImage out(image.size);
        return codec_->decode(changed, nullptr, out.view(), nullptr);
    };
    EXPECT_EQ(status_with(0, 99), Status::malformed) << "another codec";
    EXPECT_EQ(status_with(1, 0), Status::malformed) << "version 0";
    EXPECT_EQ(status_with(1, 2), Status::unsupported_version);
    EXPECT_EQ(status_with(2, 0x80), Status::malformed) << "a flag without meaning";
    EXPECT_EQ(status_with(4, 25), Status::size_mismatch);
    EXPECT_EQ(status_with(5, 0x20), Status::too_large) << "8216 columns";
    EXPECT_EQ(status_with(6, 0), Status::malformed) << "no rows";
}

TEST_P(EveryDepthCodec, RefusesADeltaFrameWithoutItsReference) {
    const Reference reference = reference_to(scene({24, 10}, 1), *codec_);
    const Bytes whole = encoded(*codec_, scene({24, 10}, 2).view(), &reference);
    DepthImage out({24, 10});
    const Status without = codec_->decode(whole, nullptr, out.view(), nullptr);
    EXPECT_EQ(without, codec_->temporal() ? Status::missing_reference : Status::ok);
    if (!codec_->temporal())
        return;
    const Reference other_size = reference_to(scene({10, 24}, 1), *codec_);
    EXPECT_EQ(codec_->decode(whole, &other_size, out.view(), nullptr), Status::missing_reference);
}

TEST_P(EveryDepthCodec, SurvivesDamagedBytes) {
    const Reference reference = reference_to(scene({24, 10}, 1), *codec_);
    const Bytes whole = encoded(*codec_, scene({24, 10}, 2).view(), &reference);
    std::mt19937 random(5);
    DepthImage out({24, 10});
    for (int round = 0; round < 3000; ++round) {
        Bytes damaged = whole;
        for (unsigned n = 1 + random() % 3; n > 0; --n)
            damaged[random() % damaged.size()] = std::byte(random());
        // Both results are allowed; the sanitizers check memory accesses.
        (void)codec_->decode(damaged, &reference, out.view(), nullptr);
    }
}

INSTANTIATE_TEST_SUITE_P(DepthCodecs, EveryDepthCodec,
                         ::testing::Values("raw", "rvl", "trvl", "zstd", "zstd:level=3",
                                           "zstd:delta=1", "ans", "ans:delta=1", "lz4",
                                           "lz4:delta=1", "strata"),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             for (char& c : name)
                                 c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return name;
                         });

// Quantisation is the only loss, and it is bounded.
TEST(QuantisedDepth, KeepsValidityAndItsBound) {
    DepthImage all({256, 256});
    for (std::size_t i = 0; i < all.pixels.size(); ++i)
        all.pixels[i] = std::uint16_t(i);
    const Reference before{noise(all.size, 1), {}};
    for (const int step : {2, 3, 4, 7, 10, 64, 99, 100}) {
        for (const char* delta : {"", ",delta=1"}) {
            const auto codec =
                make_depth_codec(setting("lz4:quant_mm=" + std::to_string(step) + delta));
            EXPECT_FALSE(codec->lossless());
            // The reference is the decoder's version of an earlier frame.
            Reference held, next;
            DepthImage decoded(all.size);
            const Bytes first = encoded(*codec, before.depth.view(), nullptr, &held);
            const Reference* reference = codec->temporal() ? &held : nullptr;
            const Bytes whole = encoded(*codec, all.view(), reference, &next);
            ASSERT_EQ(codec->decode(whole, reference, decoded.view(), nullptr), Status::ok);
            for (int v = 0; v < 0x10000; ++v) {
                const int back = decoded.pixels[std::size_t(v)];
                ASSERT_EQ(v == 0, back == 0) << v;
                ASSERT_LE(std::abs(v - back), step / 2) << v << " with step " << step;
            }
            if (codec->temporal()) {
                EXPECT_EQ(next.depth, decoded) << "both sides refer to the same depth";
            }
        }
    }
}

TEST(DepthSettings, HaveOneSpelling) {
    EXPECT_EQ(setting("trvl").text, "trvl");
    EXPECT_EQ(setting("zstd:level=1,delta=0").text, "zstd");
    EXPECT_EQ(setting("zstd:level=3,delta=1"), setting("zstd:delta=1,level=3"));
    EXPECT_EQ(setting("lz4:quant_mm=2,delta=1").text, "lz4:delta=1,quant_mm=2");
    EXPECT_EQ(setting("zstd:layers=2,delta=1").text, "zstd:delta=1,layers=2");
    EXPECT_EQ(setting("rvl:delta=1"), setting("trvl"));
    EXPECT_EQ(setting("rvl:delta=1,layers=3").text, "trvl:layers=3");
    EXPECT_EQ(setting(setting("zstd:level=3,delta=1").text).text, "zstd:delta=1,level=3");
}

TEST(DepthSettings, CarryIdAndLayers) {
    EXPECT_EQ(setting("raw").id, DepthCodecId::raw);
    EXPECT_EQ(setting("rvl:delta=1").id, DepthCodecId::trvl);
    EXPECT_EQ(setting("trvl").layers, 1);
    EXPECT_EQ(setting("trvl:layers=3").layers, 3);
}

TEST(DepthSettings, SayWhatIsWrong) {
    const auto problem = [](std::string_view text) { return parse_depth_setting(text).problem; };
    EXPECT_NE(problem("zip").find("'zip' does not exist; choose one of: raw, rvl, trvl"),
              std::string::npos);
    EXPECT_NE(problem("").find("choose one of"), std::string::npos);
    EXPECT_NE(problem("rvl:level=3").find("'level' is unknown"), std::string::npos);
    EXPECT_NE(problem("zstd:level=20").find("from 1 to 19"), std::string::npos);
    EXPECT_NE(problem("zstd:fast").find("'fast' is not a key=value pair"), std::string::npos);
    EXPECT_NE(problem("trvl:layers=4").find("from 1 to 3"), std::string::npos);
    EXPECT_NE(problem("rvl:layers=2").find("layers need a codec"), std::string::npos);
    EXPECT_NE(problem("zstd:layers=2").find("layers need a codec"), std::string::npos);
}

}  // namespace
}  // namespace theatron::codec
