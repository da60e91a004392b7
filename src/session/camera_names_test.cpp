// SPDX-License-Identifier: Apache-2.0
// The names of participants' cameras: told apart from those of others, and with their publishers'.
#include <gtest/gtest.h>

#include "session/host_session_testing.h"

namespace theatron::session {
namespace {

class CameraNames : public Host {
protected:
    CameraNames() {
        HostSession::Config c = config();
        c.cameras[0].name = "small";
        session_.emplace(std::move(c));
    }
    void come(ParticipantId id, const std::string& name, int person) {
        session_->on_connected(id, now);
        wire::Join hello;
        hello.token = "publish";
        hello.name = name;
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.person = Bytes(wire::person_id_size, std::byte(person));
        hello.features = {wire::Feature::publish, wire::Feature::webcam};
        session_->on_control(id, wire::encode(hello), now);
    }
    // The camera as the others see it.
    wire::Camera offer(ParticipantId id, const std::string& name) {
        wire::Publish offer;
        offer.cameras.push_back({name, false, 30, config().cameras[0].calibration});
        session_->on_control(id, wire::encode(offer), now);
        const auto answers = messages_to<wire::Published>(id, session_->take_actions());
        if (answers.size() != 1 || answers[0].cameras.size() != 1)
            return {};
        return session_->streams().cameras().find(answers[0].cameras[0])->description();
    }

    std::optional<HostSession> session_;
};

TEST_F(CameraNames, OfGuestsLookLikeNoOther) {
    come(alice, "Ada", 1);
    EXPECT_EQ(offer(alice, "small").name, "small (2)");
    EXPECT_EQ(offer(alice, "sma\u0131l").name, "sma\u0131l (2)") << "her own count for nothing";
    session_->on_closed(alice);
    come(bob, "Ben", 2);
    EXPECT_EQ(offer(bob, "\u0455mall").name, "\u0455mall (2)") << "Cyrillic";
    EXPECT_EQ(offer(bob, "host").name, "host (2)");
    EXPECT_EQ(offer(bob, "lamp (live)").name.find('('), std::string::npos);
    EXPECT_EQ(offer(bob, "\u202e \u200b").name, "camera");
    come(carol, "Carol", 3);
    EXPECT_EQ(offer(carol, "HOST").name, "HOST (3)");
    EXPECT_EQ(offer(carol, "table").name, "table");
}

TEST_F(CameraNames, OfSomebodyWhoComesBackStayAndKeepTheirAdjustment) {
    come(alice, "Ada", 1);
    const wire::Camera first = offer(alice, "small");
    CameraAdjustment adjustment;
    adjustment.moved_m.z = 0.1;
    ASSERT_EQ(session_->adjust(first.id, adjustment, "Boss", now), wire::ManageRefusal::none);
    come(bob, "Ada", 1);
    EXPECT_EQ(offer(bob, "small").name, first.name) << "before the old connection ends";
    session_->on_closed(alice);
    session_->on_closed(bob);
    come(carol, "Ada", 1);
    const wire::Camera again = offer(carol, "small");
    EXPECT_EQ(again.name, first.name);
    EXPECT_EQ(session_->streams().cameras().find(again.id)->adjustment().moved_m.z, 0.1);
}

}  // namespace
}  // namespace theatron::session
