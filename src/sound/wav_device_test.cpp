// SPDX-License-Identifier: Apache-2.0
#include "sound/wav_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "base/error.h"
#include "sound/wav_bytes.h"
#include "testing/temporary_folder.h"

namespace theatron::sound {
namespace {

constexpr std::size_t rate_at = 24;  // in the head of a WAV file

std::string refusal_of_rate(std::uint32_t samples_per_second) {
    const testing::TemporaryFolder folder;
    Bytes bytes = wav_bytes(std::vector<std::int16_t>(480, 100));
    for (std::size_t i = 0; i < 4; ++i)
        bytes[rate_at + i] = std::byte(samples_per_second >> (8 * i));
    const std::string file = (folder.path() / "said.wav").string();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    try {
        (void)open_wav_microphone(file, [](std::span<const float>) {});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

Bytes with_size(Bytes wav, std::uint32_t size) {
    store_le(wav.data() + wav_head_size - 4, size);
    return wav;
}

TEST(WavBytes, AStreamedFileGetsTheSizeThatItHas) {
    const Bytes whole = wav_bytes(std::vector<std::int16_t>(480, 100));
    Bytes streamed = with_size(whole, 0);
    mend_streamed_wav(streamed);
    EXPECT_EQ(streamed, whole);
    for (const std::uint32_t size : {std::uint32_t(960), std::uint32_t(100), ~std::uint32_t(0)}) {
        Bytes stated = with_size(whole, size);
        mend_streamed_wav(stated);
        EXPECT_EQ(stated, with_size(whole, size)) << size;
    }
    // No samples, but a text behind them.
    Bytes empty = wav_head(0);
    ByteWriter out(empty);
    out.put_bytes(as_bytes("LIST"));
    out.put(std::uint32_t(4));
    out.put_bytes(as_bytes("INFO"));
    const Bytes before = empty;
    mend_streamed_wav(empty);
    EXPECT_EQ(empty, before);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        Bytes cut(whole.begin(), whole.begin() + std::ptrdiff_t(n));
        mend_streamed_wav(cut);
        EXPECT_EQ(cut.size(), n);
    }
}

TEST(WavMicrophone, HearsAStreamedFile) {
    const testing::TemporaryFolder folder;
    const Bytes bytes = with_size(wav_bytes(std::vector<std::int16_t>(480, 100)), 0);
    const std::string file = (folder.path() / "said.wav").string();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    EXPECT_NO_THROW(open_wav_microphone(file, [](std::span<const float>) {}));
}

TEST(WavMicrophone, RefusesARateOfNoSoundCard) {
    EXPECT_THAT(refusal_of_rate(1), ::testing::HasSubstr("1 samples a second"));
    EXPECT_THAT(refusal_of_rate(4'000'000), ::testing::HasSubstr("from 4,000 to 384,000"));
    EXPECT_EQ(refusal_of_rate(8000), "");
    EXPECT_EQ(refusal_of_rate(192'000), "");
}

}  // namespace
}  // namespace theatron::sound
