// SPDX-License-Identifier: Apache-2.0
// Limits of a session that hold on whichever connections.
#include <set>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

using wire::TextCode;

class LastingLimits : public Host {
protected:
    // Each time on another connection. The reason of a refusal; none: it is in.
    TextCode come(int person, const std::string& color = "jpeg",
                  const std::string& token = "secret") {
        ++connection_;
        session.on_connected(self(), now);
        wire::Join hello;
        hello.token = token;
        hello.depth_codec = "trvl";
        hello.color_codec = color;
        hello.features = {wire::Feature::publish};
        hello.person = Bytes(wire::person_id_size);
        store_le(hello.person.data(), std::uint32_t(person));
        say(self(), hello);
        taken_ = session.take_actions();
        const auto refused = messages_to<wire::Refused>(self(), taken_);
        return refused.empty() ? TextCode::none : refused.front().reason.code;
    }
    ParticipantId self() const { return ParticipantId{connection_}; }
    void leave() { session.on_closed(self()); }
    void tick(Duration time) {
        for (const TimePoint end = now + time; now < end;) {
            now += 100ms;
            session.on_tick(now);
        }
    }
    void flood() {
        for (int i = 0; session.participants().at(self()).takes_part() && i < 5000; ++i)
            say(self(), wire::Ping{now});
    }

    std::uint32_t connection_ = 100;
    std::vector<Action> taken_;
};

TEST_F(LastingLimits, OneLinkBringsFewNewPeopleWhileOthersComeBack) {
    EXPECT_EQ(come(1), TextCode::none);
    tick(2s);
    leave();
    int in = 0;
    for (int i = 0; i < 500; ++i) {
        in += come(1000 + i) == TextCode::none;
        leave();
    }
    EXPECT_LE(in, int(LinkBudgets::newcomers.at_once));
    EXPECT_GT(in, 40);
    EXPECT_EQ(come(1), TextCode::none) << "she comes back";
}

TEST_F(LastingLimits, AFloodKeepsItsPersonOutForSomeSeconds) {
    EXPECT_EQ(come(1), TextCode::none);
    flood();
    EXPECT_EQ(messages_to<wire::Refused>(self(), session.take_actions()).size(), 1u);
    leave();
    EXPECT_EQ(come(1), TextCode::too_many_requests);
    EXPECT_EQ(come(2), TextCode::none);
    tick(LinkBudgets::flood_pause);
    EXPECT_EQ(come(1), TextCode::none);
}

TEST_F(LastingLimits, OffersOfCamerasCountOnEachConnection) {
    int offered = 0;
    for (int i = 0; i < 30; ++i) {
        ASSERT_EQ(come(1, "none", "publish"), TextCode::none) << i;
        for (int k = 0; k < 10; ++k) {
            wire::Publish offer;
            offer.cameras.push_back({"own", false, 30, config().cameras[0].calibration});
            say(self(), offer);
            const auto answers = messages_to<wire::Published>(self(), session.take_actions());
            if (answers.at(0).cameras.empty())
                continue;
            ++offered;
            say(self(), wire::Unpublish{answers[0].cameras});
        }
        leave();
        tick(1s);
    }
    EXPECT_LE(offered, LinkBudgets::own_offers.at_once + 30 * LinkBudgets::own_offers.per_second);
    EXPECT_GE(offered, int(LinkBudgets::own_offers.at_once));
}

// Each joins with another codec and leaves.
TEST_F(LastingLimits, ChangesOfEncodingsAreLimitedTogether) {
    join(alice, "trvl");
    (void)session.take_actions();
    const SettingId hers = session.color_settings().at(0).id;
    int changes = 0;
    for (int second = 0; second < 20; ++second) {
        for (int i = 0; i < 20; ++i) {
            session.on_connected(ParticipantId(1000), now);
            join(ParticipantId(1000), "trvl", i % 2 ? "secret" : "publish");
            say(ParticipantId(1000), wire::ChooseCodecs{"", "jpeg:quality=" + std::to_string(i)});
            session.on_closed(ParticipantId(1000));
            changes += count<action::ChangeSettings>(session.take_actions());
        }
        tick(1s);
        changes += count<action::ChangeSettings>(session.take_actions());
    }
    EXPECT_LE(changes,
              Streams::encoding_changes.at_once + 20 * Streams::encoding_changes.per_second + 1);
    // The newest state is carried out soon.
    join(bob, "rvl", "publish");
    (void)session.take_actions();
    tick(1s);
    EXPECT_EQ(session.depth_settings().size(), 2u);
    EXPECT_EQ(session.color_settings().at(0).id, hers) << "she notices nothing";
    EXPECT_FALSE(session.receivers(StreamId{0}, session.depth_settings()[1].id).empty());
}

}  // namespace
}  // namespace theatron::session
