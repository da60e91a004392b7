// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "wire/control.h"
#include "wire/envelope.h"
#include "wire/media_header.h"

namespace theatron::wire {
namespace {

MediaHeader sample_header(std::uint32_t payload_size) {
    MediaHeader h;
    h.codec = 3;
    h.temporal_layer = 2;
    h.stream = StreamId{5};
    h.setting = SettingId{2};
    h.frame = 0x01020304;
    h.reference = 0x01020303;
    h.slice = 1;
    h.slices = 2;
    h.payload_size = payload_size;
    h.moment = from_us(33333);
    h.captured = from_us(33000);
    h.delivered = from_us(33100);
    h.encoded = from_us(35000);
    h.sent = from_us(35500);
    return h;
}

Bytes message(const MediaHeader& header) {
    Bytes bytes(media_header_size + header.payload_size);
    write_media_header(header, bytes.data());
    return bytes;
}

TEST(MediaHeader, RoundTrips) {
    const auto parsed = parse_media_header(message(sample_header(3)));
    ASSERT_TRUE(parsed);
    EXPECT_EQ(*parsed, sample_header(3));
}

// The test vector of docs/formats/media_header.md.
TEST(MediaHeader, BytesAreAsSpecified) {
    const int expected[64] = {
        1,    3,    0, 2,                          // version, codec, flags, layer
        5,    0,    2, 0,                          // stream, setting
        4,    3,    2, 1, 3,    3,    2,    1,     // frame, reference
        1,    0,    2, 0, 0,    0,    0,    0,     // slice, slices, payload size
        0x35, 0x82, 0, 0, 0,    0,    0,    0,     // moment 33333
        0xe8, 0x80, 0, 0, 0,    0,    0,    0,     // captured 33000
        100,  0,    0, 0, 0xff, 0xff, 0xff, 0xff,  // delivered +100, filtered unknown
        0xd0, 7,    0, 0, 0xc4, 9,    0,    0,     // encoded +2000, sent +2500
        0,    0,    0, 0, 0,    0,    0,    0};
    const Bytes bytes = message(sample_header(0));
    for (std::size_t i = 0; i < 64; ++i)
        EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << "byte " << i;
}

TEST(MediaHeader, RefusesEveryTruncation) {
    const Bytes whole = message(sample_header(5));
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_EQ(parse_media_header(ByteView(whole).first(n)).error(), Status::truncated) << n;
}

TEST(MediaHeader, RefusesWhatIsForbidden) {
    const auto with = [](std::size_t at, int value) {
        Bytes bytes = message(sample_header(1));
        bytes[at] = std::byte(value);
        return parse_media_header(bytes).error();
    };
    EXPECT_EQ(with(0, 2), Status::unsupported_version);
    EXPECT_EQ(with(2, 2), Status::malformed);   // unknown flag
    EXPECT_EQ(with(2, 1), Status::malformed);   // a key frame with a reference
    EXPECT_EQ(with(3, 8), Status::malformed);   // layer
    EXPECT_EQ(with(16, 2), Status::malformed);  // slice 2 of 2
    EXPECT_EQ(with(23, 0x10), Status::too_large);
    EXPECT_EQ(with(39, 0x7f), Status::malformed);  // a time beyond all sense
    EXPECT_EQ(with(63, 1), Status::malformed);     // reserved
    Bytes longer = message(sample_header(1));
    longer.push_back({});
    EXPECT_EQ(parse_media_header(longer).error(), Status::trailing_bytes);
}

TEST(MediaHeader, SentCanBeStampedLater) {
    Bytes bytes = message(sample_header(0));
    stamp_sent(bytes, from_us(40000));
    EXPECT_EQ(parse_media_header(bytes)->sent, from_us(40000));
}

Bytes numbered(std::size_t size) {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = std::byte(i * 7);
    return bytes;
}

TEST(Envelope, MediaOfAnySizeComesBackWhole) {
    Unwrapper unwrapper;
    for (const std::size_t size :
         {std::size_t(1), max_chunk_size, max_chunk_size + 1, std::size_t(100'000)}) {
        const Bytes media = numbered(size);
        Bytes envelope;
        for (std::size_t at = 0; at < size;) {
            at = wrap_chunk(media, at, envelope);
            EXPECT_LE(envelope.size(), max_chunk_size + chunk_header_size);
            const auto got = unwrapper.take(envelope);
            ASSERT_TRUE(got);
            if (at < size) {
                EXPECT_FALSE(got->media);
            } else {
                ASSERT_TRUE(got->media);
                EXPECT_EQ(*got->media, media);
                *got->media = {};  // it may be taken away
            }
        }
    }
}

TEST(Envelope, ControlComesBetweenChunks) {
    const Bytes media = numbered(max_chunk_size + 10);
    Unwrapper unwrapper;
    Bytes envelope;
    const std::size_t next = wrap_chunk(media, 0, envelope);
    ASSERT_TRUE(unwrapper.take(envelope));
    const Bytes control = numbered(4);
    const Bytes wrapped = wrap_control(control);
    const auto got = unwrapper.take(wrapped);
    ASSERT_TRUE(got);
    EXPECT_EQ(Bytes(got->control.begin(), got->control.end()), control);
    wrap_chunk(media, next, envelope);
    EXPECT_EQ(unwrapper.take(envelope)->media->size(), media.size());
}

TEST(Envelope, MediaThatIsNotTakenIsRefusedAtItsFirstChunk) {
    Unwrapper unwrapper(Unwrapper::Takes::all_but_media);
    Bytes envelope;
    wrap_chunk(numbered(100'000), 0, envelope);
    EXPECT_EQ(unwrapper.take(envelope).error(), Status::unsupported);
    EXPECT_TRUE(unwrapper.take(wrap_control(numbered(10))));
}

TEST(Envelope, RefusesWhatDoesNotContinue) {
    const Bytes media = numbered(3 * max_chunk_size);
    Bytes first, second;
    const std::size_t next = wrap_chunk(media, 0, first);
    wrap_chunk(media, next, second);

    Unwrapper skipped;
    EXPECT_EQ(skipped.take(second).error(), Status::malformed);
    Unwrapper repeated;
    ASSERT_TRUE(repeated.take(first));
    EXPECT_EQ(repeated.take(first).error(), Status::malformed);
    Unwrapper other_total;
    ASSERT_TRUE(other_total.take(first));
    store_le(second.data() + 5, std::uint32_t(media.size() + 1));
    EXPECT_EQ(other_total.take(second).error(), Status::malformed);
    Unwrapper huge;
    store_le(first.data() + 5, std::uint32_t(0xffffffff));
    EXPECT_EQ(huge.take(first).error(), Status::too_large);
    Unwrapper any;
    EXPECT_EQ(any.take({}).error(), Status::truncated);
    EXPECT_EQ(any.take(Bytes{std::byte{1}}).error(), Status::truncated);
    EXPECT_EQ(any.take(Bytes(chunk_header_size, std::byte{2})).error(), Status::truncated);
    EXPECT_EQ(any.take(Bytes{std::byte{9}}).error(), Status::malformed);
}

Bytes bytes_of(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values)
        bytes.push_back(std::byte(value));
    return bytes;
}

// The test vectors of docs/formats/connection.md.
TEST(Envelope, BytesAreAsSpecified) {
    const Bytes one = bytes_of({0xaa, 0xbb}), other = bytes_of({0xcc});
    Bytes out;
    ASSERT_TRUE(append_state({{StateTopic::pose, 0x01020304}, one}, out));
    ASSERT_TRUE(append_state({{StateTopic::pose, 7}, other}, out));
    EXPECT_EQ(out, bytes_of({3, 1, 4, 3, 2, 1, 2, 0, 0xaa, 0xbb, 1, 7, 0, 0, 0, 1, 0, 0xcc}));
    wrap_voice({ParticipantId{0x01020304}, one}, out);
    EXPECT_EQ(out, bytes_of({4, 4, 3, 2, 1, 0xaa, 0xbb}));
    wrap_acknowledgement({0x0102030405060708, Duration(500)}, out);
    EXPECT_EQ(out, bytes_of({5, 8, 7, 6, 5, 4, 3, 2, 1, 0xf4, 1, 0, 0}));
}

TEST(Envelope, StatesVoiceAndAcknowledgementsComeBack) {
    Unwrapper unwrapper(Unwrapper::Takes::all_but_media);
    const Bytes body = numbered(max_state_size), packet = numbered(max_voice_size);
    Bytes out;
    std::uint32_t count = 0;
    while (append_state({{StateTopic::pose, count}, body}, out))
        ++count;
    EXPECT_GE(count, 7u);
    EXPECT_LE(out.size(), max_states_size);
    auto got = unwrapper.take(out);
    ASSERT_TRUE(got);
    StateReader reader(got->states);
    State state;
    for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_TRUE(reader.next(state));
        EXPECT_EQ(state.key, (StateKey{StateTopic::pose, i}));
        EXPECT_TRUE(std::equal(body.begin(), body.end(), state.body.begin(), state.body.end()));
    }
    EXPECT_FALSE(reader.next(state));

    wrap_voice({ParticipantId{9}, packet}, out);
    got = unwrapper.take(out);
    ASSERT_TRUE(got && got->voice);
    EXPECT_EQ(got->voice->speaker, ParticipantId{9});
    EXPECT_EQ(got->voice->packet.size(), packet.size());

    wrap_acknowledgement({1ull << 40, 3ms}, out);
    got = unwrapper.take(out);
    ASSERT_TRUE(got && got->acknowledgement);
    EXPECT_EQ(*got->acknowledgement, (Acknowledgement{1ull << 40, 3ms}));
}

TEST(Envelope, RefusesDamagedStatesVoiceAndAcknowledgements) {
    const Bytes body = numbered(5);
    Bytes states, voice, word;
    append_state({{StateTopic::pose, 1}, body}, states);
    append_state({{StateTopic::pose, 2}, body}, states);
    wrap_voice({ParticipantId{9}, body}, voice);
    wrap_acknowledgement({1, {}}, word);
    Unwrapper unwrapper;
    const std::size_t first = 1 + 7 + body.size();
    for (std::size_t n = 1; n < states.size(); ++n)
        EXPECT_EQ(bool(unwrapper.take(ByteView(states).first(n))), n == first) << n;
    for (std::size_t n = 1; n <= 5; ++n)
        EXPECT_FALSE(unwrapper.take(ByteView(voice).first(n))) << n;
    for (std::size_t n = 1; n < word.size(); ++n)
        EXPECT_FALSE(unwrapper.take(ByteView(word).first(n))) << n;
    word.push_back({});
    EXPECT_EQ(unwrapper.take(word).error(), Status::trailing_bytes);
    Bytes empty_state = states;
    store_le(empty_state.data() + 6, std::uint16_t(0));
    EXPECT_EQ(unwrapper.take(empty_state).error(), Status::malformed);
    EXPECT_EQ(unwrapper.take(Bytes(max_states_size + 1, std::byte{3})).error(), Status::too_large);
    EXPECT_EQ(unwrapper.take(Bytes(max_voice_size + 6, std::byte{4})).error(), Status::too_large);
}

// Encodes and decodes in the direction of the message.
Result<ToHost> decoded_again(const ToHost& m) {
    return decode_to_host(encode(m));
}
Result<ToParticipant> decoded_again(const ToParticipant& m) {
    return decode_to_participant(encode(m));
}

Result<ToParticipant> decoded_again(const CameraState& m) {
    return decoded_again(ToParticipant(m));
}

template <class T>
T round_trip(const T& m) {
    const auto decoded = decoded_again(m);
    EXPECT_TRUE(decoded);
    EXPECT_TRUE(std::holds_alternative<T>(*decoded));
    return std::get<T>(*decoded);
}

TEST(Control, EveryMessageRoundTrips) {
    const Join join = round_trip(Join{1,
                                      2,
                                      "secret",
                                      "Dr. A",
                                      "trvl",
                                      "jpeg",
                                      150,
                                      9000,
                                      true,
                                      {Feature::publish, Feature{999}},
                                      numbered(16)});
    EXPECT_EQ(join.features, (std::vector{Feature::publish, Feature{999}}));
    EXPECT_EQ(join.person, numbered(16));
    EXPECT_FALSE(decoded_again(Join{1, 2, "", "", "", "", 0, 0, false, {}, numbered(15)}));
    EXPECT_EQ(join.protocol_max, 2);
    EXPECT_EQ(join.token, "secret");
    EXPECT_EQ(join.name, "Dr. A");
    EXPECT_EQ(join.depth_codec + join.color_codec, "trvljpeg");
    EXPECT_EQ(join.target_latency_ms, 150u);
    EXPECT_EQ(join.max_kbit_per_s, 9000u);
    EXPECT_TRUE(join.records);
    EXPECT_EQ(round_trip(ChooseDelivery{100, 5000}).max_kbit_per_s, 5000u);
    const Delivery delivery = round_trip(
        Delivery{2, 6, 4, "jpeg:quality=60", true, {TextCode::frames_were_late, {"312"}}});
    EXPECT_EQ(int(delivery.level) * 10 + delivery.levels, 26);
    EXPECT_EQ(
        sent_part(delivery),
        "a quarter of the frames, colour as jpeg:quality=60, bounded loss outside the region");
    EXPECT_EQ(english(delivery.reason), "frames took 312 ms to arrive");
    const std::vector<CameraId> cameras{CameraId{3}, CameraId{0x7fff}};
    EXPECT_EQ(round_trip(ChooseCodecs{"rvl", "", cameras}).depth_codec, "rvl");
    EXPECT_EQ(round_trip(ChooseCodecs{"rvl", "", cameras}).cameras, cameras);
    const Publish offer =
        round_trip(Publish{{{"face", true, 30, numbered(5), true, CameraKind::person}}});
    EXPECT_EQ(offer.cameras.at(0).kind, CameraKind::person);
    EXPECT_FALSE(
        decode_to_host(encode(Publish{{{"face", true, 30, numbered(5), true, CameraKind{4}}}})));
    EXPECT_EQ(round_trip(Publish{{{"mine", true, 8, numbered(5), false, CameraKind::screen}}})
                  .cameras.at(0)
                  .kind,
              CameraKind::screen);
    ASSERT_EQ(offer.cameras.size(), 1u);
    EXPECT_EQ(offer.cameras[0].name, "face");
    EXPECT_EQ(offer.cameras[0].calibration, numbered(5));
    EXPECT_EQ(round_trip(Unpublish{cameras}).cameras, cameras);
    EXPECT_EQ(round_trip(CamerasRemoved{cameras}).cameras, cameras);
    EXPECT_FALSE(round_trip(CamerasRemoved{cameras}).interrupted);
    EXPECT_TRUE(round_trip(CamerasRemoved{cameras, true}).interrupted);
    EXPECT_EQ(round_trip(Published{cameras, {}}).cameras, cameras);
    EXPECT_EQ(round_trip(Published{cameras, as_written("no")}).problem, as_written("no"));
    const CamerasAdded added = round_trip(CamerasAdded{{{CameraId{9},
                                                         "a",
                                                         StreamId{18},
                                                         StreamId{19},
                                                         true,
                                                         30,
                                                         {},
                                                         ParticipantId{4},
                                                         SessionId{7},
                                                         true,
                                                         CameraKind::person}}});
    EXPECT_EQ(added.cameras.at(0).kind, CameraKind::person);
    EXPECT_EQ(added.cameras.at(0).session, SessionId{7});
    ASSERT_EQ(added.cameras.size(), 1u);
    EXPECT_EQ(added.cameras[0].publisher, ParticipantId{4});
    EXPECT_EQ(round_trip(Encode{{{StreamId{18}, SettingId{2}, "raw"}}}).settings[0].codec, "raw");
    EXPECT_EQ(round_trip(EncodeKey{StreamId{18}, SettingId{2}}).setting, SettingId{2});
    EXPECT_EQ(std::get<CameraState>(
                  *decoded_again(ToHost(CameraState{CameraId{1}, {}, as_written("gone"), ""})))
                  .problem,
              as_written("gone"));
    EXPECT_EQ(round_trip(RequestKey{StreamId{3}, SettingId{4}}).setting, SettingId{4});
    EXPECT_EQ(round_trip(Ping{from_us(-5)}).sent, from_us(-5));
    const Report report = round_trip(Report{{{StreamId{1}, 2, 3, 4, Duration(5)}}, "blend"});
    EXPECT_EQ(report.renderer, "blend");
    EXPECT_EQ(round_trip(SetRenderer{"mesh", true}), (SetRenderer{"mesh", true}));
    EXPECT_EQ(round_trip(Goodbye{{TextCode::session_over}}).reason.code, TextCode::session_over);
    ASSERT_EQ(report.streams.size(), 1u);
    EXPECT_EQ(report.streams[0].bytes, 4u);
    EXPECT_EQ(report.streams[0].age, Duration(5));
    const Welcome welcome = round_trip(
        Welcome{1,
                ParticipantId{7},
                "OR 3",
                {{CameraId{0}, "left", StreamId{0}, StreamId{1}, true, 30, numbered(9)}}});
    ASSERT_EQ(welcome.cameras.size(), 1u);
    EXPECT_EQ(welcome.cameras[0].calibration, numbered(9));
    EXPECT_EQ(welcome.cameras[0].color_stream, StreamId{1});
    const Refused no = round_trip(refused({TextCode::host_too_old, {"3", "4"}}));
    EXPECT_EQ(no.reason, (Text{TextCode::host_too_old, {"3", "4"}}));
    EXPECT_EQ(no.in_english, english(no.reason));
    const Manage decision =
        round_trip(Manage{9, ManageAction::set_role, ParticipantId{4}, Role::observer});
    EXPECT_EQ(decision.number, 9u);
    EXPECT_EQ(decision.action, ManageAction::set_role);
    EXPECT_EQ(decision.participant, ParticipantId{4});
    EXPECT_EQ(decision.role, Role::observer);
    EXPECT_EQ(round_trip(Waiting{"OR 3"}).host_name, "OR 3");
    EXPECT_EQ(round_trip(Standing{Role::operator_, true}), (Standing{Role::operator_, true}));
    const std::vector<Visitor> visitors{{ParticipantId{5}, "Ada", numbered(4), Role::expert}};
    EXPECT_EQ(round_trip(Visitors{visitors}).visitors, visitors);
    EXPECT_EQ(round_trip(Managed{9, ManageRefusal::yourself}).refusal, ManageRefusal::yourself);
    EXPECT_EQ(round_trip(Managed{9, ManageRefusal::nothing_to_play}).refusal,
              ManageRefusal::nothing_to_play);
    const AdjustCamera adjusting = round_trip(AdjustCamera{4, CameraId{7}, Bytes(33)});
    EXPECT_EQ(adjusting.camera, CameraId{7});
    EXPECT_EQ(adjusting.adjustment, Bytes(33));
    const Play seek = round_trip(Play{5, PlayAction::seek, 90s});
    EXPECT_EQ(seek.action, PlayAction::seek);
    EXPECT_EQ(seek.position, 90s);
    const LookBack back = round_trip(LookBack{6, 20s});
    EXPECT_EQ(back.number, 6u);
    EXPECT_EQ(back.ago, 20s);
    EXPECT_EQ(decode_to_host(encode(ToHost(LookBack{6, -1s}))).error(),
              theatron::Status::malformed);
    const StreamSetting past{StreamId{4}, SettingId{9}, "trvl", true};
    EXPECT_EQ(round_trip(Settings{{past}, {}}).settings, std::vector{past});
    const Playback playback{3s, from_us(12), 60s, true, "Anna"};
    EXPECT_EQ(round_trip(playback), playback);
    const ShareEnded ended = round_trip(ShareEnded{{CameraId{3}, CameraId{9}}, "Dora"});
    EXPECT_EQ(ended.cameras, (std::vector{CameraId{3}, CameraId{9}}));
    EXPECT_EQ(ended.by, "Dora");
    const Patient patient{numbered(content_hash_size), "Doe, Jane", "1961-02-03", "AB-4711",
                          "2026-03-01"};
    EXPECT_EQ(round_trip(patient), patient);
    EXPECT_EQ(round_trip(Patient{}), Patient{});
    EXPECT_EQ(decode_to_participant(encode(Patient{Bytes(31), "", "", "", ""})).error(),
              theatron::Status::malformed);
    EXPECT_EQ(round_trip(AskPatient{patient.of_case}).of_case, patient.of_case);
    EXPECT_EQ(round_trip(AskedPatient{patient}).patient, patient);
    StudyStep step{4,
                   31,
                   StudyKind::rating,
                   {{"How was it?"}, {"Think of all."}},
                   {{"never"}},
                   "not at all",
                   "very much",
                   -3,
                   3,
                   2,
                   5s,
                   9s,
                   "Choose a point."};
    EXPECT_EQ(round_trip(step), step);
    EXPECT_EQ(round_trip(ShowStudy{8, ParticipantId{3}, step}).step, step);
    const StudyReply skip{4, StudyAction::skip, -7};
    EXPECT_EQ(round_trip(skip), skip);
    EXPECT_EQ(round_trip(StudyReplied{ParticipantId{3}, skip}),
              (StudyReplied{ParticipantId{3}, skip}));
    const SetCondition late{9, ParticipantId{3}, "mesh", "rvl", "jpeg", 80ms, true};
    EXPECT_EQ(round_trip(late), late);
    const WriteChat written{77, "Bitte, die Leuchte"};
    EXPECT_EQ(round_trip(written), written);
    EXPECT_EQ(round_trip(WriteChat{77, std::string(max_chat_text + 1, 'a')}).text.size(),
              max_chat_text);
    EXPECT_TRUE(round_trip(RaiseHand{true}).raised);
    const ChatMessage message{77, ParticipantId{3}, "Ada", "Bitte", from_us(5)};
    EXPECT_EQ(round_trip(ChatMessages{{message, message}}).messages,
              (std::vector{message, message}));
    EXPECT_FALSE(
        decoded_again(ChatMessages{std::vector<ChatMessage>(max_chat_messages + 1, message)}));
    step.step_size = 0;
    EXPECT_EQ(decode_to_participant(encode(ToParticipant(step))).error(),
              theatron::Status::malformed);
    step.step_size = 1;
    step.highest = -4;
    EXPECT_EQ(decode_to_participant(encode(ToParticipant(step))).error(),
              theatron::Status::malformed);
    EXPECT_EQ(decode_to_host(encode(ToHost(StudyReply{4, StudyAction{4}, 0}))).error(),
              theatron::Status::malformed);
    EXPECT_EQ(decode_to_host(encode(ToHost(SetCondition{9, {}, "", "", "", 6s, false}))).error(),
              theatron::Status::malformed);
    EXPECT_EQ(decode_to_host(encode(ToHost(AskPatient{Bytes(31)}))).error(),
              theatron::Status::malformed);
    EXPECT_EQ(decode_to_participant(encode(ToParticipant(AskedPatient{}))).error(),
              theatron::Status::malformed)
        << "an answer says to which case it belongs";
    const OfferRelay listening =
        round_trip(OfferRelay{{"192.0.2.7", "2001:db8::7"}, 40123, numbered(fingerprint_size)});
    EXPECT_EQ(listening.addresses, (std::vector<std::string>{"192.0.2.7", "2001:db8::7"}));
    EXPECT_EQ(listening.port, 40123);
    EXPECT_EQ(listening.fingerprint, numbered(fingerprint_size));
    const RelayGrants grants{{{ParticipantId{4},
                               {"192.0.2.7"},
                               40123,
                               numbered(fingerprint_size),
                               numbered(relay_secret_size)}}};
    EXPECT_EQ(round_trip(grants), grants);
    const RelayReceivers receivers{{{numbered(relay_secret_size), {SettingId{3}, SettingId{9}}}},
                                   {SettingId{9}}};
    EXPECT_EQ(round_trip(receivers), receivers);
    EXPECT_FALSE(decoded_again(OfferRelay{{"192.0.2.7"}, 40123, Bytes(31)}));
    EXPECT_FALSE(decoded_again(RelayReceivers{{{Bytes(31), {}}}, {}}));
    EXPECT_FALSE(decoded_again(RelayGrants{{{{}, {}, 1, numbered(32), Bytes(33)}}}));
    EXPECT_EQ(round_trip(Report{{{StreamId{2}, 7, 8, 9, Duration(5), SettingId{3}}}, ""})
                  .streams.at(0)
                  .relayed,
              SettingId{3});
    CameraChanged change;
    change.camera.id = CameraId{3};
    change.camera.adjustment = Bytes(33);
    EXPECT_EQ(round_trip(change).camera.adjustment, Bytes(33));
    for (const ToHost& wrong :
         {ToHost(Play{1, PlayAction{0}, {}}), ToHost(Play{1, PlayAction{4}, {}}),
          ToHost(AdjustCamera{1, {}, Bytes(max_adjustment_size + 1)})})
        EXPECT_EQ(decode_to_host(encode(wrong)).error(), theatron::Status::malformed);
    for (const ToHost& wrong :
         {ToHost(Manage{1, ManageAction{0}, {}, {}}), ToHost(Manage{1, ManageAction{11}, {}, {}}),
          ToHost(Manage{1, ManageAction::mute, {}, Role{4}})})
        EXPECT_FALSE(decoded_again(wrong));
    const Settings settings =
        round_trip(Settings{{{StreamId{1}, SettingId{2}, "rvl"}}, as_written("busy")});
    ASSERT_EQ(settings.settings.size(), 1u);
    EXPECT_EQ(settings.settings[0].codec, "rvl");
    EXPECT_EQ(settings.note, as_written("busy"));
    EXPECT_EQ(round_trip(CameraState{CameraId{1}, {}, {}, "kalman"}).filter, "kalman");
    EXPECT_EQ(round_trip(CameraState{CameraId{1}, {}, {}, "kalman", "cpu"}).filter_device, "cpu");
    EXPECT_EQ(round_trip(CameraState{CameraId{1}, CameraCondition::failed, as_written("gone"), ""})
                  .problem,
              as_written("gone"));
    EXPECT_EQ(round_trip(Pong{from_us(1), from_us(2), from_us(3)}).sent, from_us(3));
}

// Programs of the same protocol may be older and know fewer kinds.
TEST(Control, AMessageOfAnUnknownKindIsToldFromDamage) {
    using LastKind =
        std::variant_alternative_t<std::variant_size_v<ToParticipant> - 1, ToParticipant>;
    const Bytes known = encode(LastKind{});
    const auto kind = std::byte(std::variant_size_v<ToParticipant>);
    int unknown = 0;
    for (std::size_t at = 0; at < known.size(); ++at) {
        if (known[at] != kind)
            continue;  // it is the kind at one of the others
        Bytes bytes = known;
        bytes[at] = std::byte(int(kind) + 1);
        unknown += decode_to_participant(bytes).error() == Status::unsupported;
    }
    EXPECT_EQ(unknown, 1);
}

// As a participant of protocol 1 said it: the token "t", the name "n", depth as raw.
TEST(Control, AHostUnderstandsTheJoinOfProtocol1) {
    const unsigned char said[] = {
        0x0c, 0x00, 0x00, 0x00, 0x08, 0x00, 0x0e, 0x00, 0x07, 0x00, 0x08, 0x00, 0x08, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0x01, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0e, 0x00,
        0x14, 0x00, 0x04, 0x00, 0x06, 0x00, 0x08, 0x00, 0x0c, 0x00, 0x10, 0x00, 0x0e, 0x00,
        0x00, 0x00, 0x01, 0x00, 0x01, 0x00, 0x1c, 0x00, 0x00, 0x00, 0x10, 0x00, 0x00, 0x00,
        0x04, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x72, 0x61, 0x77, 0x00, 0x01, 0x00,
        0x00, 0x00, 0x6e, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x74, 0x00, 0x00, 0x00,
    };
    const auto decoded = decode_to_host(std::as_bytes(std::span(said)));
    ASSERT_TRUE(decoded);
    const Join& join = std::get<Join>(*decoded);
    EXPECT_EQ(join.protocol_max, 1);
    EXPECT_EQ(join.token + join.name + join.depth_codec, "tnraw");
}

TEST(Control, RefusesDamage) {
    const Bytes whole = encode(Join{1, 1, "t", "n", "trvl", "jpeg"});
    for (std::size_t n = 0; n < whole.size() / 2; ++n)
        EXPECT_FALSE(decode_to_host(ByteView(whole).first(n)));
    EXPECT_FALSE(decode_to_host(numbered(100)));
    EXPECT_FALSE(decode_to_participant(numbered(100)));
    EXPECT_FALSE(decoded_again(CameraState{CameraId{1}, CameraCondition(9), {}, ""}));
}

TEST(Control, TextsAreCleanAndCutToTheirLimits) {
    const std::string long_name = "OP 3, " + std::string(90, 'x') + "ü";
    const std::string bad = "a\xff\x1b[2J\xc2\x9b" + std::string(60'000, 'x');
    const Join join = round_trip(Join{1, 1, bad, "Überwachungsplatz " + long_name, bad, bad});
    EXPECT_EQ(join.name, ("Überwachungsplatz " + long_name).substr(0, max_name + 1));
    EXPECT_EQ(join.token.substr(0, 9), "a\xef\xbf\xbd [2J ");
    const auto characters = [](const std::string& text) {
        return std::size_t(std::count_if(text.begin(), text.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        }));
    };
    EXPECT_EQ(characters(join.token), max_token);
    EXPECT_EQ(characters(join.depth_codec), max_codec);
    EXPECT_EQ(characters(join.color_codec), max_codec);
    const ChooseCodecs codecs = round_trip(ChooseCodecs{bad, bad});
    EXPECT_EQ(characters(codecs.depth_codec), max_codec);
    EXPECT_EQ(characters(codecs.color_codec), max_codec);
    EXPECT_EQ(characters(round_trip(Report{{}, bad}).renderer), max_renderer);
    EXPECT_EQ(characters(round_trip(SetRenderer{bad, true}).renderer), max_renderer);
    EXPECT_EQ(characters(round_trip(Refused{bad, {}}).in_english), max_sentence);
    EXPECT_EQ(characters(round_trip(Delivery{0, 1, 1, bad, false, {}}).color_codec), max_codec);
    const CameraState state = round_trip(CameraState{CameraId{1}, {}, as_written(bad), bad});
    EXPECT_EQ(characters(state.problem.arguments.at(0)), max_sentence);
    EXPECT_EQ(characters(state.filter), max_filter);
    const Welcome welcome =
        round_trip(Welcome{1, {}, bad, {{CameraId{0}, bad, {}, {}, true, 30, {}}}});
    EXPECT_EQ(characters(welcome.host_name), max_name);
    EXPECT_EQ(characters(welcome.cameras[0].name), max_name);
    const Settings settings = round_trip(Settings{{{StreamId{1}, SettingId{2}, bad}}, {}});
    EXPECT_EQ(characters(settings.settings[0].codec), max_codec);
}

TEST(Control, RefusesMoreThanItsLimits) {
    const auto accepted = [](const auto& m) { return bool(decoded_again(m)); };
    EXPECT_TRUE(accepted(Report{std::vector<StreamReport>(max_streams), ""}));
    EXPECT_FALSE(accepted(Report{std::vector<StreamReport>(max_streams + 1), ""}));
    const StreamSetting setting{StreamId{0}, SettingId{1}, "rvl"};
    EXPECT_TRUE(accepted(Settings{std::vector<StreamSetting>(max_streams, setting), {}}));
    EXPECT_FALSE(accepted(Settings{std::vector<StreamSetting>(max_streams + 1, setting), {}}));
    EXPECT_TRUE(accepted(Welcome{1, {}, "", std::vector<Camera>(max_cameras)}));
    EXPECT_FALSE(accepted(Welcome{1, {}, "", std::vector<Camera>(max_cameras + 1)}));
    EXPECT_TRUE(accepted(Goodbye{{TextCode{9}, std::vector<std::string>(max_text_arguments)}}));
    EXPECT_FALSE(
        accepted(Goodbye{{TextCode{9}, std::vector<std::string>(max_text_arguments + 1)}}));
    EXPECT_FALSE(accepted(Delivery{1, 2, 0, "", false, {}}));
    StudyStep step;
    step.texts.resize(max_study_texts);
    step.choices.resize(max_study_choices);
    EXPECT_TRUE(accepted(step));
    step.texts.emplace_back();
    EXPECT_FALSE(accepted(step));
    Camera camera;
    camera.calibration = numbered(max_calibration_size);
    EXPECT_TRUE(accepted(Welcome{1, {}, "", {camera}}));
    camera.calibration.push_back({});
    EXPECT_FALSE(accepted(Welcome{1, {}, "", {camera}}));
    // The largest form of a message is within the stated memory, also where its parts are shared.
    constexpr std::size_t bytes_a_character = 4;
    EXPECT_LE(max_cameras * (sizeof(Camera) + max_calibration_size + bytes_a_character * max_name),
              max_decoded_size);
    EXPECT_LE(max_streams * (sizeof(StreamSetting) + bytes_a_character * max_codec),
              max_decoded_size);
    EXPECT_LE((max_study_texts + max_study_choices + 2) *
                  (sizeof(StudyText) + bytes_a_character * max_study_text),
              max_decoded_size);
}

TEST(Control, RefusesASettingWithoutANumber) {
    EXPECT_FALSE(decoded_again(Settings{{{StreamId{0}, SettingId{0}, "rvl"}}, {}}));
}

}  // namespace
}  // namespace theatron::wire
