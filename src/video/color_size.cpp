// SPDX-License-Identifier: Apache-2.0
#include "video/color_codec.h"
#include "video/color_raw.h"
#include "video/h264_header.h"
#include "video/jpeg_header.h"

namespace theatron::video {

Result<Size> read_color_size(ColorCodecId id, ByteView encoded) {
    switch (id) {
        case ColorCodecId::raw:
            return color_raw::read_size(encoded);
        case ColorCodecId::jpeg:
            return read_jpeg_size(encoded);
        case ColorCodecId::h264: {
            const auto picture = read_h264_picture(encoded);
            return picture ? Result<Size>(picture->size) : Result<Size>(picture.error());
        }
    }
    return Status::unsupported;
}

}  // namespace theatron::video
