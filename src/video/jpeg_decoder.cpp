// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_decoder.h"

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

#include "video/jpeg_baseline.h"
#include "video/jpeg_lookup.h"
#include "video/jpeg_pixels.h"
#include "video/jpeg_scan.h"

namespace theatron::video {
namespace {

using namespace jpeg_scan;

// Aligned memory of zeros that grows, and loses its content then.
template <class T>
class Memory {
public:
    T* of_size(std::size_t count) {
        if (count > size_) {
            size_ = 0;
            values_.reset(static_cast<T*>(::operator new(count * sizeof(T), boundary)));
            std::fill_n(values_.get(), count, T{});
            size_ = count;
        }
        return values_.get();
    }

private:
    static constexpr std::align_val_t boundary{128};  // of every processor's vectors
    struct Free {
        void operator()(T* values) const { ::operator delete(values, boundary); }
    };
    std::unique_ptr<T, Free> values_;
    std::size_t size_ = 0;
};

int rounded_up(int value, int step) {
    return (value + step - 1) / step * step;
}

}  // namespace

struct BaselineJpegDecoder::State {
    JpegLookup lookup;
    Memory<std::uint8_t> bits;
    std::array<Memory<std::uint8_t>, 3> samples;
    std::array<Memory<std::int16_t>, 2> sums;
    Memory<std::int16_t> coefficients;

    // Both chroma components have the same codes nearly always: one table stays in
    // the cache where two do not.
    std::size_t lookup_of(std::size_t component, const BaselineJpeg& jpeg) {
        const auto code = [&](std::size_t i) {
            return std::pair(jpeg.components[i].dc.counts.data(),
                             jpeg.components[i].ac.counts.data());
        };
        if (component == 2 && code(1) == code(2))
            return 1;
        lookup.set(component, jpeg.components[component].dc, jpeg.components[component].ac);
        return component;
    }
};

BaselineJpegDecoder::BaselineJpegDecoder() : state_(std::make_unique<State>()) {}

BaselineJpegDecoder::~BaselineJpegDecoder() = default;

Status BaselineJpegDecoder::decode(ByteView bytes, ColorImage& out) {
    const Result<BaselineJpeg> jpeg = read_baseline_jpeg(bytes);
    if (!jpeg)
        return jpeg.error();
    out.resize(jpeg->size);

    Scan scan;
    scan.jpeg = &*jpeg;
    scan.lookup = &state_->lookup;
    scan.out = out.view();
    scan.bits = state_->bits.of_size(jpeg->coded.size() + slack + alignment);
    scan.coefficients = state_->coefficients.of_size(max_group_quads * quad_values);
    const int groups = (jpeg->units().width + group_units - 1) / group_units;
    for (std::size_t i = 0; i < 3; ++i) {
        const JpegComponent& from = jpeg->components[i];
        Component& to = scan.components[i];
        to.codes = &from;
        to.lookup = state_->lookup_of(i, *jpeg);
        to.dc_step = from.steps[0];
        for (std::size_t k = 0; k < 64; ++k) {
            const auto step =
                k == 0 ? jpeg_pixels::dc_step : jpeg_pixels::scaled_step(from.steps[k], k);
            to.powers[place(k, 8)] = step.power;
            to.rests[place(k, 8)] = step.rest;
        }

        const int width = i == 0 ? 8 << jpeg->chroma_shift_x : 8;
        const int height = i == 0 ? 8 << jpeg->chroma_shift_y : 8;
        const int stride = rounded_up(groups * group_units * width, alignment) + 2 * margin;
        std::uint8_t* samples =
            state_->samples[i].of_size(std::size_t(stride) * std::size_t(height + 1));
        to.strip = {samples + stride + margin, stride};
        if (i > 0)
            scan.sums[i - 1] = state_->sums[i - 1].of_size(std::size_t(stride)) + margin;
    }
    return jpeg_scan::decode(scan);
}

}  // namespace theatron::video
