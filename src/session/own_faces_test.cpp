// SPDX-License-Identifier: Apache-2.0
#include "session/own_faces.h"

#include "session/face_upload.h"
#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using wire::OwnFace;

// A stand-in for SHA-256: the sum and the number of the bytes.
class Sum : public ContentDigest {
public:
    void add(ByteView piece) override {
        for (const std::byte one : piece)
            sum_ += std::to_integer<std::uint32_t>(one);
        count_ += std::uint32_t(piece.size());
    }
    ContentHash finish() override {
        ContentHash hash;
        for (std::size_t i = 0; i < 4; ++i) {
            hash.bytes[i] = std::byte(sum_ >> (8 * i));
            hash.bytes[4 + i] = std::byte(count_ >> (8 * i));
        }
        return hash;
    }

private:
    std::uint32_t sum_ = 0, count_ = 0;
};

ContentHash sum_of(ByteView bytes) {
    Sum sum;
    sum.add(bytes);
    return sum.finish();
}

Bytes some_face(std::size_t size, int seed = 1) {
    Bytes face(size);
    for (std::size_t i = 0; i < size; ++i)
        face[i] = std::byte((i * std::size_t(seed) + 7) % 251);
    return face;
}

class OwnFacesTest : public Host {
protected:
    OwnFacesTest() : hall(with_digest()) {
        for (const ParticipantId id : {alice, bob})
            enter(id);
        hall.take_actions();
    }
    static HostSession::Config with_digest() {
        HostSession::Config made = config();
        made.admission.tokens.push_back({"watch", Role::observer, {}});
        made.make_digest = [] { return std::make_unique<Sum>(); };
        return made;
    }
    void enter(ParticipantId id, const std::string& token = "secret", bool records = false) {
        hall.on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.records = records;
        hall.on_control(id, wire::encode(hello), now);
    }
    bool put(ParticipantId id, const FaceUpload::Piece& piece) {
        const bool is_face = piece.topic == wire::StateTopic::own_face;
        return hall.on_own_face(
            id, {{piece.topic, is_face ? std::uint32_t(id) : piece.place}, piece.body}, now);
    }
    bool offer(ParticipantId id, const Bytes& face) {
        const OwnFace offered{OwnFace::Kind::offered, std::uint32_t(face.size()), sum_of(face)};
        return put(id, {wire::StateTopic::own_face, 0, wire::encode_own_face(offered)});
    }
    // News of faces for each participant since the last call, with their owners.
    using Told = std::vector<std::pair<ParticipantId, OwnFace>>;
    std::map<ParticipantId, Told> told() {
        std::map<ParticipantId, Told> result;
        for (const auto& sent : actions_of<action::SendState>(hall.take_actions()))
            result[sent.participant].push_back(
                {ParticipantId(sent.key.id), *wire::decode_own_face(sent.body)});
        return result;
    }
    // Until nothing is to be sent any more. The number of groups.
    int upload(ParticipantId id, FaceUpload& from) {
        int groups = 0;
        for (int i = 0; i < 2000 && from.state() == FaceUpload::State::sending; ++i) {
            const auto pieces = from.take(now);
            for (const auto& piece : pieces)
                EXPECT_TRUE(put(id, piece));
            groups += !pieces.empty() && pieces[0].topic == wire::StateTopic::face_piece;
            for (const auto& sent : actions_of<action::SendState>(hall.take_actions())) {
                if (sent.participant == id && sent.key.id == std::uint32_t(id))
                    from.on_answer(sent.body, now);
                else
                    told_others.push_back(sent);
            }
            now += std::chrono::milliseconds(100);
        }
        return groups;
    }
    void show(ParticipantId id, const Bytes& face) {
        FaceUpload from;
        from.show(std::make_shared<const Bytes>(face), sum_of(face));
        from.on_joined();
        upload(id, from);
        EXPECT_EQ(from.state(), FaceUpload::State::there);
    }
    std::vector<action::SendContent> ask(ParticipantId id, const Bytes& face) {
        const ContentHash hash = sum_of(face);
        wire::RequestContent request{Bytes(hash.bytes.begin(), hash.bytes.end()), 0, 1000};
        hall.on_control(id, wire::encode(request), now);
        return actions_of<action::SendContent>(hall.take_actions());
    }

    HostSession hall;
    std::vector<action::SendState> told_others;
};

TEST_F(OwnFacesTest, AFaceIsToldWhenItIsWholeAndSentToThoseWhoAsk) {
    const Bytes face = some_face(20'000);
    FaceUpload from;
    from.show(std::make_shared<const Bytes>(face), sum_of(face));
    from.on_joined();
    EXPECT_EQ(upload(alice, from), 3);  // groups of 7168 bytes
    EXPECT_EQ(from.state(), FaceUpload::State::there);
    ASSERT_EQ(told_others.size(), 1u);
    EXPECT_EQ(told_others[0].participant, bob);
    EXPECT_EQ(told_others[0].key.id, std::uint32_t(alice));
    EXPECT_EQ(*hall.own_face(sum_of(face)), face);
    ASSERT_EQ(ask(bob, face).size(), 1u);
    // One who comes later is told, too; a recorder is neither told nor gets it.
    enter(carol);
    EXPECT_EQ(told()[carol].size(), 1u);
    enter(dave, "secret", true);
    EXPECT_TRUE(told()[dave].empty());
    EXPECT_TRUE(ask(dave, face).empty());
}

TEST_F(OwnFacesTest, ItIsForgottenWithItsOwnerAndWhenItsOwnerSaysSo) {
    const Bytes face = some_face(3000), other = some_face(9000, 3);
    show(alice, face);
    told();
    put(alice, {wire::StateTopic::own_face, 0, wire::encode_own_face({})});
    EXPECT_EQ(hall.own_face(sum_of(face)), nullptr);
    auto now_told = told();
    ASSERT_EQ(now_told[bob].size(), 1u);
    EXPECT_EQ(now_told[bob][0].second.kind, OwnFace::Kind::none);
    show(alice, face);
    show(alice, other);  // in place of the first
    EXPECT_EQ(hall.own_face(sum_of(face)), nullptr);
    told();
    hall.on_closed(alice);
    EXPECT_EQ(hall.own_face(sum_of(other)), nullptr);
    now_told = told();
    ASSERT_EQ(now_told[bob].size(), 1u);
    EXPECT_EQ(now_told[bob][0].first, alice);
    EXPECT_EQ(now_told[bob][0].second.kind, OwnFace::Kind::none);
    enter(carol);
    EXPECT_TRUE(told()[carol].empty());
}

TEST_F(OwnFacesTest, ObserversShowNoneAndLoseTheirs) {
    const Bytes face = some_face(3000);
    enter(carol, "watch");
    told();
    EXPECT_TRUE(offer(carol, face));
    auto answers = told();
    ASSERT_EQ(answers[carol].size(), 1u);
    EXPECT_EQ(answers[carol][0].second.kind, OwnFace::Kind::none);
    show(alice, face);
    hall.manage({0, wire::ManageAction::set_role, alice, Role::observer}, now);
    EXPECT_EQ(hall.own_face(sum_of(face)), nullptr);
    // They see those of others.
    show(bob, face);
    EXPECT_EQ(ask(carol, face).size(), 1u);
}

TEST_F(OwnFacesTest, WhatIsNotAsItWasOfferedIsRefused) {
    const Bytes face = some_face(2000), other = some_face(2000, 5);
    EXPECT_TRUE(offer(alice, face));
    told();
    const auto piece = [&](std::uint32_t place, std::size_t size) {
        return put(alice, {wire::StateTopic::face_piece, place,
                           Bytes(other.begin(), other.begin() + std::ptrdiff_t(size))});
    };
    EXPECT_TRUE(piece(500, 100));  // behind one that is missing
    EXPECT_TRUE(told().empty());
    EXPECT_TRUE(piece(0, 1000));
    EXPECT_TRUE(piece(1000, 1000));  // another sum
    auto answers = told();
    ASSERT_EQ(answers[alice].size(), 1u);
    EXPECT_EQ(answers[alice][0].second.kind, OwnFace::Kind::none);
    EXPECT_EQ(hall.own_face(sum_of(face)), nullptr);
    EXPECT_EQ(answers.count(bob), 0u);
    // More than was offered.
    EXPECT_TRUE(offer(alice, Bytes(10)));
    EXPECT_TRUE(piece(0, 11));
    EXPECT_EQ(told()[alice].back().second.kind, OwnFace::Kind::none);
    // Damaged, and in the name of somebody else.
    EXPECT_TRUE(put(alice, {wire::StateTopic::own_face, 0, Bytes(5, std::byte(1))}));
    const OwnFace offered{OwnFace::Kind::offered, 2000, sum_of(face)};
    EXPECT_TRUE(hall.on_own_face(
        alice, {{wire::StateTopic::own_face, std::uint32_t(bob)}, wire::encode_own_face(offered)},
        now));
    EXPECT_TRUE(told().empty());
}

TEST_F(OwnFacesTest, FloodsEndAndNewFacesAreLimited) {
    int taken = 0;
    for (int i = 0; i < 10; ++i) {
        EXPECT_TRUE(offer(alice, some_face(1000 + std::size_t(i))));
        taken += told()[alice].back().second.kind == OwnFace::Kind::received;
    }
    EXPECT_EQ(taken, 4);
    int put_well = 0;
    for (int i = 0; i < 2000; ++i)
        put_well += put(alice, {wire::StateTopic::face_piece, 7, Bytes(1)});
    EXPECT_LT(put_well, 700);
}

TEST(FaceUpload, ASlowConnectionKeepsMostOfItsTimeForOtherThings) {
    const Bytes face = some_face(50'000);
    const OwnFace known{OwnFace::Kind::received, 0, sum_of(face)};
    FaceUpload from;
    from.show(std::make_shared<const Bytes>(face), sum_of(face));
    from.on_joined();
    TimePoint now = from_us(1'000'000);
    ASSERT_EQ(from.take(now).size(), 1u);
    from.on_answer(wire::encode_own_face(known), now);
    now += std::chrono::milliseconds(100);
    ASSERT_EQ(from.take(now).size(), wire::own_face_group);
    EXPECT_TRUE(from.take(now + std::chrono::seconds(1)).empty());  // no answer yet
    // A group that took 1 s is followed by three times as long without one.
    OwnFace got = known;
    got.bytes = 7168;
    from.on_answer(wire::encode_own_face(got), now + std::chrono::seconds(1));
    EXPECT_TRUE(from.take(now + std::chrono::milliseconds(3900)).empty());
    EXPECT_FALSE(from.take(now + std::chrono::milliseconds(4100)).empty());
}

TEST(FaceUpload, AHostThatDoesNotAnswerIsAskedAFewTimes) {
    const Bytes face = some_face(100);
    FaceUpload from;
    from.show(std::make_shared<const Bytes>(face), sum_of(face));
    from.on_joined();
    int offers = 0;
    for (TimePoint now = from_us(1); now < from_us(60'000'000); now += std::chrono::seconds(1))
        offers += int(from.take(now).size());
    EXPECT_EQ(offers, FaceUpload::most_offers);
    EXPECT_EQ(from.state(), FaceUpload::State::unanswered);
    // Answers of a hostile host change nothing.
    from.on_answer(Bytes(3), from_us(1));
    from.on_answer(wire::encode_own_face({OwnFace::Kind::received, 101, sum_of(face)}), from_us(1));
    EXPECT_EQ(from.state(), FaceUpload::State::unanswered);
    from.show(nullptr, {});
    ASSERT_EQ(from.take(from_us(70'000'000)).size(), 1u);  // none any more
    EXPECT_EQ(from.state(), FaceUpload::State::none);
}

TEST(FaceUpload, AFaceThatIsRefusedIsOfferedAgainLater) {
    const Bytes face = some_face(100);
    FaceUpload from;
    from.show(std::make_shared<const Bytes>(face), sum_of(face));
    from.on_joined();
    const TimePoint now = from_us(1'000'000);
    ASSERT_EQ(from.take(now).size(), 1u);
    from.on_answer(wire::encode_own_face({}), now);
    EXPECT_EQ(from.state(), FaceUpload::State::refused);
    EXPECT_TRUE(from.take(now + std::chrono::seconds(14)).empty());
    ASSERT_EQ(from.take(now + std::chrono::seconds(16)).size(), 1u);
    from.on_answer(wire::encode_own_face({OwnFace::Kind::received, 100, sum_of(face)}),
                   now + std::chrono::seconds(16));
    EXPECT_EQ(from.state(), FaceUpload::State::there);
}

TEST(OwnFaceState, HasOneSpelling) {
    const OwnFace offered{OwnFace::Kind::offered, 1000, sum_of(some_face(1000))};
    const Bytes bytes = wire::encode_own_face(offered);
    EXPECT_EQ(bytes.size(), 37u);
    EXPECT_EQ(*wire::decode_own_face(bytes), offered);
    EXPECT_EQ(wire::encode_own_face({}).size(), 1u);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_EQ(wire::decode_own_face(ByteView(bytes).first(n)).error(), Status::truncated);
    Bytes changed = bytes;
    changed.push_back({});
    EXPECT_EQ(wire::decode_own_face(changed).error(), Status::trailing_bytes);
    changed = bytes;
    changed[0] = std::byte(3);
    EXPECT_EQ(wire::decode_own_face(changed).error(), Status::malformed);
    changed = bytes;
    changed[4] = std::byte(1);  // more than max_own_face_bytes
    EXPECT_EQ(wire::decode_own_face(changed).error(), Status::malformed);
}

}  // namespace
}  // namespace theatron::session
