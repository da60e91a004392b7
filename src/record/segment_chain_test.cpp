// SPDX-License-Identifier: Apache-2.0
// Recordings of several files, of which some are missing, cannot be read, or are of another one.
#include "record/segment_chain.h"

#include <sys/stat.h>

#include "base/error.h"
#include "record/recording_layout.h"
#include "record/recover.h"
#include "record/remarks.h"
#include "record/test_recordings.h"

namespace theatron::record {
namespace {

// In "a.mkv", "a.002.mkv" and so on, with one picture each.
void record_segments(const fs::path& folder, int segments) {
    Recorder recorder(folder / "a.mkv", cameras(1), session_begin);
    const Message picture = generated(1, 4, 100)[0];
    for (int n = 0; n < segments; ++n) {
        if (n > 0)
            recorder.begin_segment(cameras(1), session_begin);
        ASSERT_EQ(add(recorder, picture), Recorder::Added::taken);
    }
    recorder.finish();
    ASSERT_EQ(recorder.figures().segments, std::uint32_t(segments));
}

TEST(SegmentChain, ALaterSegmentSaysWhichEarlierOnesAreMissing) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    const auto third = [&] { return RecordingFile::open(folder.path() / "a.003.mkv"); };
    EXPECT_EQ(third()->missing_segments(), 0u) << "they lie beside it";
    EXPECT_EQ(third()->begins_in(), (folder.path() / "a.mkv").string());
    EXPECT_TRUE(third()->intact());
    fs::remove(folder.path() / "a.mkv");
    EXPECT_EQ(third()->missing_segments(), 1u);
    EXPECT_EQ(third()->begins_in(), "");
    EXPECT_FALSE(third()->complete());
    // Another recording's file of that name is none of them.
    record_all(folder.path() / "a.mkv", 1, generated(1, 3, 100));
    fs::remove(folder.path() / "a.002.mkv");
    EXPECT_EQ(third()->missing_segments(), 2u);
    EXPECT_EQ(RecordingFile::open(folder.path() / "a.mkv")->missing_segments(), 0u);
}

TEST(SegmentChain, FilesThatWereRenamedAreFound) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    const fs::path first = folder.path() / "Müller.mkv", third = folder.path() / "end.mkv";
    fs::rename(folder.path() / "a.mkv", first);
    fs::rename(folder.path() / "a.003.mkv", third);
    // Neither second copies nor another recording count. The best copy is taken.
    fs::copy_file(folder.path() / "a.002.mkv", folder.path() / "copy.mkv");
    const Bytes whole = bytes_of(third);
    write_bytes(folder.path() / "cut.mkv", Bytes(whole.begin(), whole.end() - 100));
    record_all(folder.path() / "other.mkv", 1, generated(1, 3, 100));
    const auto recording = RecordingFile::open(first);
    EXPECT_EQ(recording->segments().size(), 3u);
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(remarks_on_files(*recording), std::vector<std::string>{});
    EXPECT_EQ(RecordingFile::open(third)->begins_in(), first.string());
    EXPECT_EQ(RecordingFile::open(third)->missing_segments(), 0u);
}

TEST(SegmentChain, ThatTheLastFileIsLostIsSaid) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    const auto missing = [&] {
        return RecordingFile::open(folder.path() / "a.mkv")->missing_segments();
    };
    EXPECT_EQ(missing(), 0u);
    const fs::path third = folder.path() / "a.003.mkv";
    write_bytes(third, Bytes(fs::file_size(third)));
    EXPECT_EQ(missing(), 1u) << "it cannot be read";
    fs::remove(third);
    EXPECT_EQ(missing(), 1u);
    EXPECT_FALSE(RecordingFile::open(folder.path() / "a.mkv")->complete());
    fs::remove(folder.path() / "a.002.mkv");
    EXPECT_EQ(missing(), 1u) << "at least";
    // The file that is saved from it is as incomplete.
    recover(*RecordingFile::open(folder.path() / "a.mkv"), folder.path() / "saved.mkv", {});
    EXPECT_EQ(RecordingFile::open(folder.path() / "saved.mkv")->missing_segments(), 1u);
}

// In the tag, whose bytes no checksum protects.
TEST(SegmentChain, ThatTheLastFileIsLostIsSaidInSpiteOfAFlippedBit) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 2);
    fs::remove(folder.path() / "a.002.mkv");
    const fs::path first = folder.path() / "a.mkv";
    const Bytes whole = bytes_of(first);
    const ByteView name = as_bytes(std::string_view(next_segment_tag));
    const auto tag = std::search(whole.begin(), whole.end(), name.begin(), name.end());
    ASSERT_NE(tag, whole.end());
    for (int at = -12; at < int(name.size()) + 5; ++at)
        for (int bit = 0; bit < 8; ++bit) {
            Bytes flipped = whole;
            *(flipped.begin() + (tag - whole.begin()) + at) ^= std::byte(1 << bit);
            write_bytes(first, flipped);
            const auto recording = RecordingFile::open(first);
            EXPECT_FALSE(recording->complete()) << at << " " << bit;
            EXPECT_EQ(recording->cameras().at(0).depth.frames.size(), 1u);
        }
}

TEST(SegmentChain, AFileThatCannotBeReadIsNamed) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    const fs::path second = folder.path() / "a.002.mkv";
    write_bytes(second, Bytes(fs::file_size(second)));
    const auto recording = RecordingFile::open(folder.path() / "a.mkv");
    EXPECT_EQ(recording->unreadable_files(), std::vector{second.string()});
    EXPECT_EQ(recording->missing_segments(), 1u);
    EXPECT_EQ(recording->segments().size(), 2u);
}

// One of another recording, and one of another program, whose times are in milliseconds.
TEST(SegmentChain, AForeignFileBesideIsNamedAndNotMissing) {
    const testing::TemporaryFolder folder, other;
    record_segments(folder.path(), 1);
    record_segments(other.path(), 2);
    fs::rename(other.path() / "a.002.mkv", folder.path() / "a.002.mkv");
    Bytes film = bytes_of(folder.path() / "a.mkv");
    const ByteView scale = as_bytes(std::string_view("\x2a\xd7\xb1", 3));
    for (auto at = film.begin();; ++at) {
        at = std::search(at, film.end(), scale.begin(), scale.end());
        if (at == film.end())
            break;
        *(at + 4) ^= std::byte{0x40};
    }
    write_bytes(folder.path() / "a.003.mkv", film);
    const auto recording = RecordingFile::open(folder.path() / "a.mkv");
    const std::vector expected{(folder.path() / "a.002.mkv").string(),
                               (folder.path() / "a.003.mkv").string()};
    EXPECT_EQ(recording->foreign_files(), expected);
    EXPECT_EQ(recording->missing_segments(), 0u);
    EXPECT_EQ(recording->unreadable_files(), std::vector<std::string>{});
    EXPECT_TRUE(recording->complete());
    ASSERT_EQ(remarks_on_files(*recording).size(), 2u);
    EXPECT_NE(remarks_on_files(*recording)[0].find("does not continue this recording"),
              std::string::npos);
}

TEST(SegmentChain, WhereAllSegmentsAreThereAnotherFileIsNoneOfThem) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    write_bytes(folder.path() / "a.007.mkv", Bytes(1));
    const auto recording = RecordingFile::open(folder.path() / "a.mkv");
    EXPECT_EQ(recording->missing_segments(), 0u);
    EXPECT_EQ(recording->unreadable_files().size(), 1u);
}

TEST(SegmentChain, FilesThatWereJoinedMayLieBesideTheirParts) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    Bytes all;
    for (const char* name : {"a.mkv", "a.002.mkv", "a.003.mkv"}) {
        const Bytes part = bytes_of(folder.path() / name);
        all.insert(all.end(), part.begin(), part.end());
    }
    write_bytes(folder.path() / "all.mkv", all);
    const auto recording = RecordingFile::open(folder.path() / "all.mkv");
    EXPECT_EQ(recording->segments().size(), 3u);
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(recording->cameras().at(0).depth.frames.size(), 3u);
}

TEST(SegmentChain, APipeIsNoRecording) {
    const testing::TemporaryFolder folder;
    const fs::path pipe = folder.path() / "a.mkv";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW((void)RecordingFile::open(pipe), Error);
}

TEST(Recorder, ReplacesNoRecordingOfWhichAPartIsInUseNorALaterPart) {
    const testing::TemporaryFolder folder;
    record_segments(folder.path(), 3);
    const Bytes before = bytes_of(folder.path() / "a.mkv");
    {
        const auto played = RecordingFile::open(folder.path() / "a.003.mkv");
        EXPECT_THROW(record_all(folder.path() / "a.mkv", 1, generated(1, 3, 100)), Error);
    }
    EXPECT_THROW(record_all(folder.path() / "a.002.mkv", 1, generated(1, 3, 100)), Error);
    fs::create_symlink(folder.path() / "a.mkv", folder.path() / "link.mkv");
    EXPECT_THROW(record_all(folder.path() / "link.mkv", 1, generated(1, 3, 100)), Error);
    EXPECT_EQ(bytes_of(folder.path() / "a.mkv"), before);
    EXPECT_EQ(RecordingFile::open(folder.path() / "a.mkv")->segments().size(), 3u);
}

TEST(Recorder, ReplacesARecordingWithAllItsSegments) {
    const testing::TemporaryFolder folder, other;
    record_segments(folder.path(), 4);
    // Files of other recordings stay.
    record_segments(other.path(), 2);
    fs::rename(other.path() / "a.002.mkv", folder.path() / "a.003.mkv");
    write_bytes(folder.path() / "a.005.mkv", Bytes(10));
    record_all(folder.path() / "a.mkv", 1, generated(1, 3, 100));
    EXPECT_FALSE(fs::exists(folder.path() / "a.002.mkv"));
    EXPECT_TRUE(fs::exists(folder.path() / "a.003.mkv"));
    EXPECT_FALSE(fs::exists(folder.path() / "a.004.mkv"));
    EXPECT_TRUE(fs::exists(folder.path() / "a.005.mkv"));
}

}  // namespace
}  // namespace theatron::record
