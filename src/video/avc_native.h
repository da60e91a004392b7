// SPDX-License-Identifier: Apache-2.0
// H.264: planes of samples to access units and back. Native builds only. The decoder is
// libavcodec's, the encoder OpenH264 or x264, whichever this machine has; see
// docs/decisions/optional-h264.md.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "base/bytes.h"
#include "base/status.h"
#include "video/avc_setting.h"
#include "video/avc_stream.h"

namespace theatron::video {

enum class AvcLayout : std::uint8_t { yuv420, grey8, grey10 };

// Samples of one or, in 10 bits, two bytes. `stride`: bytes from row to row.
struct AvcPlane {
    std::uint8_t* pixels = nullptr;
    std::ptrdiff_t stride = 0;
};
using AvcPlanes = std::array<AvcPlane, 3>;  // grey uses the first

class AvcEngine;

// Encodes pictures one after the other, each as soon as it is given. Not thread safe.
class AvcEncoder {
public:
    // Throws Error where problem() has a sentence for params.encoder.
    explicit AvcEncoder(const AvcParams& params);
    ~AvcEncoder();

    // The library that encodes unless a setting names one; empty if there is none.
    static std::string best_encoder();
    // One sentence if this machine has no such encoder (empty: none at all), otherwise empty.
    static std::string problem(const std::string& encoder = "");

    // Begins a new stream. Sides of 4:2:0 pictures are even.
    Status open(Size size, AvcLayout layout);
    Size size() const;

    // Where the next picture is to be put; again for each picture.
    AvcPlanes planes();

    // Encodes the picture that was put there. The bytes are an access unit as
    // read_access_unit takes it, valid until the next call. The first one of a
    // stream is a key frame in any case.
    struct Encoded {
        ByteView bytes;
        bool key = false;
    };
    Result<Encoded> encode(bool key);

private:
    AvcParams params_;
    std::unique_ptr<AvcEngine> engine_;
};

// Decodes access units one after the other. Not thread safe. Prints nothing.
class AvcDecoder {
public:
    AvcDecoder();
    ~AvcDecoder();

    static std::string problem();

    // Decodes a picture of which size and layout are known. Safe for untrusted
    // input as far as libavcodec is; see read_access_unit for what reaches it.
    // After a failure nothing but a key frame decodes: missing_reference.
    Status decode(ByteView access_unit, Size size, AvcLayout layout);

    // The picture, valid until the next call.
    AvcPlanes planes() const;

private:
    struct Library;
    std::unique_ptr<Library> library_;
};

}  // namespace theatron::video
