// SPDX-License-Identifier: Apache-2.0
// The voice tracks of a recording. The Opus packets are opaque here.
#include <gtest/gtest.h>

#include "record/intake.h"
#include "record/recording_layout.h"
#include "record/recover.h"
#include "record/speaker_note.h"
#include "record/test_recordings.h"

namespace theatron::record {
namespace {

constexpr ParticipantId anna{3}, ben{4}, cleo{5};
const std::vector<RecordedVoice> people{{anna, "Anna"}, {ben, "Ben Öz"}};

Bytes said(int number) {
    return Bytes(30 + std::size_t(number) % 7, std::byte(number));
}

// A session of one camera in which people speak.
class RecordedVoices : public ::testing::Test {
protected:
    RecordedVoices() {
        std::map<StreamId, SettingId> settings{{depth_stream(CameraId{0}), SettingId(3)},
                                               {color_stream(CameraId{0}), SettingId(3)}};
        intake_.describe(cameras(1), settings, true, TimePoint(1s));
    }
    TimePoint at(Duration time) const { return session_begin.session + time; }
    void pictures(int begin, int end) {
        for (int i = begin; i < end; ++i)
            for (const StreamId stream : {depth_stream(CameraId{0}), color_stream(CameraId{0})}) {
                const Message m = message(stream, FrameNumber(i), 33ms * i, 500, FrameNumber(i));
                const TimePoint now = m.header.captured + 10ms;
                (void)intake_.take(m.header, m.bytes, "", at_once(now));
            }
    }
    void say(ParticipantId person, int number, Duration time, bool pauses = false) {
        const Bytes opus = said(number);
        intake_.take_voice(person, {std::uint32_t(number), at(time), 20, pauses, -30, opus},
                           at(time + 5ms));
    }
    std::unique_ptr<RecordingFile> finish() {
        intake_.recorder()->finish();
        EXPECT_EQ(intake_.recorder()->figures().problem, "");
        return RecordingFile::open(file_);
    }
    // The numbers that a track's packets of a person carry, with their times.
    static std::vector<std::pair<int, Duration>> speech(const RecordingFile& recording,
                                                        std::size_t track) {
        std::vector<std::pair<int, Duration>> found;
        Bytes payload;
        for (const RecordedFrame& frame : recording.voices().at(track).content.frames)
            if (recording.read_header(frame)->codec == voice_codec &&
                recording.read_payload(frame, payload) == Status::ok)
                found.emplace_back(std::to_integer<int>(payload.at(0)), frame.time());
        return found;
    }

    testing::TemporaryFolder folder_;
    fs::path file_ = folder_.path() / "voices.mkv";
    Intake intake_{file_, {.has_room = true}};
};

TEST_F(RecordedVoices, AreTracksOfTheirOwnAtTheTimeOfThePictures) {
    intake_.describe_voices(people);
    pictures(0, 20);
    say(anna, 1, 700ms);
    say(anna, 2, 720ms, true);
    say(ben, 9, 710ms);
    pictures(20, 90);
    const auto recording = finish();
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(recording->segments()[0].frames, 180u) << "packets are no pictures";
    ASSERT_EQ(recording->voices().size(), people.size() + Intake::spare_voices);
    EXPECT_EQ(recording->voices()[1].track, 129);
    EXPECT_EQ(recording->voices()[1].parts.at(0).name, "Ben Öz");
    EXPECT_EQ(recording->voices()[2].parts.at(0).name, "voice 3");
    using Said = std::vector<std::pair<int, Duration>>;
    EXPECT_EQ(speech(*recording, 0), (Said{{1, 700ms}, {2, 720ms}}));
    EXPECT_EQ(speech(*recording, 1), (Said{{9, 710ms}}));
    EXPECT_EQ(speech(*recording, 2), Said{});
    EXPECT_EQ(parse_speaker_note(recording->voices()[1].content.filters.at(0).filters), people[1]);
    // Silence up to a second before the newest picture, in each track.
    for (const VoiceContent& voice : recording->voices())
        EXPECT_GE(voice.content.frames.back().time(), 33ms * 89 - 1240ms) << voice.track;
    const auto voices = intake_.voices();
    ASSERT_EQ(voices.size(), 2u);
    EXPECT_EQ(voices[0].who, people[0]);
    EXPECT_EQ(voices[0].figures.packets, 2u);
}

TEST_F(RecordedVoices, NothingIsRecordedOfAPersonWhoHasNotAgreedOrNoLonger) {
    intake_.describe_voices({people[0]});
    pictures(0, 20);
    say(ben, 1, 700ms);
    say(anna, 2, 700ms);
    intake_.describe_voices({});
    say(anna, 3, 720ms);
    pictures(20, 60);
    const auto recording = finish();
    std::size_t packets = 0;
    for (std::size_t track = 0; track < recording->voices().size(); ++track)
        packets += speech(*recording, track).size();
    EXPECT_EQ(packets, 1u);
    EXPECT_EQ(speech(*recording, 0).at(0).first, 2);
}

TEST_F(RecordedVoices, PacketsOfAMutedPersonOrOfOneWhoNoLongerAgreedAreNotMissing) {
    intake_.describe_voices(people);
    pictures(0, 20);
    say(anna, 1, 660ms);
    intake_.interrupt_voice(anna);
    say(anna, 11, 860ms);
    intake_.describe_voices({people[1]});
    intake_.describe_voices(people);
    say(anna, 21, 1060ms);
    const auto voices = intake_.voices();
    ASSERT_EQ(voices.size(), 2u);
    EXPECT_EQ(voices[0].figures.packets, 3u);
    EXPECT_EQ(voices[0].figures.missing, 0u);
    say(anna, 31, 1260ms);
    EXPECT_EQ(intake_.voices()[0].figures.missing, 9u) << "those that were lost";
}

TEST_F(RecordedVoices, PeopleWhoAgreeLaterGetSpareTracksThenASegmentBegins) {
    intake_.describe_voices({people[0]});
    pictures(0, 10);
    std::vector<RecordedVoice> more{people[0]};
    for (std::uint32_t i = 0; i < Intake::spare_voices; ++i)
        more.push_back({ParticipantId(10 + i), "guest " + std::to_string(i)});
    intake_.describe_voices(more);
    pictures(10, 20);
    say(ParticipantId(11), 5, 670ms);
    more.push_back({cleo, "Cleo"});
    intake_.describe_voices(more);
    pictures(20, 40);
    say(cleo, 6, 1400ms);
    pictures(40, 60);
    const auto recording = finish();
    ASSERT_EQ(recording->segments().size(), 2u);
    EXPECT_EQ(speech(*recording, 2).at(0).first, 5);
    EXPECT_EQ(recording->voices()[2].parts.at(0).name, "voice 3");
    EXPECT_EQ(recording->voices()[2].parts.at(1).name, "guest 1");
    EXPECT_EQ(speech(*recording, 1 + Intake::spare_voices).at(0),
              (std::pair<int, Duration>{6, 1400ms}));
    EXPECT_TRUE(recording->complete());
}

// One guest after the other comes, agrees, says something and goes.
TEST_F(RecordedVoices, PeopleWhoComeAndGoMakeNoSegments) {
    intake_.describe_voices({people[0]});
    pictures(0, 10);
    constexpr int guests = 60;
    for (int i = 0; i < guests; ++i) {
        const ParticipantId guest{std::uint32_t(100 + i)};
        intake_.describe_voices({people[0], {guest, "guest " + std::to_string(i)}});
        pictures(10 + 2 * i, 12 + 2 * i);
        say(guest, i, 33ms * (12 + 2 * i));
    }
    say(anna, 1, 33ms * (14 + 2 * guests));
    pictures(12 + 2 * guests, 60 + 2 * guests);
    const auto recording = finish();
    EXPECT_EQ(recording->segments().size(), 1u);
    EXPECT_EQ(recording->voices().size(), 1 + Intake::spare_voices);
    EXPECT_TRUE(recording->complete());
    std::map<std::string, int> packets;
    Bytes payload;
    for (const VoiceContent& voice : recording->voices())
        for (std::size_t at = 0; at < voice.content.frames.size(); ++at) {
            const RecordedFrame& frame = voice.content.frames[at];
            if (recording->read_header(frame)->codec != voice_codec)
                continue;
            ASSERT_EQ(recording->read_payload(frame, payload), Status::ok);
            std::string note;
            for (const FilterChange& change : voice.content.filters)
                if (change.frame <= at)
                    note = change.filters;
            const auto who = parse_speaker_note(note);
            ASSERT_TRUE(who);
            ++packets[who->name];
            if (who->person != anna)
                EXPECT_EQ(who->name,
                          "guest " + std::to_string(std::to_integer<int>(payload.at(0))));
        }
    EXPECT_EQ(packets.size(), std::size_t(guests) + 1);
    EXPECT_EQ(packets["Anna"], 1);
    EXPECT_EQ(intake_.voices().size(), std::size_t(guests) + 1);
}

TEST_F(RecordedVoices, SomebodyWhoComesBackSpeaksInTheSameTrack) {
    intake_.describe_voices(people);
    pictures(0, 20);
    say(ben, 1, 700ms);
    intake_.describe_voices({people[0]});
    const ParticipantId again{77};
    intake_.describe_voices({people[0], {again, people[1].name}, {cleo, "Cleo"}});
    say(cleo, 3, 900ms);
    say(again, 1, 900ms);
    pictures(20, 60);
    const auto recording = finish();
    using Said = std::vector<std::pair<int, Duration>>;
    EXPECT_EQ(speech(*recording, 1), (Said{{1, 700ms}, {1, 900ms}}));
    EXPECT_EQ(speech(*recording, 2), (Said{{3, 900ms}}));
}

TEST_F(RecordedVoices, DamageOfAPacketCostsOnlyItAndTheRestIsRecovered) {
    intake_.describe_voices(people);
    pictures(0, 20);
    for (int i = 0; i < 40; ++i)
        say(anna, i, 660ms + 20ms * i);
    pictures(20, 60);
    const auto whole = finish();
    std::uint64_t place = 0;
    for (const RecordedFrame& frame : whole->voices()[0].content.frames)
        if (whole->read_header(frame)->codec == voice_codec)
            place = frame.payload_at;
    std::size_t blocks = 0;
    for (const VoiceContent& voice : whole->voices())
        blocks += voice.content.frames.size();
    Bytes bytes = bytes_of(file_);
    bytes[place] ^= std::byte{1};
    write_bytes(file_, bytes);
    const auto damaged = RecordingFile::open(file_);
    EXPECT_EQ(speech(*damaged, 0).size(), 39u);

    const Recovered saved = recover(*damaged, folder_.path() / "saved.mkv", {});
    EXPECT_FALSE(saved.complete);
    EXPECT_EQ(saved.voices.damaged, 1u);
    EXPECT_EQ(saved.voices.saved, 39u) << "silence is nobody's";
    EXPECT_EQ(saved.voices.silent, blocks - 40);
    const auto again = RecordingFile::open(folder_.path() / "saved.mkv");
    EXPECT_TRUE(again->segments()[0].is_whole());
    EXPECT_EQ(speech(*again, 0), speech(*damaged, 0));
    EXPECT_EQ(again->voices()[1].parts.at(0).name, "Ben Öz");
    EXPECT_EQ(again->voices()[0].content.filters.front().filters,
              whole->voices()[0].content.filters.front().filters);
}

TEST_F(RecordedVoices, AreNotInARecordingWithoutASession) {
    record_all(folder_.path() / "plain.mkv", 1,
               {message(depth_stream(CameraId{0}), 0, 0ms, 10, 0)});
    EXPECT_TRUE(RecordingFile::open(folder_.path() / "plain.mkv")->voices().empty());
}

TEST(SpeakerNote, SaysNumberAndNameAndRefusesOtherTexts) {
    EXPECT_EQ(parse_speaker_note(speaker_note(people[1])), people[1]);
    for (const char* text : {"", "4", "Anna", "x 4", "0 Anna", "99999999999 Anna", "-1 Anna"})
        EXPECT_FALSE(parse_speaker_note(text)) << text;
}

}  // namespace
}  // namespace theatron::record
