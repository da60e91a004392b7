// SPDX-License-Identifier: Apache-2.0
#include "session/direct_load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::session {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Bytes ann{std::byte{1}}, ben{std::byte{2}}, eva{std::byte{3}};

class Load : public ::testing::Test {
protected:
    void come(const Bytes& receiver) {
        now += 1s;
        load.on_come(receiver, now);
    }
    // Those who must go while these are late, in the order in which they go.
    std::vector<Bytes> go(const std::vector<Bytes>& late, Duration period = 2s) {
        std::vector<Bytes> gone;
        for (const TimePoint end = now + period; now < end; now += 100ms)
            for (const Bytes& receiver : load.on_tick(late, now))
                gone.push_back(receiver);
        return gone;
    }
    TimePoint now = from_us(1'000'000);
    DirectLoad load;
};

TEST_F(Load, AReceiverThatIsLateAgainAndAgainGoesAlone) {
    come(ann);
    come(ben);
    EXPECT_THAT(go({ann}, 500ms), IsEmpty()) << "once is no rule";
    EXPECT_THAT(go({}, 10s), IsEmpty());
    EXPECT_THAT(go({ann}, 700ms), ElementsAre(ann)) << "although it came first";
    EXPECT_THAT(go({ben}, 300ms), IsEmpty());
}

TEST_F(Load, FramesThatAreLeftOutCountAsWell) {
    come(ann);
    for (int i = 0; i < 6; ++i)
        load.on_loss(ann);
    EXPECT_THAT(go({}, 100ms), ElementsAre(ann));
}

TEST_F(Load, OfSeveralThatAreSlowAtOnceTheLastOneGoesAndTheOthersGetTime) {
    for (const Bytes& receiver : {ann, ben, eva})
        come(receiver);
    EXPECT_THAT(go({ann, ben, eva}, 700ms), ElementsAre(eva));
    EXPECT_THAT(go({ann, ben}, 300ms), IsEmpty());
    EXPECT_THAT(go({}, 28s), IsEmpty()) << "now the link carries them";
    EXPECT_FALSE(load.may_come(eva, now));
    EXPECT_THAT(go({}, 30s), IsEmpty());
    EXPECT_TRUE(load.may_come(eva, now));
    come(eva);
    EXPECT_THAT(go({ann, ben, eva}, 1400ms), ElementsAre(eva, ben));
}

TEST_F(Load, WhoHasJustComeGoesIfAnotherOneBecomesSlow) {
    come(ann);
    EXPECT_THAT(go({}, 10s), IsEmpty());
    come(ben);
    EXPECT_THAT(go({ann}, 700ms), ElementsAre(ben));
    EXPECT_FALSE(load.may_come(ben, now + 20s));
    EXPECT_THAT(go({ann}, 700ms), ElementsAre(ann)) << "it is slow without the other one, too";
}

TEST_F(Load, ComesAgainAfterPausesThatGrowUntilItHasStayed) {
    const auto barred = [&] {
        const TimePoint begun = now;
        while (!load.may_come(ann, now))
            now += 1s;
        return now - begun;
    };
    EXPECT_TRUE(load.may_come(ann, now));
    for (const Duration bar : {2s, 4s, 8s, 16s, 32s, 64s, 128s, 256s, 512s, 600s, 600s}) {
        come(ann);
        EXPECT_THAT(go({ann}, 600ms), ElementsAre(ann));
        EXPECT_NEAR(to_ms(barred()), to_ms(bar), 1000);
    }
    come(ann);
    EXPECT_THAT(go({}, DirectLoad::proven + 1s), IsEmpty());
    EXPECT_THAT(go({ann}, 600ms), ElementsAre(ann));
    EXPECT_NEAR(to_ms(barred()), 2000, 1000);
}

TEST_F(Load, ForgetsThoseWhoAreNoLongerGranted) {
    come(ann);
    EXPECT_THAT(go({ann}, 600ms), ElementsAre(ann));
    EXPECT_FALSE(load.may_come(ann, now));
    load.keep_only({ben});
    EXPECT_TRUE(load.may_come(ann, now));
    come(ben);
    load.on_left(ben);
    EXPECT_THAT(go({ben}, 2s), IsEmpty()) << "it is gone already";
}

}  // namespace
}  // namespace theatron::session
