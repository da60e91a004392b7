// SPDX-License-Identifier: Apache-2.0
#include "codec/strata.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "codec/test_images.h"
#include "testing/every_target.h"

namespace theatron::codec {
namespace {

using namespace strata;

// An encoder and a decoder that process the same frames.
struct Chain {
    explicit Chain(const StrataParams& params = {})
        : encoder(make_strata(params)), decoder(make_strata({})) {}

    // Encodes and decodes one frame. keep = false: no later frame refers to it.
    Status pass(const DepthImage& image, bool keep = true) {
        encoded.resize(encoder->max_encoded_size(image.size));
        encoded.resize(
            encoder->encode(image.view(), has_reference ? &at_encoder : nullptr, encoded, &sent));
        encoded = Bytes(encoded);
        decoded = DepthImage(image.size);
        const Status status = decoder->decode(encoded, has_reference ? &at_decoder : nullptr,
                                              decoded.view(), &received);
        EXPECT_EQ(sent.memory, received.memory);
        if (keep) {
            std::swap(at_encoder, sent);
            std::swap(at_decoder, received);
            has_reference = true;
        }
        return status;
    }

    std::unique_ptr<DepthCodec> encoder, decoder;
    Reference at_encoder, at_decoder, sent, received;
    bool has_reference = false;
    Bytes encoded;
    DepthImage decoded;
};

// The test vectors of docs/formats/depth_strata.md.
constexpr std::string_view golden_intra =
    "08010000030002001300000001000000000000000000000000000000f6a400001d63320000800000"
    "00800000008000000080000000800000008000000080000000800000008000000080000000800000"
    "00800000008000000080000000800000008000000080000000800000008000000080000000800000"
    "008000000080000000800000008000000080000000800000008000000080000000800000000d2b1f"
    "475c576ded834c665210a5f99c0000d049";
constexpr std::string_view golden_delta =
    "08010300030002001100000000000000000000000000000000000000000000000000000000004a54"
    "ec072e7ab40000800000008000000080000000800000008000000080000000800000008000000080"
    "00000080000000800000008000000080000000800000008000000080000000800000008000000080"
    "00000080000000800000008000000080000000800000008000000080000000800000008000000080"
    "0000008000000008a68ee41b7df92b64c1525ce8000000";
constexpr std::string_view golden_bounded =
    "08010800030002001000000000000000020001040000000001000000010002000000020000000000"
    "0000000000000000b0176528f3245d00008000000080000000800000008000000080000000800000"
    "00800000008000000080000000800000008000000080000000800000008000000080000000800000"
    "00800000008000000080000000800000008000000080000000800000008000000080000000800000"
    "00800000008000000080000000800000000d2b1f475c576ded834c6600000000";

constexpr std::string_view golden_tall_intra =
    "08010000820020003d00000003000000c808a2f138f7e405b2e11cfac4740e01c01e5f00e6ec0100"
    "e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100"
    "e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100"
    "e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec0100e6ec010001840167"
    "d9f020810db23691a09f2045a62c4de860060d9c31940d29331fff0ec55f5b0c717c435dca65e486"
    "43ed47478023d1c5aee26d5c54de7aae083001161ad260";
constexpr std::string_view golden_tall_delta =
    "08010100820020002400000028000000221ac5f7a2018a1862f34e03bcff12feb0f26501720cc674"
    "0e016fb28d00e4c96000e4c9600000e5940bdb5a700b40ef670c2ab65f0cfb730100047201009f8f"
    "0100b18e0100520e300020ec2f0083dd33003ae433000b372406fb1cfc058e9aa506838da306adc4"
    "0000cac3000071d50000cfd10000e8f118001e541900d1711a00973f1b00c1a4190356ec1c03a3cc"
    "550358ab010000df78a9785fa7f55645051de386a912d969b853391b57c4a43d5a3e4be493470ec5"
    "bc888edec2537b0ad14405b64f4ecc927679e71e86f44cd75c459fec9b2e7cc5e5c4aed1e0939661"
    "98b2eac0dcf419be38fc0d65f64d6daa8fc4dc0ac6a6a3fd5b1723603001ad7daefc0a2ca852161a"
    "d260";

Bytes from_hex(std::string_view hex) {
    Bytes result;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        result.push_back(std::byte(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
    return result;
}

DepthImage six_pixels(std::vector<std::uint16_t> pixels) {
    DepthImage image({3, 2});
    image.pixels = std::move(pixels);
    return image;
}

TEST(Strata, DecodesTheVectorsOfItsSpecification) {
    const auto codec = make_strata({});
    DepthImage out({3, 2});
    Reference intra;
    ASSERT_EQ(codec->decode(from_hex(golden_intra), nullptr, out.view(), &intra), Status::ok);
    EXPECT_EQ(out, six_pixels({1000, 1001, 0, 999, 1003, 65535}));
    ASSERT_EQ(codec->decode(from_hex(golden_delta), &intra, out.view(), nullptr), Status::ok);
    EXPECT_EQ(out, six_pixels({1001, 1001, 0, 1000, 1060, 1005}));
    ASSERT_EQ(codec->decode(from_hex(golden_bounded), nullptr, out.view(), nullptr), Status::ok);
    EXPECT_EQ(out, six_pixels({1000, 1000, 0, 999, 1004, 65535}));
    for (const std::string_view hex : {golden_intra, golden_delta, golden_bounded}) {
        const Bytes whole = from_hex(hex);
        for (std::size_t n = 0; n < whole.size(); ++n) {
            const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
            EXPECT_EQ(codec->decode(part, &intra, out.view(), nullptr), Status::truncated) << n;
        }
    }
}

// Height: a multiple of 32. Width: more than the coded part of the row after it.
TEST(Strata, DecodesTheVectorsOf32Rows) {
    const Size size{130, 32};
    DepthImage first(size), second(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            first.view().row(y)[x] = std::uint16_t(1000 + x + 8 * y);
            second.view().row(y)[x] = std::uint16_t(1001 + x + 8 * y + x * y / 512);
        }
    }
    const auto codec = make_strata({});
    Reference reference;
    DepthImage out(size);
    ASSERT_EQ(codec->decode(from_hex(golden_tall_intra), nullptr, out.view(), &reference),
              Status::ok);
    EXPECT_EQ(out, first);
    ASSERT_EQ(codec->decode(from_hex(golden_tall_delta), &reference, out.view(), nullptr),
              Status::ok);
    EXPECT_EQ(out, second);
}

// Depths of a sensor that measures disparities: few distinct values.
DepthImage disparities(Size size, unsigned frame) {
    DepthImage image = scene(size, frame);
    for (auto& pixel : image.pixels) {
        if (pixel != 0 && pixel != 0xffff)
            pixel = std::uint16_t(2'000'000 / (2'000'000 / (pixel + 500)) % 60000);
    }
    return image;
}

TEST(Strata, RoundTripsAnyImageOfAnySize) {
    const Size sizes[] = {{1, 1},    {1, 7},    {7, 1},   {31, 33},
                          {129, 32}, {200, 70}, {640, 3}, {3, 300}};
    for (const Size size : sizes) {
        SCOPED_TRACE(::testing::Message() << size.width << " x " << size.height);
        Chain chain;
        for (unsigned frame = 0; frame < 3; ++frame) {
            for (const DepthImage& image :
                 {scene(size, frame), noise(size, frame), disparities(size, frame)}) {
                ASSERT_EQ(chain.pass(image), Status::ok);
                ASSERT_EQ(chain.decoded, image);
            }
        }
    }
}

TEST(Strata, RoundTripsImagesOfOneValue) {
    for (const int value : {0, 1, 1000, 32768, 65534, 65535}) {
        Chain chain;
        DepthImage image({150, 40});
        image.pixels.assign(image.pixels.size(), std::uint16_t(value));
        for (int frame = 0; frame < 2; ++frame) {
            ASSERT_EQ(chain.pass(image), Status::ok);
            ASSERT_EQ(chain.decoded, image);
        }
        // Only parameters, states and tables are left.
        EXPECT_LT(chain.encoded.size(), 400u);
    }
}

TEST(Strata, FramesMayBeSkipped) {
    Chain chain;
    for (unsigned frame = 0; frame < 12; ++frame) {
        const DepthImage image =
            frame < 6 ? disparities({140, 50}, frame) : scene({140, 50}, frame);
        ASSERT_EQ(chain.pass(image, frame % 3 == 0), Status::ok);
        ASSERT_EQ(chain.decoded, image);
    }
}

// Scratch memory belongs to the thread; contents left by one codec must not affect
// another.
TEST(Strata, CodecsThatTakeTurnsOnAThreadGiveTheBytesThatEachGivesAlone) {
    const Size sizes[] = {{200, 90}, {140, 50}, {31, 70}};
    const auto image_of = [&](std::size_t stream, unsigned frame) {
        return stream == 1 ? disparities(sizes[stream], frame) : scene(sizes[stream], frame);
    };
    constexpr unsigned frames = 5;
    std::vector<Bytes> alone[3];
    for (std::size_t stream = 0; stream < 3; ++stream)
        std::thread([&] {
            Chain chain;
            for (unsigned frame = 0; frame < frames; ++frame) {
                EXPECT_EQ(chain.pass(image_of(stream, frame)), Status::ok);
                alone[stream].push_back(chain.encoded);
            }
        }).join();

    Chain chains[3];
    for (unsigned frame = 0; frame < frames; ++frame)
        for (std::size_t stream = 0; stream < 3; ++stream) {
            const DepthImage image = image_of(stream, frame);
            ASSERT_EQ(chains[stream].pass(image), Status::ok);
            ASSERT_EQ(chains[stream].decoded, image);
            ASSERT_EQ(chains[stream].encoded, alone[stream][frame]) << stream << ", " << frame;
        }
}

TEST(Strata, NeverExceedsItsBound) {
    for (const Size size : {Size{1, 1}, Size{64, 64}, Size{300, 100}}) {
        Chain chain;
        ASSERT_EQ(chain.pass(noise(size, 3)), Status::ok);
        EXPECT_LE(chain.encoded.size(), chain.encoder->max_encoded_size(size));
    }
}

TEST(Strata, EncodesRowsWithAStride) {
    const DepthImage wide = scene({160, 40}, 1);
    const DepthView part{wide.pixels.data() + 7, {133, 40}, 160};
    const auto codec = make_strata({});
    Bytes encoded(codec->max_encoded_size(part.size));
    encoded.resize(codec->encode(part, nullptr, encoded, nullptr));
    DepthImage out({160, 40});
    const MutableDepthView target{out.pixels.data() + 7, {133, 40}, 160};
    ASSERT_EQ(codec->decode(encoded, nullptr, target, nullptr), Status::ok);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 133; ++x)
            ASSERT_EQ(target.row(y)[x], part.row(y)[x]);
    }
}

TEST(Strata, RefusesEveryTruncation) {
    Chain chain;
    ASSERT_EQ(chain.pass(scene({24, 9}, 1)), Status::ok);
    ASSERT_EQ(chain.pass(scene({24, 9}, 2), false), Status::ok);
    DepthImage out({24, 9});
    for (std::size_t n = 0; n < chain.encoded.size(); ++n) {
        const Bytes part(chain.encoded.begin(), chain.encoded.begin() + std::ptrdiff_t(n));
        EXPECT_NE(chain.decoder->decode(part, &chain.at_decoder, out.view(), nullptr), Status::ok);
    }
    chain.encoded.push_back(std::byte{0});
    EXPECT_EQ(chain.decoder->decode(chain.encoded, &chain.at_decoder, out.view(), nullptr),
              Status::trailing_bytes);
}

TEST(Strata, SaysWhatIsWrongWithAHeader) {
    Chain chain;
    const DepthImage image = scene({24, 9}, 1);
    ASSERT_EQ(chain.pass(image), Status::ok);
    const auto with = [&](std::size_t at, int value) {
        Bytes changed = chain.encoded;
        changed[at] = std::byte(value);
        DepthImage out(image.size);
        return chain.decoder->decode(changed, nullptr, out.view(), nullptr);
    };
    EXPECT_EQ(with(0, 7), Status::malformed);
    EXPECT_EQ(with(1, 2), Status::unsupported_version);
    EXPECT_EQ(with(2, 16), Status::malformed);
    EXPECT_EQ(with(3, 1), Status::malformed);
    EXPECT_EQ(with(4, 25), Status::size_mismatch);
    EXPECT_EQ(with(5, 255), Status::too_large);
    ASSERT_EQ(chain.pass(image), Status::ok);
    DepthImage out(image.size);
    EXPECT_EQ(chain.decoder->decode(chain.encoded, nullptr, out.view(), nullptr),
              Status::missing_reference);
    const Reference foreign{image, {}};
    EXPECT_EQ(chain.decoder->decode(chain.encoded, &foreign, out.view(), nullptr),
              Status::missing_reference);
}

TEST(Strata, EncodesAgainstAReferenceOfAnotherCodecAsAnIntraFrame) {
    const auto codec = make_strata({});
    const DepthImage image = scene({40, 20}, 1);
    const Reference foreign{image, {}};
    Bytes encoded(codec->max_encoded_size(image.size));
    encoded.resize(codec->encode(image.view(), &foreign, encoded, nullptr));
    DepthImage out(image.size);
    ASSERT_EQ(codec->decode(encoded, nullptr, out.view(), nullptr), Status::ok);
    EXPECT_EQ(out, image);
}

int error_bound(const StrataParams& params, int depth) {
    const int square = int((std::uint32_t(depth) * std::uint32_t(depth)) >> 16) >> 4;
    return std::min(2047, params.max_error_mm + params.noise_scaled * square);
}

TEST(Strata, KeepsToTheDeclaredErrorAndNeverChangesValidity) {
    for (const StrataParams params : {StrataParams{1, 0, true}, StrataParams{5, 2, true},
                                      StrataParams{0, 3, true}, StrataParams{255, 15, true}}) {
        Chain chain(params);
        for (unsigned frame = 0; frame < 6; ++frame) {
            const Size size{150, 70};
            const DepthImage image = frame == 2   ? noise(size, frame)
                                     : frame == 3 ? disparities(size, frame)
                                                  : scene(size, frame);
            chain.has_reference &= frame != 3;
            ASSERT_EQ(chain.pass(image), Status::ok);
            for (std::size_t i = 0; i < image.pixels.size(); ++i) {
                const int before = image.pixels[i], after = chain.decoded.pixels[i];
                ASSERT_EQ(before == 0, after == 0);
                ASSERT_EQ(before == 0xffff, after == 0xffff);
                const bool measured = before != 0 && before != 0xffff;
                const int bound = measured ? error_bound(params, before) : 0;
                ASSERT_LE(std::abs(before - after), bound) << before;
            }
        }
    }
}

TEST(Strata, StaysExactWhereTheRegionIs) {
    Chain chain({20, 0});
    const DepthImage image = scene({150, 70}, 0);
    // Empty region: the whole image is exact.
    ASSERT_EQ(chain.pass(image), Status::ok);
    EXPECT_EQ(chain.decoded, image);
    EXPECT_TRUE(read_strata_exactness(chain.encoded)->whole_image);

    const Region region = {box(10, 5, 60, 40), {{100, 10}, {140, 60}, {90, 60}}};
    chain.encoder->set_region(region);
    for (unsigned frame = 1; frame < 4; ++frame) {
        const DepthImage next = scene({150, 70}, frame);
        ASSERT_EQ(chain.pass(next), Status::ok);
        EXPECT_FALSE(read_strata_exactness(chain.encoded)->whole_image);
        EXPECT_EQ(read_strata_exactness(chain.encoded)->region, region);
        std::vector<std::uint8_t> inside(next.pixels.size());
        draw_region(region, {inside.data(), next.size});
        std::size_t exact = 0, changed = 0;
        for (std::size_t i = 0; i < next.pixels.size(); ++i) {
            const bool equal = chain.decoded.pixels[i] == next.pixels[i];
            ASSERT_TRUE(equal || inside[i] == 0) << i;
            exact += inside[i] != 0;
            changed += !equal;
        }
        EXPECT_GT(exact, 2000u);
        EXPECT_GT(changed, 2000u);
    }
}

TEST(StrataRegion, DrawsThePixelsWhoseCentreIsInside) {
    std::vector<std::uint8_t> drawn(6 * 4);
    const View<std::uint8_t> view{drawn.data(), {6, 4}};
    draw_region({box(1, 1, 3, 3)}, view);
    const std::vector<std::uint8_t> square = {0, 0,   0,   0, 0, 0,  //
                                              0, 255, 255, 0, 0, 0,  //
                                              0, 255, 255, 0, 0, 0,  //
                                              0, 0,   0,   0, 0, 0};
    EXPECT_EQ(drawn, square);
    draw_region({{{0, 0}, {6, 0}, {0, 4}}}, view);
    const std::vector<std::uint8_t> triangle = {255, 255, 255, 255, 255, 0,  //
                                                255, 255, 255, 255, 0,   0,  //
                                                255, 255, 0,   0,   0,   0,  //
                                                255, 0,   0,   0,   0,   0};
    EXPECT_EQ(drawn, triangle);
    draw_region({box(0, 0, 9000, 9000)}, view);
    EXPECT_EQ(drawn, std::vector<std::uint8_t>(24, 255));
}

TEST(Strata, EveryTargetDecodesTheBytesOfEveryOther) {
    std::vector<Bytes> encoded;
    const DepthImage images[] = {scene({170, 66}, 0), scene({170, 66}, 1), noise({170, 66}, 2)};
    testing::on_every_target([&] {
        Chain lossless, lossy({6, 1});
        lossy.encoder->set_region({box(20, 10, 60, 50)});
        std::vector<Bytes> now;
        for (const DepthImage& image : images) {
            ASSERT_EQ(lossless.pass(image), Status::ok);
            ASSERT_EQ(lossless.decoded, image);
            ASSERT_EQ(lossy.pass(image), Status::ok);
            now.push_back(lossy.encoded);
        }
        if (encoded.empty())
            encoded = now;
    });
    // Each target decodes the bytes of all others.
    testing::on_every_target([&] {
        const auto decoder = make_strata({});
        Reference reference, next;
        for (std::size_t i = 0; i < encoded.size(); ++i) {
            DepthImage out(images[i].size);
            ASSERT_EQ(decoder->decode(encoded[i], i > 0 ? &reference : nullptr, out.view(), &next),
                      Status::ok);
            std::swap(reference, next);
        }
    });
}

}  // namespace
}  // namespace theatron::codec
