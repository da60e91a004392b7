// SPDX-License-Identifier: Apache-2.0
// Any bytes, as one file or cut into two segments: reading stays inside them and ends, every frame
// that it names can be read or is damaged, and a recovered recording is complete, or there is none.
#include <unistd.h>

#include <cstdlib>

#include "base/error.h"
#include "record/recording_file.h"
#include "record/recover.h"
#include "record/speaker_note.h"

namespace {

using namespace theatron;

// In memory, if the system has such a folder: a disk would be too slow.
void recover_all(const record::RecordingFile& recording) {
    const std::string stem = "/dev/shm/theatron_fuzz_" + std::to_string(getpid());
    const auto remove = [&] {
        for (std::uint32_t n = 1; n <= recording.segments().size(); ++n)
            std::filesystem::remove(record::segment_path(stem + ".mkv", n));
    };
    remove();
    try {
        record::recover(recording, stem + ".mkv", {});
    } catch (const Error& error) {
        // Without anything whole there is no new file.
        if (!std::string_view(error.what()).starts_with("Nothing in this recording") ||
            std::filesystem::exists(stem + ".mkv"))
            std::abort();
        return;
    }
    const auto saved = record::RecordingFile::open(stem + ".mkv");
    for (const record::Segment& segment : saved->segments())
        if (!segment.is_whole())
            std::abort();
    if (saved->refused() > 0)
        std::abort();
    remove();
}

void read_all(std::vector<ByteView> files) {
    std::vector<std::unique_ptr<record::ByteSource>> sources;
    for (const ByteView file : files)
        sources.push_back(std::make_unique<record::MemorySource>(file));
    const auto recording = record::RecordingFile::read(std::move(sources));
    if (!recording)
        return;
    Bytes payload;
    for (const record::CameraContent& camera : (*recording)->cameras())
        for (const record::StreamContent* stream : {&camera.depth, &camera.color})
            for (const record::RecordedFrame& frame : stream->frames) {
                const Status status = (*recording)->read_payload(frame, payload);
                if (status != Status::ok && status != Status::malformed)
                    std::abort();
                if (!(*recording)->read_header(frame) || frame.time() < Duration(0) ||
                    frame.time() > (*recording)->duration())
                    std::abort();
            }
    const auto check_beside = [&](const record::RecordedFrame& part) {
        const Status status = (*recording)->read_payload(part, payload);
        if ((status != Status::ok && status != Status::malformed) || part.time() < Duration(0) ||
            !(*recording)->read_header(part))
            std::abort();
    };
    for (const record::RecordedFrame& part : (*recording)->room().frames)
        check_beside(part);
    for (const record::VoiceContent& voice : (*recording)->voices()) {
        if (voice.parts.empty())
            std::abort();
        for (const record::RecordedFrame& packet : voice.content.frames)
            check_beside(packet);
        for (const record::FilterChange& change : voice.content.filters)
            (void)record::parse_speaker_note(change.filters);
    }
    if (std::filesystem::exists("/dev/shm"))
        recover_all(**recording);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = std::as_bytes(std::span(data, size));
    read_all({input});
    if (size < 2)
        return 0;
    // The first two bytes say where the second file begins.
    const std::size_t cut = std::min<std::size_t>(load_le<std::uint16_t>(input.data()), size - 2);
    read_all({input.subspan(2, cut), input.subspan(2 + cut)});
    return 0;
}
