// SPDX-License-Identifier: Apache-2.0
// Reading gives the recorded frames, also from files that are cut off or damaged.
#include <set>

#include "base/error.h"
#include "record/crc32c.h"
#include "record/matroska_reader.h"
#include "record/remarks.h"
#include "record/segment_writer.h"
#include "record/test_recordings.h"

namespace theatron::record {
namespace {

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
    EXPECT_EQ(std::filesystem::status(folder.path() / "four.mkv").permissions(),
              std::filesystem::perms(0600));
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

// They are in no checksum.
TEST(Recording, DamagedFlagsOfABlockCostNothing) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(1, 12, 60);
    record_all(folder.path() / "a.mkv", 1, messages);
    Bytes bytes = bytes_of(folder.path() / "a.mkv");
    MemorySource source{ByteView(bytes)};
    std::vector<std::uint64_t> flags;
    (void)read_clusters(source, *read_head(source),
                        [&](const FoundBlock& b) { flags.push_back(b.payload_at - 1); });
    for (const std::uint64_t at : flags)
        bytes[at] = std::byte{0xff};
    const auto recording = RecordingFile::read(std::make_unique<MemorySource>(bytes));
    EXPECT_EQ(count_equal(**recording, messages), messages.size());
}

TEST(Recording, WithoutAnyFrameOpensToo) {
    const testing::TemporaryFolder folder;
    record_all(folder.path() / "none.mkv", 1, {});
    const auto recording = RecordingFile::open(folder.path() / "none.mkv");
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(frames_in(*recording), 0u);
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
        // A copy of exact size: the sanitizer sees any read past the end.
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

TEST(Recording, WhoseEndIsCutSaysHowMuchMayBeMissing) {
    const testing::TemporaryFolder folder;
    record_all(folder.path() / "whole.mkv", 1, generated(1, 300, 200));
    Bytes bytes = bytes_of(folder.path() / "whole.mkv");
    const auto opened = [&] {
        return std::move(*RecordingFile::read(std::make_unique<MemorySource>(bytes)));
    };
    const Duration whole = opened()->duration();
    EXPECT_EQ(end_of(opened()->segments()[0]), "");
    bytes.resize(bytes.size() - 100);  // the last copy of the head
    EXPECT_EQ(end_of(opened()->segments()[0]), "it was not closed: only its index is missing");
    bytes.resize(bytes.size() / 2);
    const auto half = opened();
    EXPECT_FALSE(half->complete());
    EXPECT_EQ(half->segments()[0].missing_end, whole - half->duration());
    EXPECT_GT(whole - half->duration(), 3s);
    EXPECT_NE(end_of(half->segments()[0]).find(" s may be missing"), std::string::npos);
}

// The size that the file claims is in no checksum.
TEST(Recording, WithADamagedSizeIsStillSeenToBeClosed) {
    const testing::TemporaryFolder folder;
    record_all(folder.path() / "whole.mkv", 1, generated(1, 30, 200));
    const Bytes whole = bytes_of(folder.path() / "whole.mkv");
    const ByteView id = as_bytes(std::string_view("\x18\x53\x80\x67"));
    const auto segment = std::search(whole.begin(), whole.end(), id.begin(), id.end());
    for (std::ptrdiff_t bit = 0; bit < 12 * 8; ++bit) {
        Bytes damaged = whole;
        damaged[std::size_t(segment - whole.begin() + bit / 8)] ^= std::byte(1 << bit % 8);
        const auto recording = RecordingFile::read(std::make_unique<MemorySource>(damaged));
        ASSERT_TRUE(recording) << bit;
        EXPECT_TRUE((*recording)->segments()[0].closed) << bit;
        EXPECT_EQ(frames_in(**recording),
                  frames_in(*RecordingFile::open(folder.path() / "whole.mkv")));
    }
}

// Its recorder was killed, and then its end was cut.
TEST(Recording, ThatWasNeverClosedKnowsWhatWasOnTheDisk) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "a.mkv";
    const auto messages = generated(1, 300, 200);
    SegmentWriter writer(path, {.cameras = cameras(1)}, {.clock = session_begin});
    for (const Message& m : messages)
        ASSERT_EQ(
            writer.write(std::vector{RecordedMessage{m.header, m.bytes, "", m.header.captured}}),
            "");
    ASSERT_EQ(writer.sync(), "");
    const auto killed = RecordingFile::open(path);
    EXPECT_FALSE(killed->segments()[0].closed);
    EXPECT_EQ(end_of(killed->segments()[0]), "it was not closed: 1.0 s may be missing");
    fs::resize_file(path, fs::file_size(path) / 2);
    const auto cut = RecordingFile::open(path);
    EXPECT_EQ(cut->segments()[0].missing_end, killed->duration() - cut->duration() + 1s);
}

// A copy in which the byte `at` is "removed" or "changed", or another one "inserted" before it.
Bytes with_one_byte(std::string_view change, std::ptrdiff_t at, Bytes bytes) {
    if (change == "removed")
        bytes.erase(bytes.begin() + at);
    else if (change == "inserted")
        bytes.insert(bytes.begin() + at, std::byte{0x55});
    else
        bytes[std::size_t(at)] ^= std::byte{0x55};
    return bytes;
}

// One byte removed, inserted or changed near the end of a closed file.
TEST(Recording, WithAWrongByteNearItsEndNeverHidesALostPicture) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(2, 24, 60);
    record_all(folder.path() / "whole.mkv", 2, messages);
    const Bytes whole = bytes_of(folder.path() / "whole.mkv");
    const ByteView cues = as_bytes(std::string_view("\x1c\x53\xbb\x6b"));
    const auto index_at =
        std::find_end(whole.begin(), whole.end(), cues.begin(), cues.end()) - whole.begin();
    constexpr std::ptrdiff_t tested = 6000;
    ASSERT_GT(index_at, tested);
    const std::ptrdiff_t begin = std::ptrdiff_t(whole.size()) - tested;
    Bytes payload;
    std::size_t lossy = 0;
    for (std::ptrdiff_t at = begin; at < std::ptrdiff_t(whole.size()); ++at)
        for (const char* const change : {"removed", "inserted", "changed"}) {
            SCOPED_TRACE(std::string(change) + " at " + std::to_string(at) + ", index at " +
                         std::to_string(index_at));
            const Bytes bytes = with_one_byte(change, at, whole);
            const auto recording = RecordingFile::read(std::make_unique<MemorySource>(bytes));
            ASSERT_TRUE(recording);
            const Segment& segment = (*recording)->segments()[0];
            std::size_t good = 0;
            for (const CameraContent& camera : (*recording)->cameras())
                for (const auto* frames : {&camera.depth.frames, &camera.color.frames})
                    for (const RecordedFrame& frame : *frames)
                        good += (*recording)->read_payload(frame, payload) == Status::ok;
            const bool all = good == messages.size();
            const bool says_so = segment.damaged_places > 0 || segment.refused > 0 ||
                                 good < frames_in(**recording) || segment.missing_end > Duration(0);
            EXPECT_TRUE(all || says_so) << end_of(segment);
            EXPECT_TRUE(all || losses_of(segment) != "" || good < frames_in(**recording));
            // Behind the id of the index nothing is lost.
            if (at >= index_at + 4)
                EXPECT_TRUE(all && segment.unread_end == 0) << end_of(segment);
            lossy += !all;
        }
    EXPECT_GT(lossy, std::size_t(tested)) << "hardly anything was damaged";
}

// One byte changed, inserted or removed before the first cluster.
TEST(Recording, WithADamagedHeadSaysThatNoPictureIsLost) {
    const testing::TemporaryFolder folder;
    const auto messages = generated(2, 6, 60);
    record_all(folder.path() / "whole.mkv", 2, messages);
    const Bytes whole = bytes_of(folder.path() / "whole.mkv");
    MemorySource source{ByteView(whole)};
    const auto head_end = std::ptrdiff_t(read_head(source)->clusters_at);
    std::size_t noticed = 0;
    for (std::ptrdiff_t at = 0; at < head_end; ++at)
        for (const char* const change : {"removed", "inserted", "changed"}) {
            SCOPED_TRACE(std::string(change) + " at " + std::to_string(at));
            const Bytes bytes = with_one_byte(change, at, whole);
            const auto recording = RecordingFile::read(std::make_unique<MemorySource>(bytes));
            ASSERT_TRUE(recording);
            EXPECT_EQ(frames_in(**recording), messages.size());
            const Segment& segment = (*recording)->segments()[0];
            EXPECT_EQ(segment.damaged_places, 0u);
            const auto remarks = remarks_on(segment);
            ASSERT_LE(remarks.size(), 1u) << remarks[0] << ", " << remarks[1];
            noticed += segment.head_damaged;
            if (segment.head_damaged)
                EXPECT_NE(remarks[0].find("no picture is lost by this"), std::string::npos);
        }
    EXPECT_GT(noticed, std::size_t(head_end) * 2);
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
