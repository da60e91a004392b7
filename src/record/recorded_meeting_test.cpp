// SPDX-License-Identifier: Apache-2.0
// Recordings of sessions without cameras: the room and the voices of those who agreed.
#include <gtest/gtest.h>

#include <algorithm>

#include "record/recording_layout.h"
#include "record/recover.h"
#include "record/test_recordings.h"

namespace theatron::record {
namespace {

// A session that takes a part of its room each 100 ms; Anna has agreed to be recorded.
class RecordedMeeting : public ::testing::Test {
protected:
    static constexpr ParticipantId anna{3};
    static constexpr StreamId depth = depth_stream(CameraId{0}), color = color_stream(CameraId{0});

    RecordedMeeting() { intake_.describe_voices({{anna, "Anna"}}); }

    TimePoint now() const { return session_begin.session + passed_; }
    void describe(int count, bool new_connection = false) {
        std::map<StreamId, SettingId> settings;
        if (count > 0)
            settings = {{depth, SettingId(3)}, {color, SettingId(3)}};
        intake_.describe(cameras(count), settings, new_connection, now());
    }
    void pass(Duration time) {
        for (const Duration end = passed_ + time; passed_ < end; passed_ += 100ms) {
            const bool key = std::exchange(wants_key_, false) || taken_ % 20 == 0;
            const bool taken =
                intake_.take_room(Bytes(30, std::byte(key)), key, now() - 5ms, at_once(now()));
            taken_ += taken;
            wants_key_ = !taken;
            intake_.pass_time(at_once(now()));
        }
    }
    void say(int number) {
        const Bytes opus(40, std::byte(number));
        intake_.take_voice(anna, {std::uint32_t(number), now() - 30ms, 20, true, -30, opus}, now());
    }
    void picture(int number) {
        for (const StreamId stream : {depth, color}) {
            const Message m =
                message(stream, FrameNumber(number), passed_ - 10ms, 500, FrameNumber(number));
            (void)intake_.take(m.header, m.bytes, "", at_once(now()));
        }
    }
    std::unique_ptr<RecordingFile> finish() {
        intake_.recorder()->finish();
        EXPECT_EQ(intake_.recorder()->figures().problem, "");
        return RecordingFile::open(file_);
    }
    // The times of Anna's packets.
    static std::vector<Duration> speech(const RecordingFile& recording) {
        std::vector<Duration> found;
        for (const VoiceContent& voice : recording.voices())
            for (const RecordedFrame& frame : voice.content.frames)
                if (recording.read_header(frame)->codec == voice_codec)
                    found.push_back(frame.time());
        return found;
    }

    testing::TemporaryFolder folder_;
    fs::path file_ = folder_.path() / "meeting.mkv";
    Intake intake_{file_, {.has_room = true}};
    Duration passed_{};
    int taken_ = 0;
    bool wants_key_ = false;
};

TEST_F(RecordedMeeting, WithoutACameraHasItsRoomAndVoices) {
    describe(0, true);
    pass(500ms);
    say(1);
    pass(Intake::camera_patience - 500ms);
    EXPECT_EQ(intake_.recorder(), nullptr) << "a camera may still come";
    pass(28s);
    say(2);
    pass(1s);
    const auto recording = finish();
    EXPECT_TRUE(recording->complete());
    EXPECT_TRUE(recording->cameras().empty());
    ASSERT_EQ(recording->segments().size(), 1u);
    EXPECT_EQ(recording->segments()[0].frames, 0u);
    EXPECT_EQ(recording->room().frames.size(), std::size_t(taken_));
    EXPECT_TRUE(recording->room().frames.front().key);
    EXPECT_EQ(recording->room().frames.front().time(), 0ms);
    EXPECT_NEAR(to_seconds(recording->duration()), 30.9, 0.15);
    EXPECT_NEAR(to_seconds(intake_.recorder()->figures().duration), 30.9, 0.15);
    const auto said = speech(*recording);
    ASSERT_EQ(said.size(), 2u);
    EXPECT_NEAR(to_seconds(said[0]), 0.5, 0.05) << "what is said before the file is made is in it";
    EXPECT_NEAR(to_seconds(said[1] - said[0]), 29.5, 0.03);

    const Recovered saved = recover(*recording, folder_.path() / "saved.mkv", {});
    EXPECT_TRUE(saved.complete);
    const auto again = RecordingFile::open(folder_.path() / "saved.mkv");
    EXPECT_EQ(again->room().frames.size(), recording->room().frames.size());
    EXPECT_EQ(speech(*again), said);
    EXPECT_EQ(again->duration(), recording->duration());
}

TEST_F(RecordedMeeting, ALostConnectionInterruptsTheVoicesOfThoseWhoSpoke) {
    describe(0, true);
    intake_.describe_voices({{anna, "Anna"}, {ParticipantId{4}, "Ben"}});
    pass(3s);
    say(1);
    pass(1s);
    intake_.interrupt_voices();
    intake_.describe_voices({});
    // Nobody was described since.
    intake_.interrupt_voices();
    const auto voices = intake_.voices();
    const auto of_anna =
        std::ranges::find(voices, anna, [](const auto& v) { return v.who.person; });
    ASSERT_NE(of_anna, voices.end());
    EXPECT_EQ(of_anna->who.name, "Anna");
    EXPECT_EQ(of_anna->interruptions, 1u);
    for (const Intake::Voice& voice : voices)
        if (voice.who.name == "Ben")
            EXPECT_EQ(voice.interruptions, 0u);
}

TEST_F(RecordedMeeting, ACameraThatComesLaterBeginsASegmentAndOneThatGoesToo) {
    describe(0, true);
    pass(4s);
    describe(1);
    for (int i = 0; i < 20; ++i) {
        picture(i);
        pass(100ms);
    }
    describe(0);
    pass(6s);
    say(7);
    pass(1s);
    const auto recording = finish();
    EXPECT_TRUE(recording->complete());
    ASSERT_EQ(recording->segments().size(), 3u);
    EXPECT_EQ(recording->segments()[0].frames, 0u);
    EXPECT_EQ(recording->segments()[1].frames, 40u);
    EXPECT_EQ(recording->segments()[2].frames, 0u);
    ASSERT_EQ(recording->cameras().size(), 1u);
    // The room before the picture stays before it.
    EXPECT_NEAR(to_seconds(recording->cameras()[0].depth.frames.front().time()), 4.0, 0.15);
    const auto said = speech(*recording);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NEAR(to_seconds(said[0]), 12, 0.2);
    const auto& parts = recording->room().frames;
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end(),
                               [](const auto& a, const auto& b) { return a.time() < b.time(); }));
}

TEST_F(RecordedMeeting, ARoomInWhichNothingChangesBeginsAllTheSame) {
    describe(0, true);
    EXPECT_TRUE(intake_.take_room(Bytes(30), true, now() - 5ms, at_once(now())));
    passed_ += Intake::camera_patience;
    intake_.pass_time(at_once(now()));
    EXPECT_NE(intake_.recorder(), nullptr);
}

TEST_F(RecordedMeeting, ACameraThatComesAtOnceIsInTheSegmentOfWhatWasSaidBefore) {
    describe(0, true);
    pass(300ms);
    say(1);
    pass(700ms);
    describe(1);
    pass(200ms);
    say(2);
    pass(200ms);
    for (int i = 0; i < 20; ++i) {
        picture(i);
        pass(100ms);
    }
    const auto recording = finish();
    EXPECT_TRUE(recording->complete());
    ASSERT_EQ(recording->segments().size(), 1u);
    EXPECT_EQ(recording->segments()[0].frames, 40u);
    EXPECT_NEAR(to_seconds(recording->cameras().at(0).depth.frames.at(0).time()), 1.4, 0.05);
    EXPECT_EQ(recording->room().frames.size(), std::size_t(taken_));
    EXPECT_EQ(speech(*recording).size(), 2u);
}

TEST_F(RecordedMeeting, ACameraThatSendsNothingYetDelaysNothing) {
    describe(1, true);
    pass(8s);
    picture(0);
    pass(1s);
    const auto recording = finish();
    EXPECT_EQ(recording->segments().size(), 1u);
    EXPECT_NEAR(to_seconds(recording->cameras().at(0).depth.frames.at(0).time()), 3, 0.15);
    EXPECT_EQ(recording->room().frames.size(), std::size_t(taken_));
}

TEST_F(RecordedMeeting, AVoiceIsHeardAfterALongSilence) {
    describe(0, true);
    pass(3s);
    say(1);
    pass(11min);
    say(2);
    pass(1s);
    EXPECT_EQ(intake_.voices().at(0).figures.packets, 2u);
    EXPECT_EQ(speech(*finish()).size(), 2u);
}

TEST_F(RecordedMeeting, AnotherConnectionBeginsASegmentOfTheRoom) {
    describe(0, true);
    pass(3s);
    describe(0, true);
    pass(1s);
    say(1);
    pass(3s);
    const auto recording = finish();
    EXPECT_EQ(recording->segments().size(), 2u);
    EXPECT_EQ(recording->room().frames.size(), std::size_t(taken_));
    // The clock of the test goes on: the segments lie one behind the other.
    EXPECT_NEAR(to_seconds(speech(*recording).at(0)), 4, 0.15);
}

}  // namespace
}  // namespace theatron::record
