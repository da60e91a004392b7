// SPDX-License-Identifier: Apache-2.0
// Payloads of every depth codec for the decoders in this folder, with the pixels
// that the program's own decoder gives.
//
//   write_payloads OUT [FOLDER...]     FOLDER: depth/*.png, 16 bits
//
// OUT/index.txt has a line for each frame: file, codec, first frame of a stream or not,
// frame, reference frame. File N.payload is the encoded image, N.depth the decoded
// pixels, two bytes each, rows from the top. Each folder gives a part of its first frames;
// the first folder also gives two whole frames.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "codec/depth_stream.h"
#include "codec/test_images.h"
#include "files/png_file.h"

namespace theatron::codec {
namespace {

// Its height is a multiple of Strata's 32 rows, its width more than the 122 columns in which
// the row below the last one counts.
constexpr Size part_size{132, 64};
constexpr unsigned part_frames = 3;

const std::vector<std::string> usual_settings = {"raw",          "rvl",   "trvl",        "zstd",
                                                 "zstd:delta=1", "lz4",   "lz4:delta=1", "ans",
                                                 "ans:delta=1",  "strata"};
const std::vector<std::string> more_settings = {"trvl:layers=3",
                                                "zstd:delta=1,layers=3",
                                                "strata:layers=3",
                                                "lz4:quant_mm=3",
                                                "lz4:delta=1,quant_mm=10",
                                                "strata:max_error_mm=4,noise_scaled=2",
                                                "strata:max_error_mm=20,everywhere=1"};

DepthImage part_of(const DepthImage& whole, Size size, int x, int y) {
    DepthImage part(size);
    for (int row = 0; row < size.height; ++row)
        std::copy_n(whole.view().row(y + row) + x, size.width, part.view().row(row));
    return part;
}

// The middle of the first frames. If there is a single picture, overlapping parts of it.
std::vector<DepthImage> parts_of(const std::vector<DepthImage>& frames) {
    const Size whole = frames.front().size;
    const Size size{std::min(part_size.width, whole.width - 2),
                    std::min(part_size.height, whole.height)};
    const int x = (whole.width - size.width) / 2, y = (whole.height - size.height) / 2;
    std::vector<DepthImage> parts;
    for (unsigned i = 0; i < part_frames; ++i) {
        const bool single = frames.size() == 1;
        if (single || i < frames.size())
            parts.push_back(part_of(frames[single ? 0 : i], size, single ? x + int(i) : x, y));
    }
    return parts;
}

std::vector<DepthImage> first_frames(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> pictures;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "depth"))
        pictures.push_back(entry.path());
    std::sort(pictures.begin(), pictures.end());
    pictures.resize(std::min<std::size_t>(pictures.size(), part_frames));
    std::vector<DepthImage> frames;
    for (const auto& picture : pictures)
        frames.push_back(files::read_depth_png(picture));
    return frames;
}

// As a sensor that measures disparities gives it: few values, and new ones in later frames.
DepthImage disparities(DepthImage image, unsigned frame) {
    for (auto& pixel : image.pixels) {
        if (pixel != 0 && pixel != 0xffff)
            pixel = std::uint16_t(100'000 / (100'000 / (pixel + 20 * frame)));
    }
    return image;
}

class Writer {
public:
    explicit Writer(std::filesystem::path folder) : folder_(std::move(folder)) {
        std::filesystem::create_directories(folder_);
        index_.open(folder_ / "index.txt");
    }

    void write(const std::vector<DepthImage>& frames, const std::string& setting_text) {
        const ParsedDepthSetting parsed = parse_depth_setting(setting_text);
        DepthStreamEncoder encoder(parsed.setting);
        DepthStreamDecoder decoder(parsed.setting);
        // A triangle and a box that overlap, and a corner outside the image.
        encoder.set_region({{{10, 5}, {70, 40}, {30, 60}}, strata::box(50, 20, 200, 50)});
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const DepthImage& image = frames[i];
            Bytes encoded(encoder.max_encoded_size(image.size));
            const EncodedDepth link = encoder.encode(image.view(), FrameNumber(i), i == 0, encoded);
            DepthImage decoded(image.size);
            const ByteView payload = ByteView(encoded).first(link.bytes);
            if (!parsed.problem.empty() ||
                decoder.decode(link, payload, decoded.view()) != Status::ok) {
                std::fprintf(stderr, "write_payloads: %s does not decode.\n", setting_text.c_str());
                std::exit(1);
            }
            const std::string name = std::to_string(count_++);
            put(name + ".payload", payload.data(), payload.size());
            put(name + ".depth", decoded.pixels.data(), decoded.pixels.size() * 2);
            index_ << name << ' ' << setting_text << ' ' << (i == 0) << ' ' << link.frame << ' '
                   << link.reference_frame << '\n';
        }
    }

private:
    void put(const std::string& name, const void* bytes, std::size_t count) {
        std::ofstream(folder_ / name, std::ios::binary)
            .write(static_cast<const char*>(bytes), std::streamsize(count));
    }

    std::filesystem::path folder_;
    std::ofstream index_;
    int count_ = 0;
};

void write_all(const std::filesystem::path& out, const std::vector<std::string>& folders) {
    Writer writer(out);
    std::vector<DepthImage> scenes, values;
    for (unsigned i = 0; i < part_frames + 2; ++i) {
        scenes.push_back(scene(part_size, i));
        values.push_back(disparities(scene({40, 33}, i), i));
    }
    for (const auto& settings : {usual_settings, more_settings}) {
        for (const std::string& setting : settings)
            writer.write(scenes, setting);
    }
    writer.write(values, "strata");
    writer.write({noise({50, 40}, 1), noise({50, 40}, 2)}, "strata");
    writer.write({noise({50, 40}, 1), noise({50, 40}, 2)}, "strata:max_error_mm=20,everywhere=1");
    for (const std::string& name : depth_codec_names())
        writer.write({scene({7, 5}, 1), scene({7, 5}, 2)}, name);
    for (const std::string& folder : folders) {
        const std::vector<DepthImage> frames = first_frames(folder);
        const std::vector<DepthImage> parts = parts_of(frames);
        for (const std::string& setting : usual_settings)
            writer.write(parts, setting);
        if (folder == folders.front())
            writer.write({frames.begin(), frames.begin() + std::min<std::ptrdiff_t>(
                                                               2, std::ptrdiff_t(frames.size()))},
                         "strata");
    }
}

}  // namespace
}  // namespace theatron::codec

int main(int count, char** arguments) {
    if (count < 2) {
        std::fprintf(stderr, "Usage: write_payloads OUT [FOLDER...]\n");
        return 1;
    }
    theatron::codec::write_all(arguments[1], {arguments + 2, arguments + count});
}
