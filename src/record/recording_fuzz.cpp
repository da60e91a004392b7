// SPDX-License-Identifier: Apache-2.0
// Any bytes: reading stays inside them and ends, and every frame that it names
// can be read.
#include <cstdlib>

#include "record/recording_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    const auto recording =
        record::RecordingFile::read(std::make_unique<record::MemorySource>(input));
    if (!recording)
        return 0;
    Bytes payload;
    for (const record::CameraContent& camera : (*recording)->cameras())
        for (const record::StreamContent* stream : {&camera.depth, &camera.color})
            for (const record::RecordedFrame& frame : stream->frames)
                if ((*recording)->read_payload(frame, payload) != Status::ok)
                    std::abort();
    return 0;
}
