// SPDX-License-Identifier: Apache-2.0
// Colour codecs: encode at the sender, submit and poll at the receiver.
//
// Decoding is asynchronous in shape because the browser's decoders are; the
// native ones answer at the next poll().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/status.h"
#include "image/frame.h"

namespace theatron::video {

// Numbers of the codecs in the media header, other ones than those of depth codecs. A number is
// never used again.
enum class ColorCodecId : std::uint8_t {
    raw = 65,
    jpeg = 66,
    h264 = 67,
};

// A receiver that requests this leaves the choice to the host: JPEG or H.264, which may change from
// picture to picture; the media header names the codec. It is no codec of this module.
inline constexpr std::string_view auto_color = "auto";

// A codec as a receiver requests it, checked and in canonical spelling.
struct ColorSetting {
    ColorCodecId id = ColorCodecId::jpeg;
    std::string text = "jpeg:quality=85";
    bool operator==(const ColorSetting&) const = default;
};

// A specification understood, or one sentence for the user about what is wrong.
struct ParsedColorSetting {
    ColorSetting setting;
    std::string problem;  // empty if `setting` holds
};

// Parses "raw", "jpeg", "jpeg:quality=85", "h264:crf=20". The problem names the existing codecs,
// or the wrong parameter. For qualities of 85 and more a camera's own JPEG pictures are passed
// through untouched; below, they are encoded again. `pass=0` and `pass=1` override this. A newly
// encoded JPEG that is not smaller than the camera's own picture is never sent.
ParsedColorSetting parse_color_setting(std::string_view text);

std::vector<std::string> color_codec_names();

// A text may be understood and still not be possible here: H.264 needs a library
// that not every machine has. One sentence about what is missing, or empty.
std::string missing_color_encoder(const ColorSetting& setting);
std::string missing_color_decoder(const ColorSetting& setting);

// One encoded colour picture.
struct EncodedColor {
    ByteView bytes;
    // False: it refers to the picture that this encoder encoded before it.
    bool key = true;
    // Set by an encoder that changes its codec; otherwise the codec is that of the setting.
    std::optional<ColorCodecId> codec = std::nullopt;
};

// One stream's encoder. Not thread safe.
class ColorEncoder {
public:
    virtual ~ColorEncoder() = default;

    // Encodes `color`, which is not empty, and returns the bytes, valid until
    // the next call and no longer than `color` itself, whose JPEG they may be. Fails only if a
    // camera's JPEG that must be recoded is damaged, or if the picture is larger
    // than the codec can do. `key`: the frame must be decodable by itself.
    virtual Result<EncodedColor> encode(const ColorData& color, bool key) = 0;
};

// One stream's decoder. Not thread safe. Safe for untrusted input.
class ColorDecoder {
public:
    struct Decoded {
        FrameNumber frame = 0;
        ColorImage image;
    };

    virtual ~ColorDecoder() = default;

    // Takes one encoded frame. The status reports errors that are found at once. A
    // frame that is no key frame must follow the one that it refers to: do not
    // submit it if that one is lost (Status::missing_reference).
    virtual Status submit(ByteView encoded, FrameNumber frame) = 0;

    // The next finished frame, in order of submission, or nothing yet.
    virtual std::optional<Decoded> poll() = 0;

    // Gives back an image's memory to be used again.
    virtual void recycle(ColorImage image) = 0;

    // Frames that were submitted and are neither finished nor failed.
    virtual std::size_t pending() const { return 0; }

    // Frames that submit() took and that failed later, since the last call. After a failure the
    // decoder waits for a key frame: submit() answers any other with Status::missing_reference.
    virtual std::size_t take_failures() { return 0; }
};

// The size that an encoded picture says it has; nothing is decoded, no memory taken. Safe for
// untrusted input.
Result<Size> read_color_size(ColorCodecId id, ByteView encoded);

// Throw Error where this build has no such codec.
std::unique_ptr<ColorEncoder> make_color_encoder(const ColorSetting& setting);
std::unique_ptr<ColorDecoder> make_color_decoder(ColorCodecId id);

}  // namespace theatron::video
