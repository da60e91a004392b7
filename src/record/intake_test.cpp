// SPDX-License-Identifier: Apache-2.0
#include "record/intake.h"

#include <gtest/gtest.h>

#include <numeric>

#include "record/recording_file.h"
#include "testing/temporary_folder.h"

namespace theatron::record {
namespace {

constexpr StreamId depth = depth_stream(CameraId{0});
constexpr SettingId first_setting{1}, second_setting{2};
constexpr Duration spacing = 33'333us;
constexpr TimePoint session_begin = from_us(5'000'000'000);

std::vector<RecordedCamera> cameras(const std::string& codec = "zstd:delta=1") {
    RecordedCamera camera;
    camera.name = "left";
    camera.frames_per_second = 30;
    camera.depth = {codec, 4, 3};
    return {camera};
}

// A host and its recorder: two clocks, frames in between.
class IntakeTest : public ::testing::Test {
protected:
    explicit IntakeTest() { describe(first_setting, true); }

    void describe(SettingId setting, bool new_connection,
                  const std::string& codec = "zstd:delta=1") {
        setting_ = setting;
        intake->describe(cameras(codec), {{depth, setting}}, new_connection, local);
    }

    // The next frame of the host, which carries out requests at once.
    bool send(bool key = false) {
        wire::MediaHeader header;
        header.stream = depth;
        header.setting = setting_;
        header.frame = next_;
        header.key = key || std::exchange(key_wanted_, false) || sent_.empty();
        header.reference = header.key ? next_ : next_ - 1;
        header.captured = session;
        header.payload_size = 8;
        Bytes message(wire::media_header_size + header.payload_size);
        wire::write_media_header(header, message.data());
        key_wanted_ = intake->take(header, std::make_shared<Bytes>(message), "", now());
        sent_.push_back(next_++);
        pass(spacing);
        return key_wanted_;
    }
    void pass(Duration time) {
        local += time;
        session += time;
    }
    Intake::Now now() const { return {local, {session, UtcTime(1'700'000'000s)}}; }
    // The sentences on the stream, without those on the disk.
    std::vector<std::string> news() {
        auto sentences = intake->news(local);
        std::erase_if(sentences, [](const std::string& sentence) {
            return sentence.find("camera left, depth") == std::string::npos;
        });
        return sentences;
    }
    StreamGate::Figures figures() const { return intake->streams(local).at(0).figures; }

    // The numbers in the file, once all is written.
    std::vector<FrameNumber> written() {
        intake->recorder()->finish();
        std::vector<FrameNumber> numbers;
        const auto recording = RecordingFile::open(file);
        for (const auto& frame : recording->cameras().at(0).depth.frames)
            numbers.push_back(frame.number);
        return numbers;
    }

    testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.mkv";
    std::unique_ptr<Intake> intake = std::make_unique<Intake>(file, Recorder::Options{});
    TimePoint local = from_us(1'000'000), session = session_begin;

    FrameNumber next_ = 0;

    SettingId setting_{};

private:
    bool key_wanted_ = false;
    std::vector<FrameNumber> sent_;
};

std::vector<FrameNumber> all(FrameNumber count) {
    std::vector<FrameNumber> numbers(count);
    std::iota(numbers.begin(), numbers.end(), FrameNumber(0));
    return numbers;
}

TEST_F(IntakeTest, EveryFrameIsRecordedWhateverTheClocksSay) {
    for (const Duration ahead : {Duration(0), Duration(24h), Duration(-24h)}) {
        intake = std::make_unique<Intake>(file, Recorder::Options{});
        local = session_begin + ahead;
        session = session_begin;
        next_ = 0;
        describe(first_setting, true);
        // A clock that is 200 ppm too fast gains 5.8 s in eight hours, here within 100 s.
        for (int n = 0; n < 3000; ++n) {
            send(n == 0);
            local += 8h / 5000 / 3000;
        }
        EXPECT_EQ(written(), all(3000));
        EXPECT_TRUE(intake->streams(local).at(0).complete());
    }
}

TEST_F(IntakeTest, NothingIsMadeBeforeTheFirstPicture) {
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(intake->recorder(), nullptr);
    EXPECT_FALSE(intake->streams(local).at(0).complete());
    send();
    EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(IntakeTest, ThereIsAKeyFrameAtLeastEveryTwoSeconds) {
    int since_key = 0, longest = 0;
    for (int n = 0; n < 600; ++n) {
        since_key = send() ? 0 : since_key + 1;
        longest = std::max(longest, since_key);
    }
    EXPECT_LT(longest * spacing, Duration(2s));
    EXPECT_GT(longest * spacing, Duration(1s)) << "key frames are large";
}

TEST_F(IntakeTest, WhatDoesNotFitTheBufferIsCountedAndFollowedByAKeyFrame) {
    intake = std::make_unique<Intake>(file, Recorder::Options{.buffer_bytes = 1});
    describe(first_setting, true);
    EXPECT_TRUE(send()) << "a key frame is asked for at once";
    EXPECT_EQ(figures().dropped, 1u);
    EXPECT_EQ(figures().recorded, 0u);
    const auto said = news();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("Missing: 1 picture"), std::string::npos) << said[0];
}

TEST_F(IntakeTest, ANewConnectionBeginsASegmentOfItsOwnClock) {
    for (int n = 0; n < 10; ++n)
        send();
    session = from_us(77);  // the host's machine was started again
    next_ = 0;
    describe(first_setting, true);
    send();
    EXPECT_EQ(figures().recorded, 10u) << "a segment begins with a key frame";
    for (int n = 0; n < 10; ++n)
        send(n == 0);
    EXPECT_EQ(figures().recorded, 20u);
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 1u);
    intake->recorder()->finish();
    EXPECT_EQ(intake->recorder()->figures().segments, 2u);
    EXPECT_LT(intake->recorder()->figures().duration, Duration(1s)) << "not the clocks' distance";
}

TEST_F(IntakeTest, ACameraThatLeavesWhileTheConnectionIsLostIsInterrupted) {
    for (int n = 0; n < 10; ++n)
        send(n == 0);
    // It left during the break, and others are there.
    intake->describe({}, {}, true, local);
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 1u);
    EXPECT_FALSE(intake->streams(local).at(0).complete());
    // It was away before the next break.
    intake->describe({}, {}, true, local);
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 1u);
}

TEST_F(IntakeTest, ACameraThatLeftBeforeTheConnectionWasLostIsNotInterrupted) {
    for (int n = 0; n < 10; ++n)
        send(n == 0);
    intake->describe({}, {}, false, local);
    intake->describe({}, {}, true, local);
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 0u);
}

TEST_F(IntakeTest, OtherCodecsBeginASegmentWithoutLoss) {
    for (int n = 0; n < 10; ++n)
        send();
    describe(second_setting, false, "strata");
    for (int n = 0; n < 10; ++n)
        send(n == 0);
    describe(first_setting, false, "strata");  // only another number
    for (int n = 0; n < 10; ++n)
        send(n == 0);
    EXPECT_TRUE(intake->streams(local).at(0).complete());
    EXPECT_EQ(figures().recorded, 30u);
    intake->recorder()->finish();
    EXPECT_EQ(intake->recorder()->figures().segments, 2u);
}

TEST_F(IntakeTest, AFrameOfTheOldSettingGoesIntoTheOldSegment) {
    send();
    describe(second_setting, false, "strata");
    setting_ = first_setting;  // it was on its way
    send();
    setting_ = second_setting;
    send(true);
    EXPECT_EQ(figures().recorded, 3u);
    EXPECT_EQ(figures().lost, 0u);
}

TEST_F(IntakeTest, ASilentStreamIsSaidWithinTwoSeconds) {
    send();
    EXPECT_TRUE(news().empty());
    std::vector<std::string> said;
    Duration silent{};
    for (; said.empty() && silent < 10s; silent += 100ms) {
        pass(100ms);
        said = news();
    }
    EXPECT_LE(silent, Duration(2s));
    EXPECT_EQ(said.size(), 1u);
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 1u);
    pass(100ms);
    EXPECT_TRUE(news().empty()) << "once";
    send();
    EXPECT_EQ(news().size(), 1u) << "it comes again";
    EXPECT_FALSE(intake->streams(local).at(0).complete());
}

TEST_F(IntakeTest, LatePicturesAndACameraThatHasEndedAreNotMissing) {
    send();
    EXPECT_TRUE(news().empty());
    local += 5s;
    EXPECT_TRUE(news().empty()) << "the recorder itself was held up";
    local += 100ms;
    send();
    intake->on_end(CameraId{0});
    local += 60s;
    EXPECT_TRUE(intake->streams(local).at(0).complete());
}

TEST_F(IntakeTest, WhatACameraWouldHaveSentWhoseWayBrokeIsMissing) {
    send();
    intake->on_interruption(CameraId{0});
    intake->on_end(CameraId{0});
    intake->on_interruption(CameraId{0});
    EXPECT_TRUE(news().empty());
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 1u);
    local += 60s;
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 1u) << "once";
    EXPECT_FALSE(intake->streams(local).at(0).complete());
}

TEST_F(IntakeTest, NothingIsMissingOfACameraWhoseWayBrokeBeforeItsFirstPicture) {
    describe(first_setting, true);
    intake->on_interruption(CameraId{0});
    EXPECT_EQ(intake->streams(local).at(0).interruptions, 0u);
}

TEST_F(IntakeTest, WhatCannotBeCreatedIsAProblemAndNoException) {
    intake = std::make_unique<Intake>(folder.path() / "none" / "a.mkv", Recorder::Options{});
    describe(first_setting, true);
    send();
    EXPECT_NE(intake->problem().find("Cannot create"), std::string::npos) << intake->problem();
    EXPECT_EQ(intake->recorder(), nullptr);
}

TEST_F(IntakeTest, AFileThatIsGoneFromItsNameCostsNoPicture) {
    for (int n = 0; n < 10; ++n)
        send();
    intake->begin_segment();
    EXPECT_TRUE(send()) << "a key frame is asked for";
    for (int n = 0; n < 10; ++n)
        send();
    EXPECT_EQ(written(), all(21));
    EXPECT_EQ(figures().lost, 0u);
    EXPECT_EQ(intake->recorder()->figures().segments, 2u);
}

// As when somebody nudges a camera: its streams and their settings stay.
TEST_F(IntakeTest, ACameraThatStandsElsewhereBeginsASegment) {
    send();
    send();
    std::vector<RecordedCamera> moved = cameras();
    moved[0].calibration = Bytes(5);
    intake->describe(moved, {{depth, first_setting}}, false, local);
    for (int i = 0; i < 3; ++i)
        send();
    EXPECT_EQ(figures().lost, 0u);
    EXPECT_EQ(written().size(), 5u);
    const auto recording = RecordingFile::open(file);
    ASSERT_EQ(recording->segments().size(), 2u);
    EXPECT_EQ(recording->cameras().at(0).parts.at(1).calibration, Bytes(5));
}

}  // namespace
}  // namespace theatron::record
