// SPDX-License-Identifier: Apache-2.0
// The track of the room's state in a recording. Its content is opaque here.
#include <gtest/gtest.h>

#include "record/crc32c.h"
#include "record/intake.h"
#include "record/recording_layout.h"
#include "record/recover.h"
#include "record/test_recordings.h"

namespace theatron::record {
namespace {

Bytes part_of(int number) {
    return Bytes(20 + std::size_t(number) % 7, std::byte(number));
}

// A recording of one camera in which two parts of the room follow each pair of pictures; every
// tenth part is a key part.
struct RoomRecording {
    fs::path file;
    int parts = 0;
    std::vector<Message> pictures;

    explicit RoomRecording(const fs::path& folder, int frames = 60) : file(folder / "room.mkv") {
        Intake intake(file, {.has_room = true});
        std::map<StreamId, SettingId> settings{{depth_stream(CameraId{0}), SettingId(3)},
                                               {color_stream(CameraId{0}), SettingId(3)}};
        intake.describe(cameras(1), settings, true, TimePoint(1s));
        EXPECT_FALSE(intake.take_room(part_of(0), true, TimePoint(1s), at_once(TimePoint(1s))))
            << "nothing is recorded yet";
        for (int i = 0; i < frames; ++i) {
            const auto frame = FrameNumber(i);
            const Duration at = 33ms * i;
            for (const StreamId stream : {depth_stream(CameraId{0}), color_stream(CameraId{0})}) {
                const Message m = message(stream, frame, at, 3000, i % 30 == 0 ? frame : frame - 1);
                pictures.push_back(m);
                const TimePoint now = m.header.captured + 10ms;
                (void)intake.take(m.header, m.bytes, "", at_once(now));
            }
            for (int n = 0; n < 2; ++n, ++parts) {
                const TimePoint begin = session_begin.session + at + 10ms * n;
                EXPECT_TRUE(intake.take_room(part_of(parts), parts % 10 == 0, begin,
                                             at_once(begin + 11ms)));
            }
        }
        intake.recorder()->finish();
        const Recorder::Figures figures = intake.recorder()->figures();
        EXPECT_EQ(figures.problem, "");
        EXPECT_EQ(figures.frames, pictures.size()) << "parts of the room are no pictures";
        EXPECT_GT(figures.room_bytes, std::uint64_t(20 * parts));
    }
};

std::vector<int> numbers_in(const RecordingFile& recording) {
    std::vector<int> numbers;
    Bytes payload;
    for (const RecordedFrame& frame : recording.room().frames)
        if (recording.read_payload(frame, payload) == Status::ok)
            numbers.push_back(std::to_integer<int>(payload.at(0)));
    return numbers;
}

class RecordedRoom : public ::testing::Test {
protected:
    testing::TemporaryFolder folder_;
};

TEST_F(RecordedRoom, ComesBackWithItsTimesBesideThePictures) {
    const RoomRecording made(folder_.path());
    const auto recording = RecordingFile::open(made.file);
    EXPECT_TRUE(recording->complete());
    EXPECT_TRUE(recording->segments()[0].has_room);
    EXPECT_EQ(recording->segments()[0].frames, made.pictures.size());
    EXPECT_EQ(count_equal(*recording, made.pictures), made.pictures.size());
    const auto& parts = recording->room().frames;
    ASSERT_EQ(parts.size(), std::size_t(made.parts));
    for (int i = 0; i < made.parts; ++i) {
        EXPECT_EQ(parts[std::size_t(i)].time(), 33ms * (i / 2) + 10ms * (i % 2));
        EXPECT_EQ(parts[std::size_t(i)].key, i % 10 == 0);
    }
    EXPECT_EQ(numbers_in(*recording).size(), std::size_t(made.parts));
    EXPECT_EQ(recording->duration(), 33ms * 59) << "of the pictures";
}

TEST_F(RecordedRoom, DamageOfAPartIsFoundAndCostsNothingElse) {
    const RoomRecording made(folder_.path());
    const auto place = RecordingFile::open(made.file)->room().frames[25].payload_at;
    Bytes bytes = bytes_of(made.file);
    bytes[place] ^= std::byte{1};
    write_bytes(made.file, bytes);
    const auto damaged = RecordingFile::open(made.file);
    EXPECT_EQ(numbers_in(*damaged).size(), std::size_t(made.parts - 1));

    const Recovered saved = recover(*damaged, folder_.path() / "saved.mkv", {});
    EXPECT_FALSE(saved.complete);
    EXPECT_EQ(saved.room.damaged, 1u);
    // Those up to the next key part refer to it.
    EXPECT_EQ(saved.room.undecodable, 4u);
    const auto again = RecordingFile::open(folder_.path() / "saved.mkv");
    EXPECT_TRUE(again->segments()[0].is_whole());
    EXPECT_EQ(again->room().frames.size(), std::size_t(made.parts - 5));
    EXPECT_EQ(count_equal(*again, made.pictures), made.pictures.size());
}

TEST_F(RecordedRoom, ACutFileHasThePartsBeforeTheCut) {
    const RoomRecording made(folder_.path());
    Bytes bytes = bytes_of(made.file);
    bytes.resize(bytes.size() / 2);
    write_bytes(made.file, bytes);
    const auto cut = RecordingFile::open(made.file);
    EXPECT_FALSE(cut->complete());
    const auto numbers = numbers_in(*cut);
    EXPECT_GT(numbers.size(), std::size_t(made.parts / 3));
    for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_EQ(numbers[i], int(i));
}

TEST_F(RecordedRoom, EachSegmentBeginsWithAKeyPart) {
    Intake intake(folder_.path() / "a.mkv", {.has_room = true});
    std::map<StreamId, SettingId> settings{{depth_stream(CameraId{0}), SettingId(3)},
                                           {color_stream(CameraId{0}), SettingId(3)}};
    const auto picture = [&](StreamId stream, FrameNumber frame) {
        const Message m = message(stream, frame, 33ms * frame, 100, frame);
        const TimePoint now = m.header.captured + 10ms;
        (void)intake.take(m.header, m.bytes, "", at_once(now));
        return m.header.captured;
    };
    const StreamId depth = depth_stream(CameraId{0});
    intake.describe(cameras(1), settings, true, TimePoint(1s));
    TimePoint at = picture(depth, 0);
    EXPECT_FALSE(intake.take_room(part_of(0), false, at, at_once(at)))
        << "a segment begins with a key part";
    EXPECT_TRUE(intake.take_room(part_of(1), true, at, at_once(at)));
    EXPECT_TRUE(intake.take_room(part_of(2), false, at, at_once(at)));
    intake.begin_segment();
    EXPECT_TRUE(intake.take_room(part_of(3), false, at, at_once(at))) << "it has not begun yet";
    at = picture(depth, 1);
    EXPECT_FALSE(intake.take_room(part_of(4), false, at, at_once(at)));
    EXPECT_TRUE(intake.take_room(part_of(5), true, at, at_once(at)));
    // Times of another connection's clock do not belong into this segment.
    intake.describe(cameras(1), settings, true, at);
    EXPECT_FALSE(intake.take_room(part_of(6), true, at, at_once(at)));
    intake.recorder()->finish();
    const auto recording = RecordingFile::open(folder_.path() / "a.mkv");
    EXPECT_EQ(numbers_in(*recording), (std::vector{1, 2, 3, 5}));
    EXPECT_EQ(recording->segments().size(), 2u);
}

TEST_F(RecordedRoom, IsNotInARecordingWithoutASession) {
    const auto messages = std::vector{message(depth_stream(CameraId{0}), 0, 0ms, 10, 0)};
    record_all(folder_.path() / "plain.mkv", 1, messages);
    const auto recording = RecordingFile::open(folder_.path() / "plain.mkv");
    EXPECT_FALSE(recording->room().present);
    EXPECT_FALSE(recording->segments()[0].has_room);
}

}  // namespace
}  // namespace theatron::record
