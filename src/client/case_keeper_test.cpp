// SPDX-License-Identifier: Apache-2.0
#include "client/case_keeper.h"

#include <gtest/gtest.h>

#include "session/case_objects.h"

namespace theatron::client {
namespace {

// A room in which a case is open, and the keeper of somebody whose host does not have it.
std::string problem_with(session::ObjectId organ) {
    ContentHash hash;
    hash.bytes[0] = std::byte(7);
    CaseKeeper keeper([] {}, [] {});
    keeper.on_connected();
    session::RoomObject object;
    object.kind = session::ObjectKind::organ;
    object.properties = session::encode_case_object(session::CaseOrgan{hash, 0, false});
    keeper.on_room({{organ, object}});
    EXPECT_EQ(keeper.take_requests(from_us(1)).size(), 1u);
    wire::Content none;
    none.hash = Bytes(hash.bytes.begin(), hash.bytes.end());
    keeper.on_content(none, from_us(2));
    std::uint64_t version = 0;
    const auto open = keeper.open(version);
    return open ? open->problem : "no case is open";
}

TEST(CaseKeeper, ACaseThatTheHostHasNoMoreIsSaid) {
    EXPECT_EQ(problem_with(session::ObjectId{5}), "The host does not offer this case any more.");
}

TEST(CaseKeeper, TheHostOfAReplayIsToldToOfferTheRecordedCase) {
    const auto recorded = session::ObjectId{5 | session::recorded_bit};
    EXPECT_NE(problem_with(recorded).find("--cases"), std::string::npos);
}

}  // namespace
}  // namespace theatron::client
