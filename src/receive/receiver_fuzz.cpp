// SPDX-License-Identifier: Apache-2.0
// A viewer of one camera and a hostile host: media messages (each behind a three-byte
// length) and settings, the usual codecs and others, with numbers in use, new, 0 and none at all.
// No order leads to a read or write outside of memory; pictures have the calibration's size.
#include <cstdlib>

#include "base/error.h"
#include "geometry/calibration.h"
#include "receive/receiver.h"

namespace {

using namespace theatron;

constexpr Size depth_size{32, 24}, color_size{40, 32};

wire::Camera camera() {
    Calibration calibration;
    calibration.depth.size = depth_size;
    calibration.color.size = color_size;
    calibration.depth.fx = calibration.depth.fy = calibration.color.fx = calibration.color.fy = 30;
    wire::Camera camera;
    camera.depth_stream = depth_stream(camera.id);
    camera.color_stream = color_stream(camera.id);
    camera.has_color = true;
    camera.calibration = encode_calibration(calibration);
    return camera;
}

// One byte says which settings come next.
void set_settings(receive::Receiver& receiver, std::uint8_t choice) {
    static const char* const depth[] = {"strata", "trvl:layers=3",   "zstd:delta=1", "ans:delta=1",
                                        "lz4",    "strata:layers=3", "raw",          "nonsense"};
    static const char* const color[] = {"jpeg", "raw", "h264", "jpeg"};
    const auto number = [](int n) { return SettingId(n); };
    try {
        receiver.set_settings(
            {{depth_stream(CameraId{0}), number(choice / 64), depth[choice % 8]},
             {color_stream(CameraId{0}), number(choice / 64 + 1), color[choice / 8 % 4]}});
    } catch (const Error&) {
        // A codec that there is not.
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(std::as_bytes(std::span(data, size)));
    receive::Receiver receiver({[](receive::CameraFramePtr frame) {
                                    if (frame->depth.size != depth_size ||
                                        (frame->color && frame->color->size != color_size))
                                        std::abort();
                                },
                                [](StreamId, SettingId) {}});
    receiver.set_cameras({camera()});
    const auto first = in.get<std::uint8_t>();
    if (first % 4 != 0)
        set_settings(receiver, first / 4 | 64);
    for (TimePoint now; !in.rest().empty(); now += 1ms) {
        const std::size_t length = in.get<std::uint8_t>() | std::size_t(in.get<std::uint16_t>())
                                                                << 8;
        // No message is so short: a change of settings instead.
        if (length < 4) {
            set_settings(receiver, in.get<std::uint8_t>());
            continue;
        }
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        const Bytes message(part.begin(), part.end());
        (void)receiver.on_media(message, now);
    }
    (void)receiver.figures(from_us(1));
    return 0;
}
