// SPDX-License-Identifier: Apache-2.0
// Recorders of a session: no picture that reaches them is lost, whatever becomes of links and
// cameras.
#include <gmock/gmock.h>

#include "record/recording_file.h"
#include "world/acts.h"
#include "world/sent_camera.h"
#include "world/session_recorder.h"

namespace theatron::world {
namespace {

struct Stage {
    World world;
    Person& carl = world.person("Carl");
    SentCamera camera{carl, "table"};

    void begin() {
        (void)world.joined("Carl", wire::Role::publisher);
        camera.start();
        world.advance(1s);
    }
};

// The numbers of the pictures in the file, of all cameras together.
std::vector<FrameNumber> recorded(const SessionRecorder& recorder) {
    std::vector<FrameNumber> numbers;
    const auto file = record::RecordingFile::open(recorder.file());
    for (const auto& camera : file->cameras())
        for (const auto& frame : camera.depth.frames)
            numbers.push_back(frame.number);
    return numbers;
}

int gaps(const std::vector<FrameNumber>& numbers) {
    int count = 0;
    for (std::size_t i = 1; i < numbers.size(); ++i)
        count += numbers[i] != numbers[i - 1] + 1;
    return count;
}

TEST(WorldRecording, NoPictureIsMissing) {
    Stage stage;
    stage.begin();
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(5s);
    const int before = stage.camera.sent();
    stage.world.advance(20s);
    recorder.finish();
    EXPECT_GE(recorder.recorded(), std::uint64_t(stage.camera.sent() - before));
    EXPECT_TRUE(recorder.is_complete());
    const auto numbers = recorded(recorder);
    EXPECT_EQ(numbers.size(), recorder.recorded());
    EXPECT_EQ(gaps(numbers), 0);
    EXPECT_EQ(numbers.front(), 0u);  // it is the first who wants the camera
}

TEST(WorldRecording, TheOthersSeeWhoRecords) {
    Stage stage;
    stage.begin();
    {
        SessionRecorder recorder(stage.world, "Recorder");
        EXPECT_TRUE(stage.world.until([&] { return stage.carl->recordings().size() == 1; }));
        EXPECT_EQ(stage.carl->recordings().front().name, "Recorder");
    }
    EXPECT_TRUE(stage.world.until([&] { return stage.carl->recordings().empty(); }));
}

TEST(WorldRecording, ASlowLinkDelaysPicturesAndLosesNone) {
    Stage stage;
    stage.begin();
    stage.world.person("Recorder").path().loss = 0.1;
    stage.world.person("Recorder").path().delay = 200ms;
    SessionRecorder recorder(stage.world, "Recorder", "raw");  // more than the network keeps
    stage.world.advance(10s);
    for (int i = 0; i < 5; ++i) {
        recorder.path().cut();
        stage.world.advance(8s);
        recorder.path().mend();
        stage.world.advance(8s);
    }
    recorder.finish();
    const auto numbers = recorded(recorder);
    EXPECT_GT(numbers.size(), 700u);
    EXPECT_EQ(gaps(numbers), 0);
}

TEST(WorldRecording, ALinkThatBreaksCostsTheBreakAlone) {
    Stage stage;
    stage.begin();
    (void)stage.world.joined("Anna");  // for whom the camera goes on
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    recorder.path().reset();
    stage.world.advance(20s);
    recorder.finish();
    const auto numbers = recorded(recorder);
    EXPECT_EQ(gaps(numbers), 1);
    // Until it is in again: an attempt is made after a second.
    EXPECT_GT(numbers.size(), 240u);
    EXPECT_FALSE(recorder.is_complete());
}

TEST(WorldRecording, AHostThatIsStartedAgainCostsTheTimeBetweenAlone) {
    Stage stage;
    stage.begin();
    (void)stage.world.joined("Anna");
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    for (int i = 0; i < 2; ++i) {
        const auto before = recorder.recorded();
        stage.world.host().end_for_now();
        stage.world.end_host();
        stage.world.advance(90s);
        EXPECT_EQ(recorder.source().ended(), std::nullopt);
        (void)stage.world.host();
        stage.world.advance(20s);
        EXPECT_GE(recorder.recorded() - before, 95u);
    }
    EXPECT_TRUE(stage.carl.is_in());
    EXPECT_TRUE(stage.world.person("Anna").is_in());
    recorder.finish();
    EXPECT_FALSE(recorder.is_complete());
}

TEST(WorldRecording, ASessionThatIsOverEndsTheRecording) {
    Stage stage;
    stage.begin();
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    stage.world.end_host();
    EXPECT_TRUE(stage.world.until([&] { return recorder.source().ended().has_value(); }));
    EXPECT_EQ(recorder.source().ended()->lack, std::nullopt);
    EXPECT_TRUE(recorder.is_complete());
}

TEST(WorldRecording, APublisherThatBreaksAndComesBackIsRecordedOn) {
    Stage stage;
    stage.begin();
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    stage.carl.path().reset();
    stage.world.advance(10s);
    const int before = stage.camera.sent();
    stage.world.advance(10s);
    const auto after = recorder.recorded();
    stage.world.advance(10s);
    EXPECT_GE(recorder.recorded() - after, 95u);
    EXPECT_GT(stage.camera.sent(), before + 190);
    recorder.finish();
    EXPECT_EQ(recorded(recorder).size(), recorder.recorded());
    EXPECT_FALSE(recorder.is_complete()) << "what the camera would have sent meanwhile";
}

TEST(WorldRecording, NothingIsMissingOfAPublisherThatLeaves) {
    Stage stage;
    stage.begin();
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    stage.carl.leave();
    stage.world.advance(20s);
    recorder.finish();
    EXPECT_GT(recorder.recorded(), 80u);
    EXPECT_TRUE(recorder.is_complete());
}

TEST(WorldRecording, APublisherWhoseLinkIsCutAndWhoNeverComesBackIsMissing) {
    Stage stage;
    stage.begin();
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    stage.carl.path().cut();
    stage.world.advance(60s);
    recorder.finish();
    EXPECT_GT(recorder.recorded(), 80u);
    EXPECT_FALSE(recorder.is_complete());
}

TEST(WorldRecording, NothingIsMissingOfACameraThatHasEnded) {
    Stage stage;
    stage.begin();
    SessionRecorder recorder(stage.world, "Recorder");
    stage.world.advance(10s);
    stage.camera.stop();
    stage.world.advance(20s);
    recorder.finish();
    EXPECT_GT(recorder.recorded(), 80u);
    EXPECT_TRUE(recorder.is_complete());
}

TEST(WorldRecording, ACameraWhosePersonHasNotAgreedIsNotRecorded) {
    World world;
    Person& carl = world.person("Carl");
    SentCamera camera(carl, "table", false);
    (void)world.joined("Carl", wire::Role::publisher);
    camera.start();
    SessionRecorder recorder(world, "Recorder");
    world.advance(10s);
    EXPECT_EQ(recorder.source().not_agreed(), std::vector<std::string>{"table"});
    EXPECT_EQ(recorder.recorded(), 0u);
}

}  // namespace
}  // namespace theatron::world
