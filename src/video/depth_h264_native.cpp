// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>

#include "codec/payload_header.h"
#include "video/avc_native.h"
#include "video/depth_h264.h"
#include "video/depth_mask.h"
#include "video/h264_header.h"

namespace theatron::video {
namespace {

using codec::Reference;

constexpr int levels = 1024;
constexpr std::size_t header_size = codec::payload_header_size + 2 + 2 + 4;

// The values of the levels: equal steps of the logarithm, since the noise of
// depth cameras and the visible error grow with distance.
class Scale {
public:
    // Does nothing if it is so already.
    void set(std::uint16_t near_value, std::uint16_t far_value) {
        if (near_value == near_ && far_value == far_)
            return;
        near_ = near_value;
        far_ = far_value;
        const double ratio = std::log(double(far_) / near_);
        for (int i = 0; i < levels; ++i)
            value_[std::size_t(i)] =
                std::uint16_t(std::lround(near_ * std::exp(ratio * i / (levels - 1))));
    }
    std::uint16_t value(unsigned level) const { return value_[level]; }

    // The nearest level of each of 65536 values.
    std::vector<std::uint16_t> level_of_values() const {
        std::vector<std::uint16_t> result(65536);
        std::size_t level = 0;
        for (int v = 0; v < 65536; ++v) {
            while (level + 1 < levels &&
                   std::abs(v - value_[level + 1]) <= std::abs(v - value_[level]))
                ++level;
            result[std::size_t(v)] = std::uint16_t(level);
        }
        return result;
    }

private:
    std::uint16_t near_ = 0, far_ = 0;
    std::array<std::uint16_t, levels> value_{};
};

std::uint16_t* samples(const AvcPlanes& planes, int y) {
    return reinterpret_cast<std::uint16_t*>(planes[0].pixels + y * planes[0].stride);
}

struct Header {
    bool delta = false;
    Size size;
    std::uint16_t near_value = 0, far_value = 0;
    ByteView mask, access_unit;
};

Result<Header> read(ByteView encoded) {
    const auto common = codec::read_header(encoded, codec::DepthCodecId::h264, true);
    if (!common)
        return common.error();
    ByteReader in(encoded.subspan(codec::payload_header_size));
    Header header{common->delta,           common->size, in.get<std::uint16_t>(),
                  in.get<std::uint16_t>(), {},           {}};
    header.mask = in.get_bytes(in.get<std::uint32_t>());
    header.access_unit = in.rest();
    if (!in.ok() || header.access_unit.empty())
        return Status::truncated;
    if (header.near_value == 0 || header.near_value >= header.far_value)
        return Status::malformed;
    if (coded_size(header.size).area() > avc::max_area)
        return Status::too_large;
    return header;
}

class DepthH264 final : public codec::DepthCodec {
public:
    explicit DepthH264(const DepthH264Params& params) : params_(params) {}

    bool lossless() const override { return false; }
    bool temporal() const override { return true; }

    std::size_t max_encoded_size(Size size) const override {
        // Ten-bit samples as they are take two bytes; headers of blocks and escapes little more.
        return header_size + depth_mask::max_encoded_size(size) + 4 * coded_size(size).area() +
               65536;
    }

    std::size_t encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                       Reference* next) override {
        assert(is_valid(depth.size) && out.size() >= max_encoded_size(depth.size));
        const bool delta = follows(reference) && depth.size == mask_.size();
        last_ = 0;
        if (!encoder_) {
            if (!AvcEncoder::problem(x264_name).empty())
                return 0;
            AvcParams avc = params_.avc;
            avc.encoder = x264_name;  // grey of ten bits is nothing for the other
            encoder_.emplace(avc);
            scale_.set(params_.near_value, params_.far_value);
            level_of_value_ = scale_.level_of_values();
        }
        const Size coded = coded_size(depth.size);
        if (encoder_->size() != coded && encoder_->open(coded, AvcLayout::grey10) != Status::ok)
            return 0;
        set_mask_before(delta, depth.size);
        mask_.set_from(depth);
        put_levels(depth, delta);
        const auto encoded = encoder_->encode(!delta);
        if (!encoded)
            return 0;

        codec::put_header({.codec = codec::DepthCodecId::h264, .delta = delta, .size = depth.size},
                          out.data());
        std::byte* p = out.data() + codec::payload_header_size;
        store_le(p, params_.near_value);
        store_le(p + 2, params_.far_value);
        const std::size_t mask_bytes = depth_mask::encode(mask_, before_, out.subspan(header_size));
        store_le(p + 4, std::uint32_t(mask_bytes));
        const std::size_t used = header_size + mask_bytes + encoded->bytes.size();
        if (used > out.size())
            return 0;
        std::memcpy(out.data() + header_size + mask_bytes, encoded->bytes.data(),
                    encoded->bytes.size());
        note(next);
        return used;
    }

    Result<Size> read_size(ByteView encoded) const override {
        const auto header = read(encoded);
        if (!header)
            return header.error();
        return header->size;
    }

    Status decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                  Reference* next) override {
        const auto header = read(encoded);
        if (!header)
            return header.error();
        if (header->size != out.size)
            return Status::size_mismatch;
        const bool fits = follows(reference) && mask_.size() == out.size;
        if (header->delta && !fits)
            return Status::missing_reference;
        last_ = 0;
        if (!decoder_) {
            if (!AvcDecoder::problem().empty())
                return Status::unsupported;
            decoder_.emplace();
        }
        set_mask_before(header->delta, out.size);
        if (mask_.size() != out.size)
            mask_.resize(out.size);
        if (const Status s = depth_mask::decode(header->mask, before_, mask_); s != Status::ok)
            return s;
        if (const Status s =
                decoder_->decode(header->access_unit, coded_size(out.size), AvcLayout::grey10);
            s != Status::ok)
            return s;
        scale_.set(header->near_value, header->far_value);
        const AvcPlanes planes = decoder_->planes();
        for (int y = 0; y < out.size.height; ++y) {
            const std::uint16_t* from = samples(planes, y);
            const std::uint8_t* valid = mask_.row(y);
            std::uint16_t* to = out.row(y);
            for (int x = 0; x < out.size.width; ++x)
                to[x] = valid[x] ? scale_.value(from[x] & (levels - 1)) : std::uint16_t(0);
        }
        note(next);
        return Status::ok;
    }

private:
    // True if `reference` is the frame that this object coded last.
    bool follows(const Reference* reference) const {
        return reference && last_ != 0 && reference->memory.size() == sizeof(last_) &&
               load_le<std::uint32_t>(reference->memory.data()) == last_;
    }
    void note(Reference* next) {
        last_ = ++count_ == 0 ? ++count_ : count_;
        if (!next)
            return;
        next->depth.pixels.clear();
        next->memory.resize(sizeof(last_));
        store_le(next->memory.data(), last_);
    }
    void set_mask_before(bool delta, Size size) {
        std::swap(before_, mask_);
        if (!delta || before_.size() != size)
            before_.resize(size);
    }

    // Pixels without measurement keep their last level, which costs no bits, or in a
    // key frame get the level of a neighbour.
    void put_levels(DepthView depth, bool delta) {
        const Size coded = encoder_->size();
        if (!delta)
            filled_.assign(coded.area(), 0);
        const AvcPlanes planes = encoder_->planes();
        for (int y = 0; y < coded.height; ++y) {
            const std::uint16_t* from = depth.row(std::min(y, depth.size.height - 1));
            std::uint16_t* kept = &filled_[std::size_t(y) * std::size_t(coded.width)];
            std::uint16_t last = y > 0 ? kept[-coded.width] : std::uint16_t(0);
            for (int x = 0; x < coded.width; ++x) {
                const std::uint16_t value = from[std::min(x, depth.size.width - 1)];
                if (value != 0)
                    kept[x] = level_of_value_[value];
                else if (!delta)
                    kept[x] = last;
                last = kept[x];
            }
            std::memcpy(samples(planes, y), kept, 2 * std::size_t(coded.width));
        }
    }

    DepthH264Params params_;
    std::optional<AvcEncoder> encoder_;
    std::optional<AvcDecoder> decoder_;
    Scale scale_;
    std::vector<std::uint16_t> level_of_value_, filled_;
    depth_mask::Mask mask_, before_;
    std::uint32_t last_ = 0, count_ = 0;
};

}  // namespace

bool has_depth_h264() {
    return true;
}

std::string missing_depth_h264_encoder() {
    return AvcEncoder::problem(x264_name);
}

std::string missing_depth_h264_decoder() {
    return AvcDecoder::problem();
}

std::unique_ptr<codec::DepthCodec> make_depth_h264(const DepthH264Params& params) {
    return std::make_unique<DepthH264>(params);
}

}  // namespace theatron::video
