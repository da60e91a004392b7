// SPDX-License-Identifier: Apache-2.0
// Times the portable depth codecs on frames of a file, natively or under node.
//
//   depth_decoders pack FOLDER FILE     the folder's depth/*.png as a file (native only)
//   depth_decoders time FILE            a line per codec: name, ms to encode, ms to decode
//
// The web build has no PNG reader, hence the file: width, height and number of
// frames as 32-bit numbers, then the pixels, then the encoded frames of the codecs that
// the web build only decodes. It is made and read on one machine.
#include <algorithm>
#include <array>
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

// A stream that was encoded elsewhere.
struct EncodedFrame {
    codec::EncodedDepth link;
    Bytes bytes;
};
using EncodedStream = std::vector<EncodedFrame>;

// Their encoders are not in the web build.
constexpr std::array library_codecs{"zstd", "zstd:delta=1", "lz4"};

#ifndef __EMSCRIPTEN__
EncodedStream encode(const std::string& name, const std::vector<DepthImage>& frames) {
    codec::DepthStreamEncoder encoder(codec::parse_depth_setting(name).setting);
    EncodedStream stream;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Bytes bytes(encoder.max_encoded_size(frames[i].size));
        const auto link = encoder.encode(frames[i].view(), FrameNumber(i), i == 0, bytes);
        bytes.resize(link.bytes);
        stream.push_back({link, std::move(bytes)});
    }
    return stream;
}

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
    std::vector<DepthImage> frames;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const DepthImage& image = frames.emplace_back(files::read_depth_png(pictures[i]));
        const std::uint32_t head[3] = {std::uint32_t(image.size.width),
                                       std::uint32_t(image.size.height),
                                       std::uint32_t(pictures.size())};
        if (i == 0)
            std::fwrite(head, sizeof(head), 1, out);
        std::fwrite(image.pixels.data(), sizeof(image.pixels[0]), image.pixels.size(), out);
    }
    for (const char* name : library_codecs) {
        for (const EncodedFrame& frame : encode(name, frames)) {
            const std::uint32_t link[3] = {frame.link.frame, frame.link.reference_frame,
                                           std::uint32_t(frame.link.bytes)};
            std::fwrite(link, sizeof(link), 1, out);
            std::fwrite(frame.bytes.data(), 1, frame.bytes.size(), out);
        }
    }
    std::fclose(out);
}
#endif

struct Packed {
    std::vector<DepthImage> frames;
    std::array<EncodedStream, library_codecs.size()> encoded;
};

Packed read_packed(const char* file) {
    std::FILE* in = std::fopen(file, "rb");
    const auto take = [&](void* place, std::size_t count) {
        if (in == nullptr || std::fread(place, 1, count, in) != count)
            fail(std::string(file) + " is missing, or ends too early.");
    };
    std::uint32_t head[3] = {};
    take(head, sizeof(head));
    const Size size{int(head[0]), int(head[1])};
    if (!is_valid(size))
        fail("the file is not one that 'pack' made.");
    Packed packed;
    for (std::uint32_t i = 0; i < head[2]; ++i) {
        std::vector<std::uint16_t>& pixels = packed.frames.emplace_back(size).pixels;
        take(pixels.data(), pixels.size() * sizeof(pixels[0]));
    }
    for (EncodedStream& stream : packed.encoded) {
        for (std::uint32_t i = 0; i < head[2]; ++i) {
            std::uint32_t link[3] = {};
            take(link, sizeof(link));
            EncodedFrame& frame = stream.emplace_back();
            frame.link.frame = link[0];
            frame.link.reference_frame = link[1];
            frame.link.key = link[0] == link[1];
            frame.bytes.resize(link[2]);
            take(frame.bytes.data(), frame.bytes.size());
        }
    }
    std::fclose(in);
    return packed;
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

constexpr int passes = 10;

// The fastest of several passes for each frame, then the median of the frames
// after the first.
double typical(std::vector<double> fastest_ms) {
    if (fastest_ms.size() > 1)
        fastest_ms.erase(fastest_ms.begin());
    return median(std::move(fastest_ms));
}

void time_codec(const std::string& name, const std::vector<DepthImage>& frames) {
    const codec::DepthSetting setting = codec::parse_depth_setting(name).setting;
    codec::DepthStreamEncoder encoder(setting);
    codec::DepthStreamDecoder decoder(setting);
    std::vector<double> encode_ms(frames.size(), 1e9), decode_ms(frames.size(), 1e9);
    std::vector<std::byte> encoded(encoder.max_encoded_size(frames[0].size));
    DepthImage decoded(frames[0].size);
    for (int pass = 0; pass < passes; ++pass) {
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
    std::printf("%s %.3f %.3f\n", name.c_str(), typical(encode_ms), typical(decode_ms));
}

// Only decodes.
void time_decoder(const std::string& name, const EncodedStream& stream,
                  const std::vector<DepthImage>& frames) {
    const codec::ParsedDepthSetting parsed = codec::parse_depth_setting(name);
    if (!parsed.problem.empty())
        return;
    codec::DepthStreamDecoder decoder(parsed.setting);
    std::vector<double> decode_ms(frames.size(), 1e9);
    DepthImage decoded(frames[0].size);
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            const Status status = decoder.decode(stream[i].link, stream[i].bytes, decoded.view());
            decode_ms[i] = std::min(decode_ms[i], ms_since(start));
            if (status != Status::ok || !(decoded == frames[i]))
                fail(name + " does not give back what was encoded.");
        }
    }
    std::printf("%s - %.3f\n", name.c_str(), typical(decode_ms));
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
    const Packed packed = read_packed(words[2]);
    for (const char* name : {"raw", "rvl", "trvl", "ans", "ans:delta=1", "strata"})
        time_codec(name, packed.frames);
    for (std::size_t i = 0; i < library_codecs.size(); ++i)
        time_decoder(library_codecs[i], packed.encoded[i], packed.frames);
}
