// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <random>
#include <span>

#include "base/error.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "testing/temporary_folder.h"

namespace theatron::files {
namespace {

using ::testing::HasSubstr;

const Size sizes[] = {{1, 1}, {1, 9}, {17, 33}};

DepthImage noise(Size size) {
    std::mt19937 rng(1);
    DepthImage image(size);
    for (auto& p : image.pixels)
        p = std::uint16_t(rng());
    return image;
}

ColorImage color_noise(Size size) {
    std::mt19937 rng(2);
    ColorImage image(size);
    for (auto& p : image.pixels)
        p = {std::uint8_t(rng()), std::uint8_t(rng()), std::uint8_t(rng())};
    return image;
}

template <class Action>
std::string sentence(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(WriteFile, WritesIntoAPipeAndLeavesIt) {
    const theatron::testing::TemporaryFolder folder;
    const auto pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    const std::string text = "figures";
    require_writable(pipe);
    write_file(pipe, std::as_bytes(std::span(text)));
    char got[16] = {};
    EXPECT_EQ(read(reader, got, sizeof got), ssize_t(text.size()));
    EXPECT_EQ(got, text);
    close(reader);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "pipe.part"));
}

TEST(Png, DepthComesBackBitByBit) {
    const theatron::testing::TemporaryFolder folder;
    for (const Size size : sizes) {
        const DepthImage image = noise(size);
        write_png(folder.path() / "d.png", image.view());
        EXPECT_EQ(read_depth_png(folder.path() / "d.png"), image);
    }
}

TEST(Png, ColorComesBackBitByBit) {
    const theatron::testing::TemporaryFolder folder;
    for (const Size size : sizes) {
        const ColorImage image = color_noise(size);
        write_png(folder.path() / "c.png", image.view());
        EXPECT_EQ(read_color_png(folder.path() / "c.png"), image);
    }
}

TEST(Png, RowsNeedNotTouch) {
    const DepthImage image = noise({8, 4});
    DepthImage left_half;
    EXPECT_EQ(decode_png(encode_png(DepthView(image.pixels.data(), {4, 4}, 8)), left_half), "");
    EXPECT_EQ(left_half.pixels[5], image.pixels[9]);
}

TEST(Png, DepthIsBigEndianInTheFile) {
    DepthImage image({1, 1});
    image.pixels = {0x0102};
    ColorImage as_color;
    ASSERT_EQ(decode_png(encode_png(image.view()), as_color), "");
    EXPECT_EQ(as_color.pixels[0].r, 1);  // the high byte
}

TEST(Png, EveryTruncationIsRefused) {
    const Bytes whole = encode_png(noise({5, 4}).view());
    DepthImage out;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
        EXPECT_NE(decode_png(part, out), "") << n << " bytes";
    }
}

TEST(Png, SaysInOneSentenceWhatIsWrong) {
    const theatron::testing::TemporaryFolder folder;
    const auto path = folder.path() / "x.png";
    const auto reading = [&] { return sentence([&] { read_depth_png(path); }); };
    const std::string name = "'" + path.string() + "'";

    EXPECT_EQ(reading(), "Cannot read " + name + ": there is no such file.");
    write_file(path, as_bytes("hello"));
    EXPECT_EQ(reading(), name + " is not a PNG picture.");
    std::filesystem::remove(path);
    write_png(path, color_noise({3, 3}).view());
    EXPECT_EQ(reading(),
              name + " is a PNG picture of 8 bits in colour, but depth needs 16 bits grey.");
    Bytes damaged = encode_png(noise({9, 9}).view());
    damaged[damaged.size() / 2] ^= std::byte{0x55};
    write_file(path, damaged);
    EXPECT_EQ(reading(), name + " is a damaged PNG picture.");
    EXPECT_THAT(sentence([&] { read_depth_png(folder.path()); }), HasSubstr("it is not a file"));
    EXPECT_THAT(sentence([&] { write_file(folder.path() / "none" / "x", {}); }),
                HasSubstr("No such file"));
}

TEST(Png, RefusesPicturesBeyondTheLimit) {
    // Only the header of a picture 8193 pixels wide, with a correct checksum.
    Bytes png = encode_png(noise({1, 1}).view());
    png[18] = std::byte{0x20};
    const auto sum = crc32(0, reinterpret_cast<const unsigned char*>(&png[12]), 17);
    for (std::size_t i = 0; i < 4; ++i)
        png[29 + i] = std::byte(std::uint8_t(sum >> (24 - 8 * i)));
    DepthImage out;
    EXPECT_EQ(decode_png(png, out), "is a damaged PNG picture");
    EXPECT_TRUE(out.empty());
}

TEST(Png, ReplacesAPictureButNoOtherFile) {
    const theatron::testing::TemporaryFolder folder;
    const auto path = folder.path() / "view.png";
    const DepthImage image = noise({3, 3});
    write_file(path, {});  // empty
    write_png(path, image.view());
    write_png(path, image.view());
    const Bytes recording(64, std::byte{0x1a});
    write_file(path, recording);
    EXPECT_THAT(sentence([&] { write_png(path, image.view()); }),
                HasSubstr("exists already and is not a PNG picture"));
    EXPECT_EQ(read_file(path), recording);
}

TEST(FileBytes, AFileThatIsThereIsReplacedOnlyWhereThatIsWanted) {
    const theatron::testing::TemporaryFolder folder;
    const auto path = folder.path() / "a.mkv";
    require_new(path, false);
    write_file(path, Bytes(5));
    require_new(path, true);
    EXPECT_EQ(sentence([&] { require_new(path, false); }),
              "'" + path.string() + "' exists already; name another file, or give --overwrite.");
}

TEST(FileBytes, AnOutputIsNotTheInputUnderAnotherName) {
    const theatron::testing::TemporaryFolder folder;
    const auto path = folder.path() / "a.mkv";
    write_file(path, Bytes(5));
    std::filesystem::create_symlink(path, folder.path() / "b.mkv");
    for (const auto& same : {path, folder.path() / "." / "a.mkv", folder.path() / "b.mkv"})
        EXPECT_THAT(sentence([&] { require_other_file(same, path); }), HasSubstr("is read"));
    require_other_file(folder.path() / "c.mkv", path);
}

}  // namespace
}  // namespace theatron::files
