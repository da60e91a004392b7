// SPDX-License-Identifier: Apache-2.0
// How recordings are written, and how they end.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "base/error.h"
#include "record/remarks.h"
#include "record/test_recordings.h"
#include "testing/full_disk.h"

namespace theatron::record {
namespace {

TEST(Recorder, ASegmentBeginsWithTheNextMessageInAFileOfItsOwn) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "chain.mkv";
    const auto messages = generated(2, 8, 100);
    {
        // Another recording's: it stays.
        std::ofstream(folder.path() / "chain.002.mkv") << "not ours";
        Recorder recorder(path, cameras(2), session_begin);
        for (const Message& m : messages)
            ASSERT_EQ(add(recorder, m), Recorder::Added::taken);
        recorder.begin_segment(cameras(7), session_begin);  // nothing comes
        recorder.begin_segment(cameras(1), session_begin);
        EXPECT_EQ(add(recorder, messages.back()), Recorder::Added::not_recorded);
        EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::taken);
        recorder.finish();
        EXPECT_EQ(recorder.figures().problem, "");
        EXPECT_EQ(recorder.figures().segments, 2u);
        EXPECT_EQ(recorder.figures().frames, messages.size() + 1);
    }
    EXPECT_EQ(bytes_of(folder.path() / "chain.002.mkv").size(), 8u);
    EXPECT_EQ(RecordingFile::open(path)->cameras().size(), 2u);
    EXPECT_EQ(RecordingFile::open(folder.path() / "chain.003.mkv")->cameras().size(), 1u);
}

TEST(Recorder, WithoutANameForAnotherFileGoesOnInTheLastOne) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "long.mkv";
    for (std::uint32_t number = 2; number <= max_segments; ++number)
        std::ofstream(segment_path(path, number)) << "";
    const auto messages = generated(2, 8, 100);
    Recorder recorder(path, cameras(1), session_begin);
    EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::taken);
    recorder.begin_segment(cameras(2), session_begin);
    std::size_t of_first = 1, of_second = 0;
    for (const Message& m : messages) {
        const bool is_first = camera_of(m.header.stream) == CameraId{0};
        (is_first ? of_first : of_second) += 1;
        EXPECT_EQ(add(recorder, m), Recorder::Added::taken);
    }
    recorder.finish();
    const Recorder::Figures figures = recorder.figures();
    EXPECT_EQ(figures.problem, "");
    EXPECT_TRUE(figures.is_in_last_file);
    EXPECT_EQ(figures.segments, 1u);
    EXPECT_EQ(figures.frames, of_first);
    EXPECT_EQ(figures.dropped, of_second);
    EXPECT_EQ(RecordingFile::open(path)->cameras().size(), 1u);
}

TEST(Recorder, TellsWhatItHadToDropOfWhichStream) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(1, 8, 10'000);
    Recorder recorder(folder.path() / "small.mkv", cameras(1), session_begin, {.buffer_bytes = 0});
    for (const Message& m : messages)
        EXPECT_EQ(add(recorder, m), Recorder::Added::dropped);
    recorder.finish();
    EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::ended);
    const Recorder::Figures figures = recorder.figures();
    EXPECT_EQ(figures.dropped, messages.size());
    EXPECT_EQ(figures.dropped_of.at(depth_stream(CameraId(0))), messages.size() / 2);
    EXPECT_EQ(figures.frames, 0u);
}

TEST(Recording, APicturesPlaceDependsOnWhatItSaysOnlyWhereThatIsCredible) {
    const TimePoint begin = from_us(7'000'000), arrived = begin + 100s;
    EXPECT_EQ(block_time_us(arrived - 5s, arrived, begin), 95'000'000);
    EXPECT_EQ(block_time_us(arrived - max_picture_age, arrived, begin), 40'000'000);
    EXPECT_EQ(block_time_us(arrived + max_picture_lead, arrived, begin), 101'000'000);
    for (const std::int64_t odd :
         {-(std::int64_t(1) << 62), std::int64_t(1) << 62, std::int64_t(0), to_us(arrived + 2s)})
        EXPECT_EQ(block_time_us(from_us(odd), arrived, begin), 100'000'000) << odd;
    EXPECT_EQ(block_time_us(begin - 1s, begin, begin), 0);
    EXPECT_EQ(block_time_us(arrived, from_us(INT64_MAX), from_us(INT64_MIN)), 1LL << 52);
    EXPECT_EQ(block_time_us(arrived, from_us(INT64_MIN), from_us(INT64_MAX)), 0);
}

TEST(Recording, KilledWhileRecordingLosesAtMostTheLastSecond) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "killed.mkv";
    int pipe_ends[2];
    ASSERT_EQ(pipe(pipe_ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        // Two cameras at a hundred frames a second, until the end.
        Recorder recorder(path, cameras(2), session_begin);
        for (FrameNumber n = 0;; ++n) {
            for (int c = 0; c < 2; ++c) {
                const Message m = message(depth_stream(CameraId(c)), n, n * 10ms, 20'000, n);
                (void)add(recorder, m);
            }
            if (write(pipe_ends[1], &n, sizeof(n)) < 0)
                _exit(1);
            // At the cameras' rate: the loss that is allowed is a time of the clock.
            std::this_thread::sleep_for(10ms);
        }
    }
    FrameNumber last = 0;
    while (last < 150)
        ASSERT_EQ(read(pipe_ends[0], &last, sizeof(last)), ssize_t(sizeof(last)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);

    const auto recording = RecordingFile::open(path);
    EXPECT_FALSE(recording->complete());
    for (const CameraContent& camera : recording->cameras()) {
        const auto& frames = camera.depth.frames;
        ASSERT_FALSE(frames.empty());
        EXPECT_GE(frames.back().number + 100, last);
        EXPECT_EQ(frames.size(), frames.back().number + 1u) << "there are gaps";
    }
}

TEST(Recording, AFullDiskEndsItWithASentenceAndKeepsWhatCameBefore) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "full.mkv";
    const auto messages = generated(1, 90, 10'000);
    {
        const testing::FullDisk disk(500'000);
        std::signal(SIGXFSZ, SIG_DFL);  // the writing thread blocks it
        Recorder recorder(path, cameras(1), session_begin);
        // The first thirty have room, all of them do not.
        for (const std::size_t end : {30, 90}) {
            for (std::size_t i = end == 30 ? 0 : 30; i < end; ++i)
                EXPECT_EQ(add(recorder, messages[i]), Recorder::Added::taken);
            wait_until_written(recorder, end);
        }
        EXPECT_EQ(recorder.figures().frames, 30u);
        recorder.finish();
        const auto figures = recorder.figures();
        EXPECT_NE(figures.problem.find("ends here; what came before is kept"), std::string::npos)
            << figures.problem;
        EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::ended);
        EXPECT_EQ(figures.bytes, fs::file_size(path));
        EXPECT_LE(figures.bytes, 500'000u);
    }
    const auto recording = RecordingFile::open(path);
    EXPECT_TRUE(recording->segments()[0].closed);
    EXPECT_FALSE(recording->complete());
    EXPECT_TRUE(recording->intact());
    EXPECT_EQ(remarks_on(recording->segments()[0]),
              std::vector<std::string>{"it stopped early: the system allowed no larger file"});
    EXPECT_GT(frames_in(*recording), 10u);
    EXPECT_EQ(count_equal(*recording, messages), frames_in(*recording));
}

TEST(Recording, NotesInItsFileWhatItLacks) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(1, 30, 1'000);
    const Lacks all{Lack::camera_failed, Lack::cut,       Lack::end,
                    Lack::files,         Lack::host_gone, Lack::index,
                    Lack::pictures,      Lack::refused,   Lack::voices};
    EXPECT_EQ(lacks_of_letters(letters_of(all) + "?Z"), all);
    for (const Lacks& lacks : {Lacks{}, Lacks{Lack::refused, Lack::end}, all}) {
        const fs::path path = folder.path() / ("a" + letters_of(lacks) + ".mkv");
        {
            Recorder recorder(path, cameras(1), session_begin);
            for (const auto& one : messages)
                EXPECT_EQ(add(recorder, one), Recorder::Added::taken);
            recorder.finish();
            recorder.note_lacks(lacks);
        }
        const auto recording = RecordingFile::open(path);
        const Segment& segment = recording->segments()[0];
        EXPECT_EQ(recording->complete(), lacks.empty());
        EXPECT_TRUE(recording->intact());
        EXPECT_EQ(segment.lacks, lacks);
        EXPECT_EQ(remarks_on(segment).empty(), lacks.empty());
        EXPECT_EQ(count_equal(*recording, messages), messages.size());
    }
    const auto recording = RecordingFile::open(folder.path() / "aer.mkv");
    EXPECT_EQ(lacks_of(recording->segments()[0]),
              "it is not complete: the last pictures before its end did not come from the host, "
              "the host refused its recorder");
}

// A publisher's clock is estimated, so the time of a picture that is sent again may differ.
TEST(Recording, APictureThatIsSentAgainStaysBehindTheFirst) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "a.mkv";
    const StreamId depth = depth_stream(CameraId(0));
    {
        Recorder recorder(path, cameras(1), session_begin);
        for (const auto& [number, time, reference] :
             {std::tuple(0, 40ms + 0us, 0), {1, 40ms - 1us, 1}, {2, 70ms + 0us, 1}})
            EXPECT_EQ(add(recorder,
                          message(depth, FrameNumber(number), time, 500, FrameNumber(reference))),
                      Recorder::Added::taken);
        recorder.finish();
    }
    std::vector<FrameNumber> numbers;
    const auto recording = RecordingFile::open(path);
    for (const RecordedFrame& frame : recording->cameras().at(0).depth.frames)
        numbers.push_back(frame.number);
    EXPECT_EQ(numbers, (std::vector<FrameNumber>{0, 1, 2}));
}

TEST(Recording, ADiskThatIsFullAtTheBeginningLeavesNoFile) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "full.mkv";
    const testing::FullDisk disk(100);
    try {
        Recorder recorder(path, cameras(1), session_begin);
        FAIL() << "the head does not fit";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("cannot begin"), std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST(Recorder, NeverTakesAFileFromAnotherRecorderOrAPlayer) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "one.mkv";
    const auto refused = [&](const Recorder::Options& options) -> std::string {
        try {
            Recorder second(path, cameras(1), session_begin, options);
        } catch (const Error& problem) {
            return problem.what();
        }
        return "";
    };
    const std::string in_use =
        "'" + path.string() +
        "' is being recorded or played; name another file, or end that first.";
    Bytes whole;
    {
        Recorder first(path, cameras(1), session_begin);
        EXPECT_EQ(refused({}), in_use);
        for (const Message& m : generated(1, 3, 100))
            ASSERT_EQ(add(first, m), Recorder::Added::taken);
        first.finish();
    }
    whole = bytes_of(path);
    {
        const auto playing = RecordingFile::open(path);
        EXPECT_EQ(refused({}), in_use);
    }
    // It came into being after whoever asked had looked.
    EXPECT_EQ(refused({.replace = false}),
              "'" + path.string() + "' exists already; name another file, or give --overwrite.");
    EXPECT_EQ(bytes_of(path), whole);
    EXPECT_EQ(refused({}), "") << "nobody uses it any more";
}

TEST(Recording, WhereNoFileCanBeIsOneSentence) {
    try {
        Recorder recorder("/nowhere/at/all.mkv", cameras(1), session_begin);
        FAIL();
    } catch (const Error& problem) {
        EXPECT_STREQ(problem.what(),
                     "Cannot create '/nowhere/at/all.mkv': No such file or directory.");
    }
}

TEST(Recorder, RefusesANameOfAnotherFormat) {
    EXPECT_EQ(name_problem("visit/x.MP4"),
              "A recording is a Matroska file, which 'x.MP4' does not say; name it 'x.mkv'.");
    for (const char* good : {"x.mkv", "x", "x.2026", "mp4"})
        EXPECT_EQ(name_problem(good), "") << good;
}

TEST(Recorder, RefusesANameThatLaterSegmentsCouldNotHave) {
    const testing::TemporaryFolder folder;
    const auto named = [&](std::size_t bytes) {
        return folder.path() / (std::string(bytes - 4, 'n') + ".mkv");
    };
    EXPECT_EQ(name_problem(named(250)), "");
    EXPECT_THROW(Recorder(named(251), cameras(1), session_begin), Error);
    EXPECT_TRUE(fs::is_empty(folder.path()));
    Recorder recorder(named(250), cameras(1), session_begin);
    const Message m = generated(1, 4, 100)[0];
    for (int segment = 0; segment < 2; ++segment) {
        EXPECT_EQ(add(recorder, m), Recorder::Added::taken);
        recorder.begin_segment(cameras(1), session_begin);
    }
    recorder.finish();
    EXPECT_EQ(recorder.figures().problem, "");
    EXPECT_EQ(recorder.figures().segments, 2u);
}

TEST(Recorder, NoticesThatItsFileIsCutAndGoesOn) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "a.mkv";
    const auto messages = generated(1, 60, 500);
    const std::size_t half = messages.size() / 2;
    Recorder recorder(path, cameras(1), session_begin);
    for (std::size_t i = 0; i < half; ++i)
        ASSERT_EQ(add(recorder, messages[i]), Recorder::Added::taken);
    wait_until_written(recorder, half);
    EXPECT_EQ(recorder.figures().cut_bytes, 0u);
    const auto size = fs::file_size(path);
    fs::resize_file(path, size / 2);
    for (std::size_t i = half; i < messages.size(); ++i)
        ASSERT_EQ(add(recorder, messages[i]), Recorder::Added::taken);
    recorder.finish();
    EXPECT_EQ(recorder.figures().cut_bytes, size - size / 2);
    const auto recording = RecordingFile::open(path);
    EXPECT_GE(frames_in(*recording), messages.size() - half);
    EXPECT_EQ(recording->segments()[0].damaged_places, 1u);
}

}  // namespace
}  // namespace theatron::record
