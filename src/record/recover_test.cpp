// SPDX-License-Identifier: Apache-2.0
// Recovery of damaged files, and of files that contain one another.
#include "record/recover.h"

#include "base/error.h"
#include "record/recording_layout.h"
#include "record/remarks.h"
#include "record/test_recordings.h"
#include "testing/full_disk.h"

namespace theatron::record {
namespace {

Bytes joined(const std::vector<Bytes>& parts) {
    Bytes all;
    for (const Bytes& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

// Pictures with a key every second.
std::vector<Message> with_keys(int frames, std::size_t size, unsigned content = 0) {
    std::vector<Message> messages;
    for (int n = 0; n < frames; ++n) {
        const bool key = n % 30 == 0;
        Message m = message(depth_stream(CameraId(0)), FrameNumber(n), n * 33ms, size,
                            FrameNumber(key ? n : n - 1));
        Bytes bytes = *m.bytes;
        bytes.back() = std::byte(content);
        messages.push_back({m.header, std::make_shared<const Bytes>(std::move(bytes))});
    }
    return messages;
}

Bytes recording_of(const std::vector<Message>& messages) {
    const testing::TemporaryFolder folder;
    record_all(folder.path() / "a.mkv", 1, messages);
    return bytes_of(folder.path() / "a.mkv");
}

Bytes recording_that_lacks(const std::vector<Message>& messages, const Lacks& lacks) {
    const testing::TemporaryFolder folder;
    Recorder recorder(folder.path() / "a.mkv", cameras(1), session_begin);
    for (const Message& m : messages)
        EXPECT_EQ(add(recorder, m), Recorder::Added::taken);
    recorder.finish();
    recorder.note_lacks(lacks);
    return bytes_of(folder.path() / "a.mkv");
}

std::unique_ptr<RecordingFile> recovered(const Bytes& bytes, const fs::path& folder) {
    write_bytes(folder / "broken.mkv", bytes);
    const auto saved =
        recover(*RecordingFile::open(folder / "broken.mkv"), folder / "whole.mkv", {});
    auto recording = RecordingFile::open(folder / "whole.mkv");
    EXPECT_TRUE(recording->segments()[0].is_whole());
    EXPECT_EQ(recording->refused(), 0u);
    EXPECT_EQ(recording->segments().size(), saved.files.size());
    return recording;
}

// No picture is earlier than the one before it, or refers to a missing one.
void expect_playable(const RecordingFile& recording) {
    const auto& frames = recording.cameras()[0].depth.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto header = recording.read_header(frames[i]);
        ASSERT_TRUE(header);
        if (i > 0)
            EXPECT_GT(frames[i].time(), frames[i - 1].time()) << i;
        EXPECT_TRUE(header->key || (i > 0 && frames[i - 1].number == header->reference)) << i;
    }
}

TEST(JoinedFiles, TheSecondCopyOfARecordingIsLeftOutAndSaid) {
    const auto messages = with_keys(60, 500);
    const Bytes one = recording_of(messages);
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "twice.mkv", joined({one, one, one}));
    const auto recording = RecordingFile::open(folder.path() / "twice.mkv");
    EXPECT_EQ(frames_in(*recording), messages.size());
    EXPECT_EQ(recording->segments()[0].foreign.files, 2u);
    EXPECT_EQ(recording->segments()[0].foreign.bytes, 2 * one.size());
    EXPECT_EQ(recording->segments()[0].damaged_places, 0u);
    EXPECT_EQ(recording->bytes(), 3 * one.size());
    EXPECT_FALSE(recording->intact());
    const auto whole = recovered(joined({one, one, one}), folder.path());
    EXPECT_EQ(count_equal(*whole, messages), messages.size());
    expect_playable(*whole);
}

TEST(JoinedFiles, AnotherRecordingsPicturesAreNotTakenForThisOnes) {
    const auto messages = with_keys(60, 500, 1);
    const testing::TemporaryFolder folder;
    const Bytes bytes = joined({recording_of(messages), recording_of(with_keys(45, 500, 2))});
    const auto whole = recovered(bytes, folder.path());
    EXPECT_EQ(count_equal(*whole, messages), messages.size());
    EXPECT_EQ(frames_in(*whole), messages.size());
    expect_playable(*whole);
}

TEST(JoinedFiles, AreReadAsOneRecordingWhereTheyAreItsSegments) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "a.mkv";
    const auto messages = with_keys(60, 500);
    {
        Recorder recorder(path, cameras(1), session_begin);
        for (int segment = 0; segment < 3; ++segment) {
            if (segment > 0)
                recorder.begin_segment(cameras(1), session_begin);
            for (const Message& m : messages)
                ASSERT_EQ(add(recorder, m), Recorder::Added::taken);
        }
    }
    const Bytes first = bytes_of(path), second = bytes_of(folder.path() / "a.002.mkv"),
                third = bytes_of(folder.path() / "a.003.mkv");
    const Bytes other = recording_of(messages);
    for (const std::vector<Bytes>& order : {std::vector{first, second, third},
                                            {first, third, second},
                                            {first, other, second, first, third}}) {
        const Bytes all = joined(order);
        const auto recording = RecordingFile::read(std::make_unique<MemorySource>(all));
        ASSERT_TRUE(recording);
        EXPECT_EQ((*recording)->segments().size(), 3u);
        EXPECT_EQ(frames_in(**recording), 3 * messages.size());
        EXPECT_EQ((*recording)->missing_segments(), 0u);
        EXPECT_EQ((*recording)->intact(), order.size() == 3);
        EXPECT_EQ((*recording)->bytes(), all.size());
    }
}

TEST(Recovery, AFullDiskLeavesNothingAndSaysSo) {
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "a.mkv", recording_of(with_keys(90, 10'000)));
    const auto recording = RecordingFile::open(folder.path() / "a.mkv");
    std::string problem;
    try {
        const testing::FullDisk disk(300'000);
        (void)recover(*recording, folder.path() / "saved.mkv", {});
    } catch (const Error& error) {
        problem = error.what();
    }
    EXPECT_NE(problem.find("What was copied is removed"), std::string::npos) << problem;
    EXPECT_EQ(problem.find("is kept"), std::string::npos) << problem;
    EXPECT_FALSE(fs::exists(folder.path() / "saved.mkv"));
    EXPECT_TRUE(fs::exists(folder.path() / "a.mkv"));
}

TEST(Recovery, ARecordingWithoutAWholePictureLeavesNoFile) {
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "whole.mkv", recording_of(with_keys(10, 500)));
    const auto whole = RecordingFile::open(folder.path() / "whole.mkv");
    Bytes bytes = bytes_of(folder.path() / "whole.mkv");
    bytes.resize(std::size_t(whole->cameras()[0].depth.frames.at(0).payload_at));
    write_bytes(folder.path() / "head.mkv", bytes);
    const auto head = RecordingFile::open(folder.path() / "head.mkv");
    EXPECT_THROW(recover(*head, folder.path() / "out.mkv", {}), Error);
    EXPECT_FALSE(fs::exists(folder.path() / "out.mkv"));
}

TEST(JoinedFiles, AnotherFileInTheMiddleDoesNotSwallowTheRest) {
    const auto messages = with_keys(120, 500, 1);
    const Bytes one = recording_of(messages), other = recording_of(with_keys(45, 500, 2));
    for (const std::size_t at : {one.size() / 2, one.size() / 2 + 301, one.size() - 20}) {
        Bytes bytes = one;
        bytes.insert(bytes.begin() + std::ptrdiff_t(at), other.begin(), other.end());
        const testing::TemporaryFolder folder;
        const auto whole = recovered(bytes, folder.path());
        EXPECT_GE(frames_in(*whole), messages.size() - 30) << at;
        const auto broken = RecordingFile::open(folder.path() / "broken.mkv");
        EXPECT_EQ(broken->segments()[0].foreign.files, 1u);
        EXPECT_EQ(broken->segments()[0].foreign.bytes, other.size());
        EXPECT_EQ(broken->bytes(), bytes.size());
        Bytes payload;
        for (const RecordedFrame& frame : whole->cameras()[0].depth.frames) {
            ASSERT_EQ(whole->read_payload(frame, payload), Status::ok);
            EXPECT_EQ(payload.back(), std::byte{1});
        }
    }
    // A foreign file without its end: its pictures are not taken for those of this one.
    Bytes bytes = one;
    bytes.insert(bytes.begin() + std::ptrdiff_t(one.size() / 2), other.begin(),
                 other.begin() + std::ptrdiff_t(other.size() / 2));
    const auto recording = RecordingFile::read(std::make_unique<MemorySource>(bytes));
    ASSERT_TRUE(recording);
    EXPECT_LE(frames_in(**recording), 61u);
}

TEST(JoinedFiles, TheFilesOwnHeadInItsMiddleIsDamage) {
    const auto messages = with_keys(300, 500);
    const Bytes one = recording_of(messages);
    constexpr std::size_t block = 4096;
    for (const std::size_t at : {one.size() / 2 / block * block, one.size() / 2 + 301}) {
        Bytes bytes = one;
        std::copy_n(one.begin(), block, bytes.begin() + std::ptrdiff_t(at));
        const testing::TemporaryFolder folder;
        const auto whole = recovered(bytes, folder.path());
        EXPECT_GE(frames_in(*whole), messages.size() - 2 * 30) << at;
        expect_playable(*whole);
        const auto broken = RecordingFile::open(folder.path() / "broken.mkv");
        EXPECT_EQ(broken->segments()[0].foreign.files, 0u);
        EXPECT_GE(broken->segments()[0].damaged_places, 1u);
        EXPECT_FALSE(broken->complete());
    }
}

// With the first one's copies of its head damaged, only the second one's are intact.
TEST(JoinedFiles, KeepEachItsOwnHead) {
    const testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "a.mkv";
    {
        Recorder recorder(path, cameras(1), session_begin);
        for (const Message& m : with_keys(40, 500))
            ASSERT_EQ(add(recorder, m), Recorder::Added::taken);
        auto others = cameras(1);
        others[0].name = "another";
        recorder.begin_segment(others, session_begin);
        for (const Message& m : with_keys(40, 500))
            ASSERT_EQ(add(recorder, m), Recorder::Added::taken);
    }
    Bytes first = bytes_of(path);
    for (auto at = first.begin();; ++at) {
        at = std::search(at, first.end(), as_bytes(head_copy_magic).begin(),
                         as_bytes(head_copy_magic).end());
        if (at == first.end())
            break;
        at[head_copy_magic.size()] ^= std::byte{1};
    }
    const Bytes all = joined({first, bytes_of(folder.path() / "a.002.mkv")});
    const auto recording = RecordingFile::read(std::make_unique<MemorySource>(all));
    ASSERT_TRUE(recording);
    ASSERT_EQ((*recording)->segments().size(), 2u);
    EXPECT_TRUE((*recording)->segments()[0].head_damaged);
    EXPECT_EQ((*recording)->cameras()[0].name, "camera 0");
}

TEST(JoinedFiles, BehindOneThatWasNeverClosedAreFoundToo) {
    const auto messages = with_keys(60, 500);
    Bytes one = recording_of(messages);
    one.resize(one.size() / 2);
    const testing::TemporaryFolder folder;
    const auto whole = recovered(joined({one, recording_of(messages)}), folder.path());
    EXPECT_LT(frames_in(*whole), 60u);
    EXPECT_EQ(count_equal(*whole, messages), frames_in(*whole));
    expect_playable(*whole);
}

TEST(Recording, PicturesThatStandInAFileTwiceCountOnce) {
    const auto messages = with_keys(120, 500);
    const Bytes one = recording_of(messages);
    const std::size_t from = one.size() / 4, to = one.size() * 3 / 4;
    Bytes bytes(one.begin(), one.begin() + std::ptrdiff_t(to));
    bytes.insert(bytes.end(), one.begin() + std::ptrdiff_t(from), one.end());
    const auto recording = RecordingFile::read(std::make_unique<MemorySource>(bytes));
    ASSERT_TRUE(recording);
    EXPECT_LE(frames_in(**recording), messages.size());
    EXPECT_GT((*recording)->segments()[0].repeated, 20u);
    EXPECT_EQ((*recording)->segments()[0].frames, frames_in(**recording));
    EXPECT_FALSE((*recording)->intact());
    const testing::TemporaryFolder folder;
    expect_playable(*recovered(bytes, folder.path()));
}

TEST(Recover, LeavesWhatRefersAcrossAPlaceWhereTheFileGoesBack) {
    const auto messages = with_keys(120, 500);
    const Bytes one = recording_of(messages);
    // The two halves change places.
    const auto half = one.begin() + std::ptrdiff_t(one.size() / 2);
    Bytes bytes(half, one.end());
    bytes.insert(bytes.begin(), one.begin(), one.begin() + 4000);
    bytes.insert(bytes.end(), one.begin() + 4000, half);
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "broken.mkv", bytes);
    const auto broken = RecordingFile::open(folder.path() / "broken.mkv");
    recover(*broken, folder.path() / "whole.mkv", {});
    const auto whole = RecordingFile::open(folder.path() / "whole.mkv");
    EXPECT_TRUE(whole->segments()[0].is_whole());
    EXPECT_GT(frames_in(*whole), 90u);
    const auto& frames = whole->cameras()[0].depth.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto header = whole->read_header(frames[i]);
        EXPECT_TRUE(header->key || (i > 0 && frames[i - 1].number == header->reference)) << i;
    }
}

// As version 1 was written: without a description, copies of the head and checks.
Bytes version_1_of(const std::vector<Message>& messages) {
    const testing::TemporaryFolder folder;
    MatroskaLayout layout;
    layout.side_name = side_name;
    Track track;
    track.codec_id = depth_codec_id;
    track.width = track.height = 16;
    layout.tracks.push_back(track);
    MatroskaWriter writer(folder.path() / "1.mkv", layout);
    for (const Message& m : messages) {
        Block block;
        block.key = m.header.key;
        block.time_us = (m.header.captured - messages[0].header.captured).count();
        block.payload = wire::media_payload(*m.bytes);
        block.side = ByteView(*m.bytes).first(wire::media_header_size);
        EXPECT_EQ(writer.write({block}), "");
    }
    EXPECT_EQ(writer.finish(), "");
    return bytes_of(folder.path() / "1.mkv");
}

TEST(Recover, SavesOnceWhatStandsTwiceInAFileOfVersion1) {
    const auto messages = with_keys(60, 50);
    Bytes bytes = version_1_of(messages);
    const ByteView cluster = as_bytes(std::string_view("\x1f\x43\xb6\x75"));
    const auto first = std::search(bytes.begin(), bytes.end(), cluster.begin(), cluster.end());
    const Bytes clusters(first, bytes.end());
    bytes.insert(bytes.end(), clusters.begin(), clusters.end());
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "broken.mkv", bytes);
    const auto broken = RecordingFile::open(folder.path() / "broken.mkv");
    EXPECT_EQ(frames_in(*broken), 2 * messages.size());
    const Recovered saved = recover(*broken, folder.path() / "whole.mkv", {});
    EXPECT_EQ(saved.cameras[0].depth.saved, messages.size());
    EXPECT_GT(saved.cameras[0].depth.repeated, 0u);
    const auto whole = RecordingFile::open(folder.path() / "whole.mkv");
    EXPECT_EQ(count_equal(*whole, messages), messages.size());
    EXPECT_EQ(frames_in(*whole), messages.size());
    expect_playable(*whole);
}

TEST(Recover, LeavesAWordOfWhatWasMissing) {
    Bytes one = recording_of(with_keys(120, 500));
    one.resize(one.size() / 2);
    const testing::TemporaryFolder folder;
    const auto whole = recovered(one, folder.path());
    const Segment cut = RecordingFile::open(folder.path() / "broken.mkv")->segments()[0];
    EXPECT_EQ(whole->segments()[0].recovered, end_of(cut));
    EXPECT_EQ(end_of(whole->segments()[0]), "");
    EXPECT_EQ(whole->segments()[0].lacks, Lacks{Lack::pictures}) << "its file says so, too";
    // It survives damage, and another recovery.
    Bytes bytes = bytes_of(folder.path() / "whole.mkv");
    bytes[1] ^= std::byte{1};
    bytes[bytes.size() / 2] ^= std::byte{1};
    fs::remove(folder.path() / "whole.mkv");
    const auto again = recovered(bytes, folder.path());
    EXPECT_EQ(again->segments()[0].recovered.find(end_of(cut)), 0u);
}

TEST(Recover, KeepsWhatTheRecorderKnewToBeMissing) {
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "a.mkv", recording_of(with_keys(20, 500)));
    EXPECT_TRUE(recover(*RecordingFile::open(folder.path() / "a.mkv"), folder.path() / "b.mkv", {})
                    .complete);
    EXPECT_TRUE(RecordingFile::open(folder.path() / "b.mkv")->segments()[0].lacks.empty());

    write_bytes(folder.path() / "c.mkv", recording_that_lacks(with_keys(20, 500), {Lack::refused}));
    const auto saved =
        recover(*RecordingFile::open(folder.path() / "c.mkv"), folder.path() / "d.mkv", {});
    EXPECT_FALSE(saved.complete) << "every picture in it was saved, but some never came";
    EXPECT_EQ(RecordingFile::open(folder.path() / "d.mkv")->segments()[0].lacks,
              Lacks{Lack::refused});
}

TEST(Recover, ThatIsStoppedLeavesNoFile) {
    const testing::TemporaryFolder folder;
    write_bytes(folder.path() / "a.mkv", recording_of(with_keys(400, 50'000)));
    write_bytes(folder.path() / "b.mkv.part", Bytes(100));  // of a program that was killed
    EXPECT_THROW(recover(*RecordingFile::open(folder.path() / "a.mkv"), folder.path() / "b.mkv",
                         [](double) { throw Error("stopped"); }),
                 Error);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

// Where the copies of the head stand.
std::vector<std::uint64_t> copies_in(const Bytes& bytes) {
    std::vector<std::uint64_t> places;
    const ByteView magic = as_bytes(head_copy_magic);
    for (auto at = bytes.begin();; ++at) {
        at = std::search(at, bytes.end(), magic.begin(), magic.end());
        if (at == bytes.end())
            return places;
        places.push_back(std::uint64_t(at - bytes.begin()));
    }
}

TEST(Recover, WritesTheHeadAsOftenAsARecorderDoes) {
    const auto messages = with_keys(300, 12'000);  // 3.6 MB
    Bytes one = recording_of(messages);
    const std::size_t copies = copies_in(one).size();
    EXPECT_GE(copies, 4u);
    one[one.size() / 2] ^= std::byte{1};
    const testing::TemporaryFolder folder;
    (void)recovered(one, folder.path());
    EXPECT_GE(copies_in(bytes_of(folder.path() / "whole.mkv")).size(), copies);
}

// A long file's copies near its ends are damaged; one stands in the middle.
TEST(Recover, FindsTheHeadWhereverItIsIntact) {
    const auto messages = with_keys(30, 1'600'000);  // 48 MB
    Bytes bytes = recording_of(messages);
    const auto places = copies_in(bytes);
    for (const std::uint64_t at : places)
        if (at < max_front_bytes || at > bytes.size() - max_front_bytes)
            bytes[at + head_copy_magic.size()] ^= std::byte{1};
    const ByteView name = as_bytes(std::string_view("V_THEATRON/DEPTH"));
    auto plain = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    *plain ^= std::byte{1};
    const auto recording = RecordingFile::read(std::make_unique<MemorySource>(bytes));
    ASSERT_TRUE(recording);
    EXPECT_EQ(frames_in(**recording), messages.size());
    EXPECT_TRUE((*recording)->segments()[0].head_damaged);
}

// Two places of the head, wherever they are.
TEST(Recover, MakesAFileThatSurvivesTwoFlipsInItsHead) {
    const auto messages = with_keys(40, 100);
    Bytes one = recording_of(messages);
    one[3] ^= std::byte{1};  // only a copy of the head is found
    const testing::TemporaryFolder folder;
    (void)recovered(one, folder.path());
    const Bytes whole = bytes_of(folder.path() / "whole.mkv");
    MemorySource source{ByteView(whole)};
    const std::uint64_t head_end = read_head(source)->clusters_at;
    std::minstd_rand random(4);
    for (int i = 0; i < 2000; ++i) {
        Bytes damaged = whole;
        std::string where;
        for (int k = 0; k < 2; ++k) {
            const std::uint64_t at = random() % head_end;
            damaged[at] ^= std::byte(1 << random() % 8);
            where += std::to_string(at) + " ";
        }
        SCOPED_TRACE(where);
        const auto recording = RecordingFile::read(std::make_unique<MemorySource>(damaged));
        ASSERT_TRUE(recording);
        EXPECT_EQ(frames_in(**recording), messages.size());
        EXPECT_EQ((*recording)->cameras()[0].name, "camera 0");
        EXPECT_EQ((*recording)->cameras()[0].depth.codec, "zstd:delta=1,layers=3");
        EXPECT_EQ((*recording)->cameras()[0].calibration, cameras(1)[0].calibration);
    }
}

}  // namespace
}  // namespace theatron::record
