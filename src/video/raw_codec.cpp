// SPDX-License-Identifier: Apache-2.0
#include "video/raw_codec.h"

#include "video/color_raw.h"

namespace theatron::video {
namespace {

class RawDecoder final : public ColorDecoder {
public:
    Status submit(ByteView encoded, FrameNumber frame) override {
        const Result<Size> size = color_raw::read_size(encoded);
        if (!size)
            return size.error();
        ColorImage image = queue_.take_blank();
        image.resize(*size);
        const Status status = color_raw::decode(encoded, image.view());
        if (status == Status::ok)
            queue_.put(frame, std::move(image));
        else
            queue_.recycle(std::move(image));
        return status;
    }
    std::optional<Decoded> poll() override { return queue_.poll(); }
    void recycle(ColorImage image) override { queue_.recycle(std::move(image)); }

private:
    DecodedQueue queue_;
};

}  // namespace

ColorImage DecodedQueue::take_blank() {
    if (blank_.empty())
        return {};
    ColorImage image = std::move(blank_.back());
    blank_.pop_back();
    return image;
}

void DecodedQueue::put(FrameNumber frame, ColorImage image) {
    if (ready_.size() == max_kept) {
        recycle(std::move(ready_.front().image));
        ready_.erase(ready_.begin());
    }
    ready_.push_back({frame, std::move(image)});
}

std::optional<ColorDecoder::Decoded> DecodedQueue::poll() {
    if (ready_.empty())
        return std::nullopt;
    ColorDecoder::Decoded first = std::move(ready_.front());
    ready_.erase(ready_.begin());
    return first;
}

void DecodedQueue::recycle(ColorImage image) {
    if (blank_.size() < max_kept)
        blank_.push_back(std::move(image));
}

std::unique_ptr<ColorDecoder> make_raw_decoder() {
    return std::make_unique<RawDecoder>();
}

}  // namespace theatron::video
