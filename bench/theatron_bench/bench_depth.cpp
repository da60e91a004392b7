// SPDX-License-Identifier: Apache-2.0
#include "bench_depth.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"
#include "bench_coder.h"
#include "codec/depth_stream.h"
#include "video/depth_codecs.h"

namespace theatron {
namespace {

// Measures one of our own codecs as a stream.
class StreamCoder final : public BenchCoder {
public:
    explicit StreamCoder(const codec::DepthSetting& setting)
        : setting_(setting),
          lossless_(video::make_depth_codec(setting)->lossless()),
          encoder_(video::make_depth_encoder(setting)),
          decoder_(video::make_depth_decoder(setting)) {}

    std::string name() const override { return setting_.text; }
    bool lossless() const override { return lossless_; }
    void restart() override {
        links_.clear();
        first_ = true;
    }
    ByteView encode(const DepthImage& depth, Bytes& out) override {
        out.resize(encoder_.max_encoded_size(depth.size));
        const codec::EncodedDepth encoded =
            encoder_.encode(depth.view(), FrameNumber(links_.size()), first_, out);
        first_ = false;
        links_.push_back(encoded);
        return ByteView(out).first(encoded.bytes);
    }
    bool decode(std::size_t frame, ByteView encoded, DepthImage& out) override {
        return decoder_.decode(links_[frame], encoded, out.view()) == Status::ok;
    }

private:
    codec::DepthSetting setting_;
    bool lossless_;
    codec::DepthStreamEncoder encoder_;
    codec::DepthStreamDecoder decoder_;
    std::vector<codec::FrameLink> links_;
    bool first_ = true;
};

double elapsed_ms(std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since)
        .count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

// The largest change of any pixel. A pixel that gained or lost its measurement counts with its
// whole depth.
int max_error(const DepthImage& original, const DepthImage& decoded) {
    int worst = 0;
    for (std::size_t i = 0; i < original.pixels.size(); ++i)
        worst = std::max(worst, std::abs(original.pixels[i] - decoded.pixels[i]));
    return worst;
}

// Squared changes of pixels that have a measurement before and after.
struct SquaredError {
    double sum = 0;
    std::size_t pixels = 0;

    void add(const DepthImage& original, const DepthImage& decoded) {
        for (std::size_t i = 0; i < original.pixels.size(); ++i) {
            if (original.pixels[i] == 0 || decoded.pixels[i] == 0)
                continue;
            const double change = original.pixels[i] - decoded.pixels[i];
            sum += change * change;
            ++pixels;
        }
    }
    double root_of_mean() const { return pixels == 0 ? 0 : std::sqrt(sum / double(pixels)); }
};

struct Pass {
    std::vector<double> encode_ms, decode_ms;
};

// The results of one coder for all frames.
class Measurement {
public:
    Measurement(BenchCoder& coder, const std::vector<DepthImage>& frames)
        : coder_(coder),
          frames_(frames),
          encoded_(frames.size()),
          decoded_(frames.front().size),
          best_{std::vector<double>(frames.size(), std::numeric_limits<double>::max()),
                std::vector<double>(frames.size(), std::numeric_limits<double>::max())} {}

    nlohmann::json run() {
        check();
        // Short sequences get more passes, for stable results.
        const std::size_t passes = std::max<std::size_t>(3, 30 / frames_.size());
        for (std::size_t pass = 0; pass < passes; ++pass)
            time_one_pass();

        const std::size_t first = frames_.size() > 1 ? 1 : 0;
        double bytes = 0;
        for (std::size_t i = first; i < frames_.size(); ++i)
            bytes += double(encoded_[i].size());
        const double mean = bytes / double(frames_.size() - first);
        const auto since = [&](const std::vector<double>& values) {
            return median({values.begin() + std::ptrdiff_t(first), values.end()});
        };
        return {{"name", coder_.name()},
                {"lossless", coder_.lossless()},
                {"max_error_mm", max_error_},
                {"rmse_mm", squared_error_.root_of_mean()},
                {"bytes_first", encoded_.front().size()},
                {"bytes_mean", mean},
                {"ratio", 2 * double(decoded_.size.area()) / mean},
                {"encode_ms", since(best_.encode_ms)},
                {"decode_ms", since(best_.decode_ms)}};
    }

private:
    void check() {
        encode_all([](std::size_t, double) {});
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            std::fill(decoded_.pixels.begin(), decoded_.pixels.end(), std::uint16_t(0xabcd));
            if (!coder_.decode(i, encoded_[i], decoded_))
                throw Error(coder_.name() + " does not decode its own frame " + std::to_string(i) +
                            ".");
            const int error = max_error(frames_[i], decoded_);
            if (error > 0 && coder_.lossless())
                throw Error(coder_.name() + " calls itself lossless and changed frame " +
                            std::to_string(i) + " by " + std::to_string(error) + ".");
            max_error_ = std::max(max_error_, error);
            squared_error_.add(frames_[i], decoded_);
        }
    }

    void time_one_pass() {
        encode_all([&](std::size_t i, double ms) {
            best_.encode_ms[i] = std::min(best_.encode_ms[i], ms);
        });
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            if (!coder_.decode(i, encoded_[i], decoded_))
                throw Error(coder_.name() + " does not decode its own frame a second time.");
            best_.decode_ms[i] = std::min(best_.decode_ms[i], elapsed_ms(start));
        }
    }

    template <class Note>
    void encode_all(Note note) {
        coder_.restart();
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            const ByteView bytes = coder_.encode(frames_[i], out_);
            const double ms = elapsed_ms(start);
            encoded_[i].assign(bytes.begin(), bytes.end());
            note(i, ms);
        }
    }

    BenchCoder& coder_;
    const std::vector<DepthImage>& frames_;
    std::vector<Bytes> encoded_;
    DepthImage decoded_;
    Bytes out_;
    Pass best_;
    int max_error_ = 0;
    SquaredError squared_error_;
};

}  // namespace

nlohmann::json bench_depth_sequence(const std::string& sequence_name,
                                    const std::vector<DepthImage>& frames,
                                    const std::vector<std::string>& codecs,
                                    DepthYardsticks yardsticks) {
    if (frames.empty())
        throw Error("The sequence '" + sequence_name + "' has no depth images.");
    const Size size = frames.front().size;
    for (const DepthImage& frame : frames) {
        if (frame.size != size || !is_valid(size))
            throw Error("The depth images of '" + sequence_name + "' are not all of one size.");
    }

    std::vector<std::unique_ptr<BenchCoder>> coders;
    for (const std::string& text : codecs) {
        const auto parsed = video::parse_depth_setting(text);
        if (!parsed.problem.empty())
            throw Error(parsed.problem);
        if (const std::string missing = video::missing_depth_encoder(parsed.setting);
            !missing.empty())
            throw Error(missing);
        coders.push_back(std::make_unique<StreamCoder>(parsed.setting));
    }
    if (yardsticks == DepthYardsticks::zstd)
        coders.push_back(zstd_yardstick());
    else
        for (auto& yardstick : depth_yardsticks())
            coders.push_back(std::move(yardstick));

    nlohmann::json rows = nlohmann::json::array();
    for (const auto& coder : coders)
        rows.push_back(Measurement(*coder, frames).run());
    return {{"sequence", sequence_name},
            {"width", size.width},
            {"height", size.height},
            {"frames", frames.size()},
            {"codecs", std::move(rows)}};
}

}  // namespace theatron
