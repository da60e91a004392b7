// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "base/error.h"
#include "record/crc32c.h"
#include "record/matroska_reader.h"
#include "record/recorder.h"
#include "record/recording_file.h"
#include "testing/temporary_folder.h"

namespace theatron::record {
namespace {

namespace fs = std::filesystem;

const ClockPair session_begin{from_us(5'000'000'017), UtcTime(1'700'000'000s)};

struct Message {
    wire::MediaHeader header;
    std::shared_ptr<const Bytes> bytes;
};

// A message with `size` bytes that depend on its stream and number.
Message message(StreamId stream, FrameNumber frame, Duration at, std::size_t size,
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

// Arrives ten milliseconds after its exposure.
Recorder::Added add(Recorder& recorder, const Message& m, const std::string& filters = {}) {
    return recorder.add(m.header, m.bytes, m.header.captured + 10ms, filters);
}

std::vector<RecordedCamera> cameras(int count) {
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
std::vector<Message> generated(int camera_count, int frames, std::size_t size) {
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

void record_all(const fs::path& path, int camera_count, const std::vector<Message>& messages) {
    Recorder recorder(path, cameras(camera_count), session_begin);
    for (const Message& m : messages)
        ASSERT_EQ(add(recorder, m), Recorder::Added::taken);
    recorder.finish();
    EXPECT_EQ(recorder.figures().problem, "");
    EXPECT_EQ(recorder.figures().frames, messages.size());
    EXPECT_EQ(recorder.figures().dropped, 0u);
    EXPECT_EQ(recorder.figures().bytes, fs::file_size(path));
}

Bytes bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const ByteView view = as_bytes(text);
    return Bytes(view.begin(), view.end());
}

// The frames of a recording, in the order of `messages`, and whether each is as it was.
std::size_t count_equal(const RecordingFile& recording, const std::vector<Message>& messages) {
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

std::size_t frames_in(const RecordingFile& recording) {
    std::size_t count = 0;
    for (const CameraContent& camera : recording.cameras())
        count += camera.depth.frames.size() + camera.color.frames.size();
    return count;
}

TEST(Recording, TellsWhichFiltersDepthWentThroughAndWhereTheyChanged) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "filtered.mkv";
    const auto messages = generated(2, 12, 100);
    {
        Recorder recorder(path, cameras(2), session_begin);
        for (const Message& m : messages) {
            const bool first = camera_of(m.header.stream) == CameraId(0);
            const char* filters = m.header.frame < 3   ? ""
                                  : m.header.frame < 5 ? "holes+kalman"
                                                       : "range:max_mm=900";
            ASSERT_EQ(add(recorder, m, first ? filters : ""), Recorder::Added::taken);
        }
    }
    const auto recording = RecordingFile::open(path);
    EXPECT_EQ(recording->refused(), 0u);
    EXPECT_EQ(count_equal(*recording, messages), messages.size());
    const auto& depth = recording->cameras()[0].depth;
    ASSERT_EQ(depth.filters.size(), 2u);
    EXPECT_EQ(depth.filters[0].filters, "holes+kalman");
    EXPECT_EQ(depth.frames[depth.filters[0].frame].number, 3u);
    EXPECT_EQ(depth.filters[1].filters, "range:max_mm=900");
    EXPECT_EQ(depth.frames[depth.filters[1].frame].number, 5u);
    EXPECT_TRUE(recording->cameras()[0].color.filters.empty());
    EXPECT_TRUE(recording->cameras()[1].depth.filters.empty());
}

TEST(Recording, TellsWhenFiltersEnd) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "ends.mkv";
    {
        Recorder recorder(path, cameras(1), session_begin);
        for (const Message& m : generated(1, 4, 100))
            ASSERT_EQ(add(recorder, m, m.header.frame < 1 ? "kalman" : ""), Recorder::Added::taken);
    }
    const std::vector<FilterChange> expected{{0, "kalman"}, {1, ""}};
    const auto recording = RecordingFile::open(path);
    const auto& filters = recording->cameras()[0].depth.filters;
    ASSERT_EQ(filters.size(), expected.size());
    EXPECT_EQ(filters, expected);
}

TEST(Recording, GivesBackWhatWasRecordedToTheByteAndMicrosecond) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(4, 90, 2000);
    record_all(folder.path() / "four.mkv", 4, messages);

    const auto recording = RecordingFile::open(folder.path() / "four.mkv");
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(recording->refused(), 0u);
    ASSERT_EQ(recording->cameras().size(), 4u);
    const CameraContent& camera = recording->cameras()[2];
    EXPECT_EQ(camera.name, "camera 2");
    EXPECT_EQ(camera.frames_per_second, 30);
    EXPECT_EQ(camera.calibration, Bytes(100, std::byte{2}));
    EXPECT_EQ(camera.depth.codec, "zstd:delta=1,layers=3");
    EXPECT_EQ(camera.depth.width, 640);
    EXPECT_EQ(camera.color.codec, "jpeg");
    EXPECT_EQ(camera.color.height, 720);
    EXPECT_EQ(frames_in(*recording), messages.size());
    EXPECT_EQ(count_equal(*recording, messages), messages.size());
}

TEST(Recording, AClustersBytesAreAsSpecified) {
    const testing::TemporaryFolder folder;
    const Message plain = message(StreamId(0), 0, 0s, 3, 0);
    Bytes bytes = *plain.bytes;
    bytes[64] = std::byte{0xaa};
    bytes[65] = std::byte{0xbb};
    bytes[66] = std::byte{0xcc};
    record_all(folder.path() / "one.mkv", 1,
               {{plain.header, std::make_shared<const Bytes>(bytes)}});

    Bytes expected;
    const auto put = [&](std::initializer_list<int> values) {
        for (const int b : values)
            expected.push_back(std::byte(b));
    };
    put({0x1f, 0x43, 0xb6, 0x75, 0xe7, 0xe7, 0x81, 0x00, 0xa0, 0xe2, 0xa1, 0x87, 0x81, 0x00, 0x00,
         0x00, 0xaa, 0xbb, 0xcc, 0x75, 0xa1, 0xd6, 0xa6, 0xc5, 0xee, 0x81, 0x02, 0xa5, 0xc0});
    expected.insert(expected.end(), bytes.begin(), bytes.begin() + 64);
    put({0xa6, 0x8d, 0xee, 0x81, 0x04, 0xa5, 0x88});
    Bytes place(12);  // track 1, time 0
    place[0] = std::byte{1};
    place.insert(place.end(), bytes.begin(), bytes.begin() + 64);
    ByteWriter(expected).put(crc32c_reference(place));
    ByteWriter(expected).put(crc32c_reference(ByteView(bytes).subspan(64)));
    const Bytes file = bytes_of(folder.path() / "one.mkv");
    EXPECT_NE(std::search(file.begin(), file.end(), expected.begin(), expected.end()), file.end());
}

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

TEST(Recording, WithoutAnyFrameOpensToo) {
    const testing::TemporaryFolder folder;
    record_all(folder.path() / "none.mkv", 1, {});
    const auto recording = RecordingFile::open(folder.path() / "none.mkv");
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(frames_in(*recording), 0u);
}

// Returns when `recorder` has written so many frames or has ended.
void wait_until_written(const Recorder& recorder, std::uint64_t frames) {
    while (recorder.figures().frames < frames && recorder.figures().problem.empty())
        std::this_thread::sleep_for(1ms);
}

TEST(Recording, AFrameFromBeforeTheFirstKeepsItsTime) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "early.mkv";
    std::vector<Message> messages;
    messages.push_back(message(StreamId(0), 5, 1s, 10, 5));
    {
        Recorder recorder(path, cameras(1), session_begin);
        EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::taken);
        wait_until_written(recorder, 1);
        messages.push_back(message(StreamId(0), 4, 0s, 10, 4));
        EXPECT_EQ(add(recorder, messages[1]), Recorder::Added::taken);
    }
    EXPECT_EQ(count_equal(*RecordingFile::open(path), messages), 2u);
}

// Cut off anywhere, a file holds the clusters that are whole, and says that it was cut.
TEST(Recording, CutOffAnywhereOpensUpToTheLastWholeCluster) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(2, 12, 60);
    record_all(folder.path() / "whole.mkv", 2, messages);
    const Bytes whole = bytes_of(folder.path() / "whole.mkv");

    std::size_t before = 0;
    std::set<std::size_t> counts;
    std::size_t opened = 0;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        // Of exact size: the sanitizer sees any read past the end.
        const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(n));
        const auto recording = RecordingFile::read(std::make_unique<MemorySource>(part));
        if (!recording) {
            EXPECT_EQ(opened, 0u) << "opens shorter, but not at " << n;
            continue;
        }
        ++opened;
        EXPECT_FALSE((*recording)->complete());
        EXPECT_EQ((*recording)->refused(), 0u);
        const std::size_t count = frames_in(**recording);
        EXPECT_GE(count, before) << n;
        EXPECT_EQ(count_equal(**recording, messages), count) << n;
        before = count;
        counts.insert(count);
    }
    EXPECT_EQ(before, messages.size());
    EXPECT_GE(counts.size(), 5u) << "there are too few clusters";
    EXPECT_GT(opened, whole.size() / 2);
}

TEST(Recording, DamagedAnywhereNeverBreaksTheReader) {
    const testing::TemporaryFolder folder;
    record_all(folder.path() / "whole.mkv", 2, generated(2, 6, 60));
    const Bytes whole = bytes_of(folder.path() / "whole.mkv");
    std::minstd_rand random(3);
    Bytes payload;
    for (int i = 0; i < 20'000; ++i) {
        Bytes damaged = whole;
        for (unsigned k = 0; k <= random() % 4; ++k)
            damaged[random() % damaged.size()] = std::byte(random() >> 16);
        const auto recording = RecordingFile::read(std::make_unique<MemorySource>(damaged));
        if (!recording)
            continue;
        for (const CameraContent& camera : (*recording)->cameras())
            for (const RecordedFrame& frame : camera.depth.frames)
                ASSERT_NE((*recording)->read_payload(frame, payload), Status::truncated);
    }
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
            // The cameras' pace: what may be lost is counted in seconds of the clock.
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

// Stands for a full disk: the system lets the file grow to this size only.
class SizeLimit {
public:
    explicit SizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

private:
    rlimit before_;
};

TEST(Recording, AFullDiskEndsItWithASentenceAndKeepsWhatCameBefore) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "full.mkv";
    const auto messages = generated(1, 90, 10'000);
    {
        const SizeLimit limit(500'000);
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
    EXPECT_TRUE(recording->complete()) << "it was closed, if early";
    EXPECT_GT(frames_in(*recording), 10u);
    EXPECT_EQ(count_equal(*recording, messages), frames_in(*recording));
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

TEST(Recording, ALastSegmentThatCannotBeReadIsMissing) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "chain.mkv";
    {
        Recorder recorder(path, cameras(1), session_begin);
        const auto messages = generated(1, 4, 100);
        EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::taken);
        recorder.begin_segment(cameras(1), session_begin);
        EXPECT_EQ(add(recorder, messages[0]), Recorder::Added::taken);
    }
    const fs::path second = folder.path() / "chain.002.mkv";
    EXPECT_TRUE(RecordingFile::open(path)->complete());
    const auto size = fs::file_size(second);
    std::ofstream(second, std::ios::trunc) << std::string(size, '\0');
    EXPECT_EQ(RecordingFile::open(path)->missing_segments(), 1u);
    EXPECT_FALSE(RecordingFile::open(path)->complete());
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

TEST(Recording, OtherFilesAreRefusedWithOneSentence) {
    const testing::TemporaryFolder folder;
    const auto sentence = [&](std::string_view content) {
        const fs::path path = folder.path() / "x";
        std::ofstream(path, std::ios::binary)
            .write(content.data(), std::streamsize(content.size()));
        try {
            (void)RecordingFile::open(path);
        } catch (const Error& problem) {
            return std::string(problem.what()).substr(path.string().size() + 2);
        }
        return std::string("opened");
    };
    EXPECT_EQ(sentence(""), " ends before its first frame.");
    EXPECT_EQ(sentence("RIFF....AVI LIST"), " is not a recording: it is no Matroska file.");
}

}  // namespace
}  // namespace theatron::record
