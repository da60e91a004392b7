// SPDX-License-Identifier: Apache-2.0
#include <emscripten/emscripten.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "video/browser_decoders_web.h"
#include "video/h264_header.h"
#include "video/plane_pixels.h"
#include "video/raw_codec.h"

// `h264` is set by page/video_decoder.js.
EM_JS(int, theatron_open_h264, (), { return Module.h264.open(); });
EM_JS(void, theatron_decode_h264,
      (int decoder, const char* codec, int key, unsigned number, const void* data, unsigned size), {
          Module.h264.decode(decoder, UTF8ToString(codec), !!key, number,
                             HEAPU8.slice(data, data + size));
      });
EM_JS(void, theatron_close_h264, (int decoder), { Module.h264.close(decoder); });

namespace theatron::video {
namespace {

// A decoder that is so far behind is given up: the host sends on only what was taken.
constexpr std::size_t most_pending = 8;
// Bytes of a picture that a browser may hand over: four for each pixel, and some for its rows.
constexpr std::size_t most_memory = 5 * avc::max_area;

// As WebCodecs names a stream, by the first bytes of its sequence header.
std::string codec_string(ByteView sequence) {
    char text[sizeof "avc1.000000"];
    std::snprintf(text, sizeof text, "avc1.%02x%02x%02x", std::to_integer<unsigned>(sequence[1]),
                  std::to_integer<unsigned>(sequence[2]), std::to_integer<unsigned>(sequence[3]));
    return text;
}

class H264Decoder;
// By the numbers that the page's script gave them.
std::map<int, H264Decoder*>& open_decoders() {
    static std::map<int, H264Decoder*> all;
    return all;
}

class H264Decoder final : public ColorDecoder {
public:
    H264Decoder() { open_decoders()[id_] = this; }
    ~H264Decoder() override {
        open_decoders().erase(id_);
        theatron_close_h264(id_);
    }
    H264Decoder(const H264Decoder&) = delete;
    H264Decoder& operator=(const H264Decoder&) = delete;

    Status submit(ByteView encoded, FrameNumber frame) override {
        const auto picture = read_h264_picture(encoded);
        if (!picture)
            return picture.error();
        // Checked here: what reaches the browser's decoder has the form of our encoders' pictures.
        const auto unit = avc::read_access_unit(picture->access_unit);
        if (!unit)
            return unit.error();
        if (unit->key) {
            if (unit->sequence != avc::Sequence{coded_size(picture->size), 8, false})
                return Status::size_mismatch;
            ByteView rest = picture->access_unit;
            codec_ = codec_string(avc::take_unit(rest)->content);
        } else if (needs_key_ || picture->size != size_) {
            return Status::missing_reference;
        }
        if (waiting_.size() >= most_pending) {
            fail();
            return Status::missing_reference;
        }
        needs_key_ = false;
        size_ = picture->size;
        waiting_.push_back({++newest_, frame, size_});
        theatron_decode_h264(id_, codec_.c_str(), unit->key, newest_, picture->access_unit.data(),
                             unsigned(picture->access_unit.size()));
        return Status::ok;
    }
    std::optional<Decoded> poll() override { return queue_.poll(); }
    void recycle(ColorImage image) override { queue_.recycle(std::move(image)); }
    std::size_t pending() const override { return waiting_.size(); }
    std::size_t take_failures() override { return std::exchange(failures_, 0); }

    Bytes& memory() { return memory_; }

    // The browser's picture of this number lies in memory(); `put` writes it into an image.
    template <class Put>
    void finish(unsigned number, Size shown, Put put) {
        // Those before it were left out, as no browser does.
        while (!waiting_.empty() && waiting_.front().number != number) {
            waiting_.pop_front();
            ++failures_;
        }
        if (waiting_.empty())
            return;
        const Waiting finished = waiting_.front();
        waiting_.pop_front();
        // Surplus columns and rows of the coded picture may be there.
        if (shown.width < finished.size.width || shown.height < finished.size.height)
            return fail();
        ColorImage image = queue_.take_blank();
        image.resize(finished.size);
        if (put(image.view()) != Status::ok)
            return fail();
        queue_.put(finished.frame, std::move(image));
    }
    void fail() {
        failures_ += std::max<std::size_t>(waiting_.size(), 1);
        waiting_.clear();
        needs_key_ = true;
    }

private:
    struct Waiting {
        unsigned number = 0;
        FrameNumber frame = 0;
        Size size;
    };

    const int id_ = theatron_open_h264();
    bool needs_key_ = true;
    unsigned newest_ = 0;
    Size size_;
    std::string codec_;
    std::deque<Waiting> waiting_;
    std::size_t failures_ = 0;
    Bytes memory_;
    DecodedQueue queue_;
};

H264Decoder* find_decoder(int id) {
    const auto found = open_decoders().find(id);
    return found == open_decoders().end() ? nullptr : found->second;
}

template <class Work>
void tell(int id, Work work) {
    H264Decoder* const decoder = find_decoder(id);
    if (!decoder)
        return;
    work(*decoder);
    if (browser_decoders().on_news)
        browser_decoders().on_news();
}

}  // namespace

BrowserDecoders& browser_decoders() {
    static BrowserDecoders only;
    return only;
}

std::unique_ptr<ColorDecoder> make_browser_h264_decoder() {
    return std::make_unique<H264Decoder>();
}

}  // namespace theatron::video

using namespace theatron;

// The functions that page/video_decoder.js calls.
extern "C" {

EMSCRIPTEN_KEEPALIVE void theatron_use_h264(int has_h264) {
    video::browser_decoders().has_h264 = has_h264 != 0;
}

// For the samples of a picture; null: there is no such decoder, or they are too many.
EMSCRIPTEN_KEEPALIVE void* theatron_h264_memory(int id, unsigned size) {
    video::H264Decoder* const decoder = video::find_decoder(id);
    if (!decoder || size > video::most_memory)
        return nullptr;
    decoder->memory().resize(size);
    return decoder->memory().data();
}

// Its planes are there, with these first bytes, strides and distance of samples of colour.
EMSCRIPTEN_KEEPALIVE void theatron_h264_planes(int id, unsigned number, int width, int height,
                                               unsigned y, unsigned y_stride, unsigned u,
                                               unsigned v, unsigned chroma_stride,
                                               unsigned chroma_step) {
    video::tell(id, [&](video::H264Decoder& decoder) {
        decoder.finish(number, {width, height}, [&](MutableColorView image) {
            return video::pixels_of_planes(decoder.memory(),
                                           {y, u, v, y_stride, chroma_stride, chroma_step}, image);
        });
    });
}

// Its pixels are there, 4 bytes for each: red, green, blue and another.
EMSCRIPTEN_KEEPALIVE void theatron_h264_pixels(int id, unsigned number, int width, int height,
                                               unsigned first, unsigned stride) {
    video::tell(id, [&](video::H264Decoder& decoder) {
        decoder.finish(number, {width, height}, [&](MutableColorView image) {
            return video::pixels_of_quads(decoder.memory(), first, stride, image);
        });
    });
}

// All pictures of the decoder that it has not finished are lost.
EMSCRIPTEN_KEEPALIVE void theatron_h264_failed(int id) {
    video::tell(id, [](video::H264Decoder& decoder) { decoder.fail(); });
}

}  // extern "C"
