// SPDX-License-Identifier: Apache-2.0
// Any sequence of media messages (each behind a three-byte length) for a viewer
// of one camera: nothing is read or written outside, whatever the order.
#include "receive/receiver.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    static const char* const depth_codecs[] = {"trvl:layers=3", "zstd:delta=1", "ans:delta=1",
                                               "lz4"};
    ByteReader in(std::as_bytes(std::span(data, size)));
    receive::Receiver receiver({[](receive::CameraFramePtr) {}, [](StreamId, SettingId) {}});
    wire::Camera camera;
    camera.depth_stream = depth_stream(camera.id);
    camera.color_stream = color_stream(camera.id);
    camera.has_color = true;
    receiver.set_cameras({camera});
    receiver.set_settings(
        {{camera.depth_stream, SettingId{1}, depth_codecs[in.get<std::uint8_t>() % 4]},
         {camera.color_stream, SettingId{2}, "raw"}});
    for (TimePoint now; !in.rest().empty(); now += 1ms) {
        const std::size_t length = in.get<std::uint8_t>() | std::size_t(in.get<std::uint16_t>())
                                                                << 8;
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        const Bytes message(part.begin(), part.end());
        // Large pictures cost the fuzzer time and show nothing that small ones do not.
        const auto header = wire::parse_media_header(message);
        if (header && header->payload_size > 1 << 16)
            continue;
        (void)receiver.on_media(message, now);
    }
    (void)receiver.figures(from_us(1));
    return 0;
}
