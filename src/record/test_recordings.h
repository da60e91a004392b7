// SPDX-License-Identifier: Apache-2.0
// Recordings for tests: messages whose bytes follow from their numbers, and files of them.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "record/intake.h"
#include "record/recorder.h"
#include "record/recording_file.h"
#include "testing/temporary_folder.h"

namespace theatron::record {

namespace fs = std::filesystem;

inline const ClockPair session_begin{from_us(5'000'000'017), UtcTime(1'700'000'000s)};

struct Message {
    wire::MediaHeader header;
    std::shared_ptr<const Bytes> bytes;
};

// A message with `size` bytes that depend on its stream and number.
inline Message message(StreamId stream, FrameNumber frame, Duration at, std::size_t size,
                       FrameNumber reference, int layer = 0) {
    wire::MediaHeader header;
    header.codec = is_depth(stream) ? 4 : 66;
    header.stream = stream;
    header.setting = SettingId(3);
    header.frame = frame;
    header.reference = reference;
    header.key = frame == reference;
    header.temporal_layer = std::uint8_t(layer);
    header.payload_size = std::uint32_t(size);
    header.moment = header.captured = from_us(5'000'000'017) + at;
    header.delivered = header.captured + Duration(1234);
    header.encoded = header.captured + Duration(5677);
    auto bytes = std::make_shared<Bytes>(wire::media_header_size + size);
    wire::write_media_header(header, bytes->data());
    std::minstd_rand random(frame * 64 + unsigned(stream) + 1);
    for (std::size_t i = wire::media_header_size; i < bytes->size(); ++i)
        (*bytes)[i] = std::byte(random() >> 16);
    return {header, bytes};
}

// A machine and a session with the same clock.
inline Intake::Now at_once(TimePoint now) {
    return {now, {now, session_begin.utc + (now - session_begin.session)}};
}

// Arrives ten milliseconds after its exposure.
inline Recorder::Added add(Recorder& recorder, const Message& m, const std::string& filters = {}) {
    return recorder.add(m.header, m.bytes, m.header.captured + 10ms, filters);
}

inline std::vector<RecordedCamera> cameras(int count) {
    std::vector<RecordedCamera> list;
    for (int i = 0; i < count; ++i) {
        RecordedCamera camera;
        camera.id = CameraId(i);
        camera.name = "camera " + std::to_string(i);
        camera.frames_per_second = 30;
        camera.calibration = Bytes(100, std::byte(i));
        camera.depth = {"zstd:delta=1,layers=3", 640, 576};
        camera.color = RecordedStream{"jpeg:quality=85", 1280, 720};
        list.push_back(camera);
    }
    return list;
}

// Frames of several cameras with temporal layers, jitter and a gap of half a second.
inline std::vector<Message> generated(int camera_count, int frames, std::size_t size) {
    std::vector<Message> messages;
    std::minstd_rand random(7);
    for (int n = 0; n < frames; ++n) {
        if (n >= frames / 2 && n < frames / 2 + 15)
            continue;
        for (int c = 0; c < camera_count; ++c) {
            const Duration at(n * 33'333 + int(random() % 3000) + c * 411);
            const int layer = n % 4 == 0 ? 0 : n % 2 == 0 ? 1 : 2;
            const auto reference =
                FrameNumber(layer == 0 ? (n == 0 ? 0 : n - 4) : n - (layer == 1 ? 2 : 1));
            messages.push_back(message(depth_stream(CameraId(c)), FrameNumber(n), at,
                                       size + random() % size, reference, layer));
            messages.push_back(message(color_stream(CameraId(c)), FrameNumber(n), at,
                                       size + random() % size, FrameNumber(n)));
        }
    }
    return messages;
}

inline void record_all(const fs::path& path, int camera_count,
                       const std::vector<Message>& messages) {
    Recorder recorder(path, cameras(camera_count), session_begin);
    for (const Message& m : messages)
        ASSERT_EQ(add(recorder, m), Recorder::Added::taken);
    recorder.finish();
    EXPECT_EQ(recorder.figures().problem, "");
    EXPECT_EQ(recorder.figures().frames, messages.size());
    EXPECT_EQ(recorder.figures().dropped, 0u);
    EXPECT_EQ(recorder.figures().bytes, fs::file_size(path));
}

inline Bytes bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const ByteView view = as_bytes(text);
    return Bytes(view.begin(), view.end());
}

// The frames of a recording, in the order of `messages`, and whether each is as it was.
inline std::size_t count_equal(const RecordingFile& recording,
                               const std::vector<Message>& messages) {
    std::map<StreamId, std::size_t> next;
    std::size_t equal = 0;
    Bytes payload;
    for (const Message& m : messages) {
        const CameraContent& camera = recording.cameras()[std::size_t(camera_of(m.header.stream))];
        const auto& frames = is_depth(m.header.stream) ? camera.depth.frames : camera.color.frames;
        const std::size_t i = next[m.header.stream]++;
        if (i >= frames.size())
            continue;
        EXPECT_EQ(recording.read_payload(frames[i], payload), Status::ok);
        const ByteView expected = wire::media_payload(*m.bytes);
        equal += *recording.read_header(frames[i]) == m.header &&
                 std::equal(payload.begin(), payload.end(), expected.begin(), expected.end());
    }
    return equal;
}

inline std::size_t frames_in(const RecordingFile& recording) {
    std::size_t count = 0;
    for (const CameraContent& camera : recording.cameras())
        count += camera.depth.frames.size() + camera.color.frames.size();
    return count;
}

// Returns when `recorder` has written `frames` frames or has ended.
inline void wait_until_written(const Recorder& recorder, std::uint64_t frames) {
    while (recorder.figures().frames < frames && recorder.figures().problem.empty())
        std::this_thread::sleep_for(1ms);
}

inline void write_bytes(const fs::path& path, ByteView bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

}  // namespace theatron::record
