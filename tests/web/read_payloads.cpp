// SPDX-License-Identifier: Apache-2.0
// Decodes with the web build, under node, what tests/slow_decoders/write_payloads.cpp wrote
// natively, and compares it with the pixels that the native decoder gave:
//
//   read_payloads FOLDER
//
// Prints a line for each codec of this build, "codec NAME FRAMES", and one for each difference.
// Damaged copies of each payload must be refused or decoded: nothing else is checked of them.
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "codec/depth_stream.h"

namespace theatron::codec {
namespace {

Bytes read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    const std::string text = content.str();
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

// A stream of one setting.
struct Stream {
    explicit Stream(const DepthSetting& setting)
        : decoder(setting), damaged(setting), layers(setting.layers) {}
    DepthStreamDecoder decoder, damaged;
    int layers;
    std::uint32_t position = 0;  // since the first frame
};

bool decodes(Stream& stream, FrameLink link, const Bytes& payload, const Bytes& expected) {
    link.layer = temporal_layer(stream.layers, stream.position++);
    const Result<Size> size = stream.decoder.read_size(payload);
    if (!size || size->area() * 2 != expected.size())
        return false;
    DepthImage image(*size);
    if (stream.decoder.decode(link, payload, image.view()) != Status::ok)
        return false;
    const auto pixels = std::as_bytes(std::span(image.pixels));
    return std::equal(pixels.begin(), pixels.end(), expected.begin());
}

void decode_damaged(Stream& stream, FrameLink link, const Bytes& payload) {
    constexpr std::size_t copies = 20;
    const std::size_t step = payload.size() / copies + 1;
    const Size size = stream.damaged.read_size(payload).value();
    DepthImage image(size);
    for (std::size_t place = 0; place < payload.size(); place += step) {
        Bytes bent = payload;
        bent[place] ^= std::byte{0x15};
        (void)stream.damaged.decode(link, bent, image.view());
        const Bytes cut(payload.begin(), payload.begin() + std::ptrdiff_t(place));
        (void)stream.damaged.decode(link, cut, image.view());
    }
    (void)stream.damaged.decode(link, payload, image.view());
}

int read_all(const std::string& folder) {
    std::ifstream index(folder + "/index.txt");
    std::unique_ptr<Stream> stream;
    std::map<std::string, int> frames;
    int wrong = 0, first = 0;
    std::string name, text;
    FrameLink link;
    while (index >> name >> text >> first >> link.frame >> link.reference_frame) {
        const ParsedDepthSetting parsed = parse_depth_setting(text);
        if (!parsed.problem.empty())
            continue;
        link.key = link.frame == link.reference_frame;
        if (first != 0)
            stream = std::make_unique<Stream>(parsed.setting);
        const Bytes payload = read_file(folder + "/" + name + ".payload");
        if (!decodes(*stream, link, payload, read_file(folder + "/" + name + ".depth"))) {
            std::printf("frame %s of %s differs\n", name.c_str(), text.c_str());
            ++wrong;
        } else {
            decode_damaged(*stream, link, payload);
        }
        ++frames[text.substr(0, text.find(':'))];
    }
    for (const auto& [codec, count] : frames)
        std::printf("codec %s %d\n", codec.c_str(), count);
    return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace theatron::codec

int main(int count, char** words) {
    return count == 2 ? theatron::codec::read_all(words[1]) : 2;
}
