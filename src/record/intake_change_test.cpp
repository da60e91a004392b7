// SPDX-License-Identifier: Apache-2.0
// The change from one segment to the next, seen from streams that have no part in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "record/intake.h"
#include "record/recording_file.h"
#include "record/recording_layout.h"
#include "testing/temporary_folder.h"

namespace theatron::record {
namespace {

constexpr Duration spacing = 33'333us;
constexpr TimePoint clock_begin = from_us(5'000'000'000);
// Frames between the request for a key frame and the key frame.
constexpr int travel_frames = 4;

std::vector<FrameNumber> count_to(FrameNumber count) {
    std::vector<FrameNumber> numbers(count);
    std::iota(numbers.begin(), numbers.end(), FrameNumber(0));
    return numbers;
}

// A host of several streams at 30 Hz.
class IntakeChange : public ::testing::Test {
protected:
    struct Sender {
        FrameNumber next = 0;
        bool all_keys = false;
        SettingId setting{1};
        int until_key = 0;  // frames; less than zero: none is wanted
    };

    static RecordedCamera camera(int id, const std::string& name, bool has_color = false) {
        RecordedCamera camera;
        camera.id = CameraId{std::uint8_t(id)};
        camera.name = name;
        camera.frames_per_second = 30;
        camera.depth = {"zstd:delta=1", 4, 3};
        if (has_color)
            camera.color = RecordedStream{"jpeg", 4, 3};
        return camera;
    }

    void describe(std::vector<RecordedCamera> cameras, bool new_connection = false) {
        std::map<StreamId, SettingId> settings;
        for (const RecordedCamera& camera : cameras) {
            const StreamId depth = depth_stream(camera.id), color = color_stream(camera.id);
            settings[depth] = senders_[depth].setting;
            if (camera.color) {
                senders_[color].all_keys = true;
                settings[color] = senders_[color].setting;
            }
        }
        intake_.describe(std::move(cameras), settings, new_connection, local_);
    }

    // True if the intake asks for a key frame.
    bool deliver(StreamId stream, bool key, TimePoint captured) {
        Sender& sender = senders_[stream];
        wire::MediaHeader header;
        header.stream = stream;
        header.setting = sender.setting;
        header.frame = sender.next++;
        header.key = key;
        header.reference = header.key ? header.frame : header.frame - 1;
        header.captured = captured;
        header.payload_size = std::uint32_t(payload_size_);
        auto message = std::make_shared<Bytes>(wire::media_header_size + payload_size_);
        wire::write_media_header(header, message->data());
        return intake_.take(header, std::move(message), "", now());
    }
    void send(StreamId stream) {
        Sender& sender = senders_[stream];
        const bool key = sender.all_keys || sender.until_key == 0;
        if (sender.until_key >= 0)
            --sender.until_key;
        if (deliver(stream, key, session_) && sender.until_key < 0 && answers_)
            sender.until_key = travel_frames;
    }
    void run(int frames, const std::vector<StreamId>& streams) {
        for (int i = 0; i < frames; ++i) {
            for (const StreamId stream : streams)
                send(stream);
            local_ += spacing;
            session_ += spacing;
            intake_.pass_time(now());
        }
    }

    void begin_with_left(int frames = 20) {
        describe({camera(0, "left")}, true);
        run(frames, {left_});
    }
    void begin_with_both() {
        describe({camera(0, "left"), camera(1, "right")}, true);
        run(20, {left_, right_});
    }
    void right_joins() { describe({camera(0, "left"), camera(1, "right")}); }
    void right_leaves() { describe({camera(0, "left")}); }
    // The right camera, if it was there, leaves.
    void left_is_moved() {
        RecordedCamera moved = camera(0, "left");
        moved.calibration = Bytes(5);
        describe({moved});
    }
    // The right camera sends its key frame at once, the left one none.
    void right_is_moved_and_left_sends_no_key() {
        answers_ = false;
        senders_[right_].until_key = 0;
        RecordedCamera moved = camera(1, "right");
        moved.calibration = Bytes(5);
        describe({camera(0, "left"), moved});
    }

    Intake::Now now() const {
        return {local_, {session_, UtcTime(1'700'000'000s) + (session_ - clock_begin)}};
    }

    std::unique_ptr<RecordingFile> recorded() {
        intake_.take_held();
        intake_.recorder()->finish();
        return RecordingFile::open(file_);
    }
    static std::vector<FrameNumber> numbers(const StreamContent& stream) {
        std::vector<FrameNumber> result;
        for (const RecordedFrame& frame : stream.frames)
            result.push_back(frame.number);
        return result;
    }
    static std::size_t frames_in(const StreamContent& stream, std::size_t segment) {
        return std::size_t(std::count_if(stream.frames.begin(), stream.frames.end(),
                                         [&](const auto& f) { return f.segment == segment; }));
    }
    std::uint64_t lost() const {
        std::uint64_t sum = 0;
        for (const Intake::Stream& stream : intake_.streams(local_))
            sum += stream.figures.lost + stream.figures.dropped;
        return sum;
    }

    const StreamId left_ = depth_stream(CameraId{0}), right_ = depth_stream(CameraId{1}),
                   left_color_ = color_stream(CameraId{0});
    testing::TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_.path() / "a.mkv";
    static constexpr std::size_t buffer_bytes_ = std::size_t(64) << 20;
    Intake intake_{file_, {.buffer_bytes = buffer_bytes_, .has_room = true}};
    TimePoint local_ = from_us(1'000'000), session_ = clock_begin;
    std::map<StreamId, Sender> senders_;
    std::size_t payload_size_ = 8;
    bool answers_ = true;  // requests for key frames
};

TEST_F(IntakeChange, ACameraThatJoinsCostsTheOthersNoFrame) {
    begin_with_left();
    right_joins();
    run(20, {left_, right_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    ASSERT_EQ(recording->segments().size(), 2u);
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(40));
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(20));
    EXPECT_GT(frames_in(recording->cameras().at(0).depth, 0), 20u) << "until its own key frame";
}

TEST_F(IntakeChange, ACameraThatLeavesCostsTheOthersNoFrame) {
    begin_with_both();
    right_leaves();
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(40));
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(20));
    EXPECT_EQ(recording->segments().size(), 1u);
}

TEST_F(IntakeChange, AnotherCameraInThePlaceOfOneThatLeftIsNoInterruption) {
    begin_with_both();
    right_leaves();
    run(90, {left_});
    senders_[right_] = {.next = 7'000, .setting = SettingId{2}};
    describe({camera(0, "left"), camera(1, "guest")});
    run(20, {left_, right_});
    EXPECT_EQ(lost(), 0u);
    for (const Intake::Stream& stream : intake_.streams(local_))
        EXPECT_TRUE(stream.complete()) << stream.camera;
    EXPECT_EQ(recorded()->cameras().at(1).depth.frames.size(), 40u);
}

TEST_F(IntakeChange, NorIsOneOfTheSameName) {
    begin_with_both();
    (void)intake_.news(local_);
    right_leaves();
    run(90, {left_});
    (void)intake_.news(local_);
    senders_[right_] = {.next = 0, .setting = SettingId{2}};
    right_joins();
    for (const std::string& sentence : intake_.news(local_))
        EXPECT_EQ(sentence.find("No picture"), std::string::npos) << sentence;
    run(20, {left_, right_});
    for (const Intake::Stream& stream : intake_.streams(local_))
        EXPECT_TRUE(stream.complete()) << stream.camera;
    EXPECT_EQ(recorded()->cameras().at(1).depth.frames.size(), 40u);
}

TEST_F(IntakeChange, ACalibrationThatChangesAfterACameraLeftIsRecorded) {
    begin_with_both();
    right_leaves();
    run(20, {left_});
    left_is_moved();
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(60));
    EXPECT_EQ(recording->cameras().at(0).parts.back().calibration, Bytes(5));
}

TEST_F(IntakeChange, ACalibrationMayChangeAsACameraLeaves) {
    begin_with_both();
    left_is_moved();
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(40));
    EXPECT_EQ(recording->cameras().at(0).parts.back().calibration, Bytes(5));
}

TEST_F(IntakeChange, ACalibrationThatChangesCostsNoFrameOfAnyStream) {
    std::vector<RecordedCamera> cameras{camera(0, "left", true), camera(1, "right")};
    describe(cameras, true);
    run(20, {left_, left_color_, right_});
    cameras[1].calibration = Bytes(5);
    describe(cameras);
    run(20, {left_, left_color_, right_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    ASSERT_EQ(recording->segments().size(), 2u);
    const CameraContent& left = recording->cameras().at(0);
    EXPECT_EQ(numbers(left.depth), count_to(40));
    EXPECT_EQ(numbers(left.color), count_to(40));
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(40));
    EXPECT_EQ(frames_in(left.depth, 0), frames_in(left.color, 0))
        << "depth and colour of a frame are in one segment";
}

TEST_F(IntakeChange, FramesKeepTheirTimes) {
    begin_with_left();
    right_joins();
    run(20, {left_, right_});
    const auto recording = recorded();
    const auto& frames = recording->cameras().at(0).depth.frames;
    for (std::size_t i = 1; i < frames.size(); ++i)
        EXPECT_NEAR(double(frames[i].time_us - frames[i - 1].time_us), double(spacing.count()), 2)
            << i;
    const auto& others = recording->cameras().at(1).depth.frames;
    EXPECT_NEAR(double(others[0].time_us), double(frames[20].time_us), 2);
}

TEST_F(IntakeChange, AStreamWithoutAKeyFrameIsAwaitedForALimitedTime) {
    begin_with_both();
    right_is_moved_and_left_sends_no_key();
    const int patience = int(Intake::change_patience / spacing);
    run(patience, {left_, right_});
    EXPECT_EQ(lost(), 0u);
    run(3, {left_, right_});
    EXPECT_EQ(lost(), 2u) << "those of the left stream since then";
    const auto recording = recorded();
    EXPECT_EQ(recording->segments().size(), 2u);
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(FrameNumber(20 + patience + 3)));
}

TEST_F(IntakeChange, WhatIsHeldBackIsLimited) {
    begin_with_both();
    right_is_moved_and_left_sends_no_key();
    constexpr std::size_t small = 8, large = buffer_bytes_ / Intake::held_share / 4;
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(lost(), 0u) << i;
        payload_size_ = large;
        run(1, {right_});
        payload_size_ = small;
        run(1, {left_});
    }
    EXPECT_GT(lost(), 0u) << "the segment has begun";
    EXPECT_EQ(numbers(recorded()->cameras().at(1).depth), count_to(24));
}

TEST_F(IntakeChange, AnotherChangeMeanwhileLosesNothing) {
    std::vector<RecordedCamera> cameras{camera(0, "left")};
    describe(cameras, true);
    run(20, {left_});
    cameras.push_back(camera(1, "right"));
    describe(cameras);
    run(2, {left_, right_});  // held back: the key frame of the left stream is not there yet
    cameras[0].calibration = Bytes(5);
    describe(cameras);
    run(20, {left_, right_});
    EXPECT_EQ(lost(), 0u);
    auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(42));
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(22));
    EXPECT_EQ(recording->cameras().at(0).parts.back().calibration, Bytes(5));
}

TEST_F(IntakeChange, ACameraThatComesAndGoesAtOnceKeepsItsFrames) {
    begin_with_left();
    right_joins();
    run(2, {left_, right_});
    right_leaves();
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(2));
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(42));
}

TEST_F(IntakeChange, CamerasThatComeAndGoOneAfterTheOtherCostNoFrame) {
    begin_with_left();
    for (int id = 1; id <= 6; ++id) {
        describe({camera(0, "left"), camera(id, "guest " + std::to_string(id))});
        run(2, {left_, depth_stream(CameraId(id))});
        right_leaves();
        run(id % 2, {left_});
    }
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(20 + 6 * 2 + 3 + 20));
    ASSERT_EQ(recording->cameras().size(), 7u);
    for (int id = 1; id <= 6; ++id)
        EXPECT_EQ(numbers(recording->cameras().at(std::size_t(id)).depth), count_to(2)) << id;
}

TEST_F(IntakeChange, CamerasThatComeAndGoAllTheTimeMakeFewSegments) {
    begin_with_left();
    for (int i = 0; i < 600; ++i) {
        const int id = 1 + i % 6;
        senders_[depth_stream(CameraId{std::uint8_t(id)})] = {};
        describe({camera(0, "left"), camera(id, "guest " + std::to_string(i))});
        run(3, {left_, depth_stream(CameraId{std::uint8_t(id)})});
        right_leaves();
        run(1, {left_});
    }
    run(20, {left_});
    for (const Intake::Stream& stream : intake_.streams(local_))
        if (stream.id == left_)
            EXPECT_TRUE(stream.complete());
        else
            EXPECT_FALSE(stream.complete()) << "what is left out is told";
    const auto news = intake_.news(local_);
    EXPECT_TRUE(std::any_of(news.begin(), news.end(), [](const std::string& sentence) {
        return sentence.find("too many files") != std::string::npos;
    }));
    const auto recording = recorded();
    EXPECT_LE(recording->segments().size(), 1u + SegmentPace::at_once + 4);
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(20 + 600 * 4 + 20));
}

// The number of the recording that the left out camera has was that of another one.
TEST_F(IntakeChange, ACameraThatWaitsForItsSegmentIsNotTakenForTheOneBefore) {
    begin_with_left();
    for (int i = 0; i <= SegmentPace::at_once; ++i) {
        senders_[right_] = {.setting = SettingId(std::uint16_t(i + 1))};
        RecordedCamera guest = camera(1, "guest");
        guest.calibration = Bytes(std::size_t(i + 1));
        describe({camera(0, "left"), guest});
        run(10, {left_, right_});
    }
    const auto frames = [&](const RecordingFile& recording) {
        return recording.cameras().at(1).depth.frames.size();
    };
    EXPECT_EQ(frames(*recorded()), std::size_t(SegmentPace::at_once) * 10);
}

TEST_F(IntakeChange, ACameraThatWaitedIsRecordedFromTheNextSegmentOn) {
    begin_with_left();
    for (int i = 0; i <= SegmentPace::at_once; ++i) {
        senders_[right_] = {};
        RecordedCamera guest = camera(1, "guest");
        guest.calibration = Bytes(std::size_t(i + 1));
        describe({camera(0, "left"), guest});
        run(10, {left_, right_});
    }
    run(int(SegmentPace::first_wait / spacing) + 60, {left_, right_});
    const auto recording = recorded();
    EXPECT_EQ(recording->segments().size(), 2u + SegmentPace::at_once);
    EXPECT_GT(recording->cameras().at(1).depth.frames.size(),
              std::size_t(SegmentPace::at_once) * 10 + 20);
    EXPECT_EQ(recording->cameras().at(1).parts.back().calibration,
              Bytes(std::size_t(SegmentPace::at_once + 1)));
}

TEST_F(IntakeChange, ALostConnectionBeginsItsSegmentHoweverMany) {
    begin_with_left();
    for (int i = 0; i < 3 * SegmentPace::at_once; ++i) {
        senders_[left_] = {};
        describe({camera(0, "left")}, true);
        run(5, {left_});
    }
    EXPECT_EQ(recorded()->segments().size(), 1u + 3 * SegmentPace::at_once);
}

TEST_F(IntakeChange, ARecorderThatStoodStillTakesWhatWaitsFirst) {
    begin_with_left();
    right_joins();
    run(1, {left_, right_});
    (void)intake_.news(local_);
    local_ += 5s;
    intake_.pass_time(now());
    (void)intake_.news(local_);
    run(20, {left_, right_});
    EXPECT_EQ(lost(), 0u);
    EXPECT_EQ(numbers(recorded()->cameras().at(0).depth), count_to(41));
}

TEST_F(IntakeChange, ADiskIsNotCalledSlowWhereTheRecorderStoodStill) {
    begin_with_left();
    const auto called_slow = [&] {
        const auto news = intake_.news(local_);
        return std::any_of(news.begin(), news.end(), [](const std::string& sentence) {
            return sentence.find("The disk") != std::string::npos;
        });
    };
    EXPECT_FALSE(called_slow());
    // Its thread had no time to write the first of these before the second came.
    run(1, {left_});
    local_ += 4s;
    session_ += 4s;
    run(1, {left_});
    EXPECT_FALSE(called_slow());
    local_ += 20ms;
    EXPECT_FALSE(called_slow());
}

TEST_F(IntakeChange, ACalibrationMayChangeAfterACameraCameAndWent) {
    begin_with_left();
    right_joins();
    run(2, {left_, right_});
    right_leaves();
    run(20, {left_});
    left_is_moved();
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    EXPECT_EQ(recording->segments().size(), 3u);
    EXPECT_EQ(recording->cameras().at(0).parts.back().calibration, Bytes(5));
}

// The key frame of the old setting was on its way when another one was asked for.
TEST_F(IntakeChange, AKeyFrameOfAnOldSettingBeginsNoSegment) {
    std::vector<RecordedCamera> cameras{camera(0, "left")};
    describe(cameras, true);
    run(20, {left_});
    intake_.begin_segment();
    cameras[0].depth.codec = "strata";
    const SettingId old = senders_[left_].setting, next{2};
    senders_[left_].setting = next;
    describe(cameras);
    senders_[left_].setting = old;
    senders_[left_].until_key = 0;
    run(1, {left_});
    senders_[left_].setting = next;
    senders_[left_].until_key = 0;
    run(10, {left_});
    EXPECT_EQ(lost(), 0u);
    EXPECT_EQ(numbers(recorded()->cameras().at(0).depth), count_to(31));
}

TEST_F(IntakeChange, AStalePictureDoesNotMoveTheSegment) {
    begin_with_left(600);
    right_joins();
    deliver(right_, true, session_ - 10s);  // the last picture of a camera that stands still
    run(20, {left_});
    EXPECT_EQ(lost(), 0u);
    const auto recording = recorded();
    const auto& frames = recording->cameras().at(0).depth.frames;
    ASSERT_EQ(frames.size(), 620u);
    for (std::size_t i = 1; i < frames.size(); ++i)
        EXPECT_NEAR(double(frames[i].time_us - frames[i - 1].time_us), double(spacing.count()), 2)
            << i;
}

TEST_F(IntakeChange, ATimeInTheFutureCostsNoVoice) {
    const ParticipantId anna{7};
    intake_.describe_voices({{anna, "Anna"}});
    begin_with_left(60);
    right_joins();
    deliver(right_, true, session_ + 1h);
    run(20, {left_});
    const Bytes opus(3, std::byte(0xfc));
    intake_.take_voice(anna, {0, session_, 20, false, -30, opus}, session_);
    run(60, {left_});
    EXPECT_EQ(intake_.voices().at(0).figures.left_out, 0u);
    EXPECT_EQ(intake_.voices().at(0).figures.packets, 1u);
}

TEST_F(IntakeChange, WhatIsHeldBackAtTheEndIsRecorded) {
    begin_with_left();
    right_joins();
    run(2, {left_, right_});
    const auto recording = recorded();
    EXPECT_EQ(numbers(recording->cameras().at(0).depth), count_to(22));
    EXPECT_EQ(numbers(recording->cameras().at(1).depth), count_to(2));
}

TEST_F(IntakeChange, AConnectionThatEndsKeepsWhatWasHeldBack) {
    begin_with_left();
    right_joins();
    run(2, {left_, right_});
    for (auto& [stream, sender] : senders_)
        sender = {};
    session_ = from_us(77);
    describe({camera(0, "left"), camera(1, "right")}, true);
    run(10, {left_, right_});
    const auto recording = recorded();
    EXPECT_EQ(recording->segments().size(), 3u);
    EXPECT_EQ(recording->cameras().at(0).depth.frames.size(), 32u);
    EXPECT_EQ(recording->cameras().at(1).depth.frames.size(), 12u);
}

TEST_F(IntakeChange, NoStreamWaitsForASilentOne) {
    std::vector<RecordedCamera> cameras{camera(0, "left"), camera(1, "right")};
    describe(cameras, true);
    run(20, {left_, right_});
    (void)intake_.news(local_);
    for (int i = 0; i < 10; ++i) {  // only the left one goes on
        run(10, {left_});
        (void)intake_.news(local_);
    }
    cameras[0].calibration = Bytes(5);
    describe(cameras);
    run(travel_frames + 2, {left_});
    EXPECT_EQ(lost(), 0u);
    EXPECT_GT(frames_in(recorded()->cameras().at(0).depth, 1), 0u) << "the segment has begun";
}

TEST_F(IntakeChange, VoicesHaveNoGap) {
    const ParticipantId anna{7};
    intake_.describe_voices({{anna, "Anna"}});
    describe({camera(0, "left")}, true);
    const Bytes opus(3, std::byte(0xfc));
    std::uint32_t number = 0;
    const auto speak = [&](int frames, const std::vector<StreamId>& streams) {
        for (int i = 0; i < frames; ++i) {
            run(1, streams);
            for (; clock_begin + number * 20ms < session_ - 30ms; ++number)
                intake_.take_voice(
                    anna, {number, clock_begin + number * 20ms, 20, false, -30, opus}, session_);
        }
    };
    speak(60, {left_});
    right_joins();
    speak(90, {left_, right_});
    EXPECT_EQ(intake_.voices().at(0).figures.missing, 0u);
    const auto recording = recorded();
    ASSERT_EQ(recording->segments().size(), 2u);
    std::size_t spoken = 0;
    for (const RecordedFrame& frame : recording->voices().at(0).content.frames)
        spoken += recording->read_header(frame)->codec == voice_codec;
    EXPECT_EQ(spoken, number) << "until voice_patience before the end";
}

}  // namespace
}  // namespace theatron::record
