// SPDX-License-Identifier: Apache-2.0
// One library that encodes H.264, behind AvcEncoder. Native builds only.
#pragma once

#include <memory>

#include "video/avc_native.h"

namespace theatron::video {

// As AvcEncoder, whose contracts hold. Not thread safe.
class AvcEngine {
public:
    virtual ~AvcEngine() = default;
    virtual Status open(Size size, AvcLayout layout) = 0;
    virtual Size size() const = 0;
    virtual AvcPlanes planes() = 0;
    virtual Result<AvcEncoder::Encoded> encode(bool key) = 0;
};

// x264 (GPL) where libavcodec has it: every layout.
bool has_x264();
std::unique_ptr<AvcEngine> make_x264(const AvcParams& params);

// OpenH264 (BSD) where this build has it: 4:2:0 only.
bool has_openh264();
std::unique_ptr<AvcEngine> make_openh264(const AvcParams& params);

// Copies the NAL units of the picture and its headers into `out`, without the encoder's
// description of itself (x264: some 700 bytes).
void keep_picture_units(ByteView stream, Bytes& out);

}  // namespace theatron::video
