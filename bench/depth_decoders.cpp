// SPDX-License-Identifier: Apache-2.0
// Times the portable depth codecs on frames of a file, natively or under node.
//
//   depth_decoders pack FOLDER FILE     the folder's depth/*.png as a file (native only)
//   depth_decoders time FILE            a line per codec: name, ms to encode, ms to decode
//
// The web build has no PNG reader, hence the file: width, height and number of
// frames as 32-bit numbers, then the pixels. It is made and read on one machine.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "codec/depth_stream.h"
#ifndef __EMSCRIPTEN__
#include <filesystem>

#include "files/png_file.h"
#endif

namespace theatron {
namespace {

[[noreturn]] void fail(const std::string& sentence) {
    std::fprintf(stderr, "depth_decoders: %s\n", sentence.c_str());
    std::exit(1);
}

#ifndef __EMSCRIPTEN__
void pack(const std::filesystem::path& folder, const char* file) {
    constexpr std::size_t most_frames = 30;
    std::vector<std::filesystem::path> pictures;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "depth"))
        pictures.push_back(entry.path());
    std::sort(pictures.begin(), pictures.end());
    pictures.resize(std::min(pictures.size(), most_frames));

    std::FILE* out = std::fopen(file, "wb");
    if (out == nullptr || pictures.empty())
        fail("nothing to pack, or no file to write.");
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const DepthImage image = files::read_depth_png(pictures[i]);
        const std::uint32_t head[3] = {std::uint32_t(image.size.width),
                                       std::uint32_t(image.size.height),
                                       std::uint32_t(pictures.size())};
        if (i == 0)
            std::fwrite(head, sizeof(head), 1, out);
        std::fwrite(image.pixels.data(), sizeof(image.pixels[0]), image.pixels.size(), out);
    }
    std::fclose(out);
}
#endif

std::vector<DepthImage> read_frames(const char* file) {
    std::FILE* in = std::fopen(file, "rb");
    std::uint32_t head[3] = {};
    if (in == nullptr || std::fread(head, sizeof(head), 1, in) != 1)
        fail(std::string("cannot read ") + file + ".");
    const Size size{int(head[0]), int(head[1])};
    if (!is_valid(size))
        fail("the file is not one that 'pack' made.");
    std::vector<DepthImage> frames;
    for (std::uint32_t i = 0; i < head[2]; ++i) {
        frames.emplace_back(size);
        std::vector<std::uint16_t>& pixels = frames.back().pixels;
        if (std::fread(pixels.data(), sizeof(pixels[0]), pixels.size(), in) != pixels.size())
            fail("the file ends too early.");
    }
    std::fclose(in);
    return frames;
}

double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The fastest of several passes for each frame, then the median of the frames
// after the first.
void time_codec(const std::string& name, const std::vector<DepthImage>& frames) {
    const codec::DepthSetting setting = codec::parse_depth_setting(name).setting;
    codec::DepthStreamEncoder encoder(setting);
    codec::DepthStreamDecoder decoder(setting);
    std::vector<double> encode_ms(frames.size(), 1e9), decode_ms(frames.size(), 1e9);
    std::vector<std::byte> encoded(encoder.max_encoded_size(frames[0].size));
    DepthImage decoded(frames[0].size);
    for (int pass = 0; pass < 10; ++pass) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            auto start = std::chrono::steady_clock::now();
            const codec::EncodedDepth link =
                encoder.encode(frames[i].view(), FrameNumber(i), i == 0, encoded);
            encode_ms[i] = std::min(encode_ms[i], ms_since(start));
            start = std::chrono::steady_clock::now();
            const Status status =
                decoder.decode(link, ByteView(encoded).first(link.bytes), decoded.view());
            decode_ms[i] = std::min(decode_ms[i], ms_since(start));
            if (status != Status::ok || !(decoded == frames[i]))
                fail(name + " does not give back what it encoded.");
        }
    }
    if (frames.size() > 1) {
        encode_ms.erase(encode_ms.begin());
        decode_ms.erase(decode_ms.begin());
    }
    std::printf("%s %.3f %.3f\n", name.c_str(), median(encode_ms), median(decode_ms));
}

}  // namespace
}  // namespace theatron

int main(int count, char** words) {
    using namespace theatron;
    const std::string what = count > 1 ? words[1] : "";
#ifndef __EMSCRIPTEN__
    if (what == "pack" && count == 4) {
        pack(words[2], words[3]);
        return 0;
    }
#endif
    if (what != "time" || count != 3)
        fail("say 'pack FOLDER FILE' or 'time FILE'.");
    const std::vector<DepthImage> frames = read_frames(words[2]);
    // The codecs that the web build has, too.
    for (const char* name : {"raw", "rvl", "trvl", "ans", "ans:delta=1", "strata"})
        time_codec(name, frames);
}
