// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "base/float_bytes.h"
#include "face/osc_face.h"

namespace theatron::face {
namespace {

void put_text(Bytes& out, std::string_view text) {
    for (const char c : text)
        out.push_back(std::byte(c));
    do
        out.push_back(std::byte(0));
    while (out.size() % 4 != 0);
}
void put_be(Bytes& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(std::byte(value >> shift));
}
std::uint32_t bits_of(float value) {
    std::byte bytes[4];
    store_f32(bytes, value);
    return load_le<std::uint32_t>(bytes);
}
Bytes osc_float(std::string_view address, float value) {
    Bytes out;
    put_text(out, address);
    put_text(out, ",f");
    put_be(out, bits_of(value));
    return out;
}
Bytes osc_truth(std::string_view address, bool value) {
    Bytes out;
    put_text(out, address);
    put_text(out, value ? ",T" : ",F");
    return out;
}
Bytes osc_bundle(std::initializer_list<Bytes> elements) {
    Bytes out;
    put_text(out, "#bundle");
    put_be(out, 0);
    put_be(out, 1);
    for (const Bytes& element : elements) {
        put_be(out, std::uint32_t(element.size()));
        out.insert(out.end(), element.begin(), element.end());
    }
    return out;
}

constexpr TimePoint start = from_us(1'000'000);

TEST(Osc, ReadsTheExampleOfTheSpecification) {
    // OSC 1.0, "/oscillator/4/frequency" with the float 440.0.
    Bytes packet = osc_float("/oscillator/4/frequency", 440);
    ASSERT_EQ(packet.size(), 32U);
    EXPECT_EQ(packet[28], std::byte(0x43));
    EXPECT_EQ(packet[29], std::byte(0xdc));
    int count = 0;
    EXPECT_EQ(read_osc(packet,
                       [&](const OscMessage& message) {
                           ++count;
                           EXPECT_EQ(message.address, "/oscillator/4/frequency");
                           EXPECT_FLOAT_EQ(message.value, 440);
                       }),
              Status::ok);
    EXPECT_EQ(count, 1);
}

TEST(Osc, EveryTruncationIsRefused) {
    const Bytes whole = osc_bundle({osc_float("/a/JawOpen", 1), osc_float("/a/JawLeft", 1)});
    for (std::size_t n = 1; n < whole.size(); ++n) {
        const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
        // A bundle may end after an element.
        if (n == 16 || n == 16 + 4 + 20)
            continue;
        EXPECT_NE(read_osc(part, [](const OscMessage&) {}), Status::ok) << n;
    }
}

TEST(Osc, BundlesInBundlesAreBounded) {
    Bytes packet = osc_float("/JawOpen", 1);
    for (int depth = 0; depth < max_osc_depth; ++depth)
        packet = osc_bundle({packet});
    EXPECT_EQ(read_osc(packet, [](const OscMessage&) {}), Status::ok);
    EXPECT_EQ(read_osc(osc_bundle({packet}), [](const OscMessage&) {}), Status::too_large);
}

TEST(OscFace, TakesBundlesUnderAnyPrefix) {
    OscFace face;
    EXPECT_TRUE(face.take(osc_bundle({osc_float("/avatar/parameters/FT/v2/JawOpen", 0.5F),
                                      osc_bundle({osc_float("/odd prefix//v2/MouthX", -0.25F)})}),
                          start));
    EXPECT_TRUE(face.take(osc_float("/eyeBlinkLeft", 1), start));
    const Mapped mapped = face.mapped();
    EXPECT_FLOAT_EQ(mapped.values[jaw_open], 0.5F);
    EXPECT_FLOAT_EQ(mapped.values[mouth_left], 0.25F);
    EXPECT_FLOAT_EQ(mapped.values[eye_blink_left], 1);
    EXPECT_FALSE(mapped.present[tongue_out]);
    EXPECT_EQ(face.counts().used, 3U);
}

TEST(OscFace, TakesThePacketOfTheActor) {
    Channels values{};
    values[jaw_open] = 0.25F;
    OscFace face;
    EXPECT_TRUE(face.take(osc_packet(values, table_of(Source::xr_htc).mask), start));
    EXPECT_EQ(face.mapped().values, values);
    EXPECT_EQ(face.mapped().present, table_of(Source::xr_htc).mask);
    EXPECT_EQ(face.counts().refused, 0U);
}

TEST(OscFace, TakesNamesAsTexts) {
    Bytes packet;
    put_text(packet, "/VMC/Ext/Blend/Val");
    put_text(packet, ",sf");
    put_text(packet, "TongueOut");
    put_be(packet, bits_of(0.75F));
    OscFace face;
    EXPECT_TRUE(face.take(packet, start));
    EXPECT_FLOAT_EQ(face.mapped().values[tongue_out], 0.75F);
}

TEST(OscFace, TakesBinaryParameters) {
    OscFace face;
    for (const auto& [name, value] :
         {std::pair("/v2/JawX1", true), std::pair("/v2/JawX2", false), std::pair("/v2/JawX4", true),
          std::pair("/v2/JawXNegative", true)})
        EXPECT_TRUE(face.take(osc_truth(name, value), start)) << name;
    EXPECT_FLOAT_EQ(face.mapped().values[jaw_left], 5.F / 7);
    EXPECT_FALSE(face.take(osc_truth("/v2/JawX3", true), start));
}

TEST(OscFace, CountsWhatItDoesNotUse) {
    OscFace face;
    EXPECT_FALSE(face.take(osc_float("/avatar/parameters/VelocityX", 1), start));
    EXPECT_FALSE(face.take(osc_float("/v2/JawOpen", NAN), start));
    EXPECT_FALSE(face.take(osc_float("/v2/JawOpen", 1e9F), start));
    EXPECT_FALSE(face.take(osc_truth("/v2/JawOpen", true), start));
    Bytes text;
    put_text(text, "/v2/JawOpen");
    put_text(text, ",s");
    put_text(text, "wide");
    EXPECT_FALSE(face.take(text, start));
    EXPECT_FALSE(face.take(Bytes(7, std::byte('x')), start));
    EXPECT_EQ(face.counts().unknown, 2U);  // VelocityX, "wide"
    EXPECT_EQ(face.counts().no_number, 3U);
    EXPECT_EQ(face.counts().refused, 1U);
    EXPECT_EQ(face.mapped().present.count(), 0U);
}

TEST(OscFace, AFloodIsBoundedAndCounted) {
    OscFace face;
    const Bytes packet = osc_float("/v2/JawOpen", 0.5F);
    for (int i = 0; i < OscFace::max_messages_per_second + 10; ++i)
        face.take(packet, start + 1ms);
    EXPECT_EQ(face.counts().flooded, 10U);
    EXPECT_FALSE(face.take(packet, start + 900ms));
    EXPECT_TRUE(face.take(packet, start + 1100ms));
}

}  // namespace
}  // namespace theatron::face
