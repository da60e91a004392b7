// SPDX-License-Identifier: Apache-2.0
#include "bench_color.h"

#include <zstd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/statistics.h"
#include "bench_libjpeg.h"
#include "bench_ssim.h"
#include "bench_video.h"
#include "synthetic/sensor_model.h"
#include "video/color_codec.h"

namespace theatron::bench {
namespace {

constexpr int passes = 3;

double timed_ms(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    return took.count();
}

double squared_error(ColorView a, ColorView b) {
    double sum = 0;
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x) {
            const Rgb p = a.row(y)[x], q = b.row(y)[x];
            for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b})
                sum += d * d;
        }
    return sum;
}

// Measurements of one codec, one value per frame.
struct Measured {
    std::vector<double> bytes, encode_ms, decode_ms;
    double squared_error = 0;
    double ssim = 0;  // mean of all frames
};

nlohmann::json row(const std::string& name, const Measured& m,
                   const std::vector<ColorImage>& frames) {
    // The first frame is excluded, unless it is the only one.
    const auto rest = [](const std::vector<double>& v) {
        return v.size() > 1 ? std::vector<double>(v.begin() + 1, v.end()) : v;
    };
    double mean = 0;
    for (const double b : rest(m.bytes))
        mean += b;
    mean /= double(rest(m.bytes).size());
    const double values = double(frames.size() * frames[0].pixels.size()) * 3;
    nlohmann::json result = {{"name", name},
                             {"lossless", m.squared_error == 0},
                             {"psnr_db", nullptr},
                             {"bytes_first", m.bytes[0]},
                             {"bytes_mean", mean},
                             {"ratio", double(frames[0].pixels.size() * 3) / mean},
                             {"encode_ms", median(rest(m.encode_ms))},
                             {"decode_ms", median(rest(m.decode_ms))}};
    if (m.squared_error > 0) {
        result["psnr_db"] = 10 * std::log10(255.0 * 255.0 * values / m.squared_error);
        result["ssim"] = m.ssim;
    }
    return result;
}

struct Coder {
    std::string name;
    std::function<std::unique_ptr<video::ColorEncoder>()> make_encoder;
    std::function<std::unique_ptr<video::ColorDecoder>()> make_decoder;
};

// The pictures as a camera delivers them: without noise as pixels, with noise as JPEG.
std::vector<ColorData> camera_pictures(const std::vector<ColorImage>& frames, double noise) {
    const auto jpeg =
        video::make_color_encoder(video::parse_color_setting("jpeg:quality=90").setting);
    std::vector<ColorData> pictures;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        ColorData color;
        color.size = frames[i].size;
        color.pixels = frames[i];
        if (noise > 0) {
            const synthetic::ColorSensorParams sensor{
                .exposure_stops = 0, .white_balance = 0, .noise = float(noise)};
            synthetic::apply_color_sensor(sensor, 1, std::uint32_t(i), frames[i].view(),
                                          color.pixels.view());
            const ByteView bytes = jpeg->encode(color, true)->bytes;
            color.jpeg.assign(bytes.begin(), bytes.end());
            color.pixels = {};
        }
        pictures.push_back(std::move(color));
    }
    return pictures;
}

Measured measure(const Coder& coder, const std::vector<ColorImage>& frames,
                 const std::vector<ColorData>& pictures) {
    Measured m;
    m.bytes.resize(frames.size());
    m.encode_ms.assign(frames.size(), 1e9);
    m.decode_ms.assign(frames.size(), 1e9);
    for (int pass = 0; pass < passes; ++pass) {
        const auto encoder = coder.make_encoder();
        const auto decoder = coder.make_decoder();
        m.squared_error = m.ssim = 0;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const ColorData& color = pictures[i];
            Result<video::EncodedColor> result = Status::truncated;
            const double encode_ms = timed_ms([&] { result = encoder->encode(color, i == 0); });
            if (!result)
                throw Error("Frame " + std::to_string(i) + " is " +
                            std::string(to_text(result.error())) + " for " + coder.name + ".");
            const ByteView encoded = result->bytes;
            std::optional<video::ColorDecoder::Decoded> decoded;
            const double decode_ms = timed_ms([&] {
                if (decoder->submit(encoded, FrameNumber(i)) == Status::ok)
                    decoded = decoder->poll();
            });
            if (!decoded || decoded->image.size != frames[i].size)
                throw Error("Frame " + std::to_string(i) + " did not come back from " + coder.name +
                            ".");
            m.bytes[i] = double(encoded.size());
            m.encode_ms[i] = std::min(m.encode_ms[i], encode_ms);
            m.decode_ms[i] = std::min(m.decode_ms[i], decode_ms);
            m.squared_error += squared_error(frames[i].view(), decoded->image.view());
            if (pass + 1 == passes)
                m.ssim += ssim(frames[i].view(), decoded->image.view()) / double(frames.size());
            decoder->recycle(std::move(decoded->image));
        }
    }
    return m;
}

Measured measure_zstd(const std::vector<ColorImage>& frames) {
    Measured m;
    for (const ColorImage& frame : frames) {
        const std::size_t size = frame.pixels.size() * sizeof(Rgb);
        std::vector<char> packed(ZSTD_compressBound(size)), back(size);
        std::size_t n = 0;
        double encode_ms = 1e9, decode_ms = 1e9;
        for (int pass = 0; pass < passes; ++pass) {
            encode_ms = std::min(encode_ms, timed_ms([&] {
                                     n = ZSTD_compress(packed.data(), packed.size(),
                                                       frame.pixels.data(), size, 1);
                                 }));
            decode_ms = std::min(decode_ms, timed_ms([&] {
                                     ZSTD_decompress(back.data(), back.size(), packed.data(), n);
                                 }));
        }
        m.bytes.push_back(double(n));
        m.encode_ms.push_back(encode_ms);
        m.decode_ms.push_back(decode_ms);
    }
    return m;
}

}  // namespace

nlohmann::json bench_color_sequence(const std::string& sequence_name,
                                    const std::vector<ColorImage>& frames,
                                    const std::vector<std::string>& codecs, double camera_noise) {
    if (frames.empty())
        throw Error("The sequence " + sequence_name + " has no colour pictures.");
    for (const ColorImage& frame : frames)
        if (frame.size != frames[0].size)
            throw Error("The colour pictures of " + sequence_name + " are not all of one size.");
    const std::vector<ColorData> pictures = camera_pictures(frames, camera_noise);
    nlohmann::json rows = nlohmann::json::array();
    const auto add = [&](const Coder& coder) {
        rows.push_back(row(coder.name, measure(coder, frames, pictures), frames));
    };
    if (camera_noise > 0)
        add({"camera_jpeg", [] { return video::make_color_encoder({}); },
             [] { return video::make_color_decoder(video::ColorCodecId::jpeg); }});
    for (const std::string& codec : codecs) {
        if (is_video_yardstick(codec)) {
            add({codec, [&] { return make_video_encoder(codec); },
                 [&] { return make_video_decoder(codec); }});
            continue;
        }
        const auto parsed = video::parse_color_setting(codec);
        if (!parsed.problem.empty())
            throw Error(parsed.problem);
        const video::ColorSetting setting = parsed.setting;
        add({codec, [&] { return video::make_color_encoder(setting); },
             [&] { return video::make_color_decoder(setting.id); }});
        if (has_libjpeg_yardstick(setting) && camera_noise == 0)
            add({libjpeg_name(codec), [&] { return make_libjpeg_encoder(setting); },
                 make_libjpeg_decoder});
    }
    rows.push_back(row("zstd1_raw", measure_zstd(frames), frames));
    return {{"sequence", sequence_name},
            {"width", frames[0].size.width},
            {"height", frames[0].size.height},
            {"frames", frames.size()},
            {"codecs", rows}};
}

}  // namespace theatron::bench
