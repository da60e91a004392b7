// SPDX-License-Identifier: Apache-2.0
#include "session/direct_load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::session {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Bytes person_a{std::byte{1}}, person_b{std::byte{2}}, person_c{std::byte{3}};

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
    come(person_a);
    come(person_b);
    EXPECT_THAT(go({person_a}, 500ms), IsEmpty()) << "once is no rule";
    EXPECT_THAT(go({}, 10s), IsEmpty());
    EXPECT_THAT(go({person_a}, 700ms), ElementsAre(person_a)) << "although it came first";
    EXPECT_THAT(go({person_b}, 300ms), IsEmpty());
}

TEST_F(Load, FramesThatAreLeftOutCountAsWell) {
    come(person_a);
    for (int i = 0; i < 6; ++i)
        load.on_loss(person_a);
    EXPECT_THAT(go({}, 100ms), ElementsAre(person_a));
}

TEST_F(Load, OfSeveralThatAreSlowAtOnceTheLastOneGoesAndTheOthersGetTime) {
    for (const Bytes& receiver : {person_a, person_b, person_c})
        come(receiver);
    EXPECT_THAT(go({person_a, person_b, person_c}, 700ms), ElementsAre(person_c));
    EXPECT_THAT(go({person_a, person_b}, 300ms), IsEmpty());
    EXPECT_THAT(go({}, 28s), IsEmpty()) << "now the link carries them";
    EXPECT_FALSE(load.may_come(person_c, now));
    EXPECT_THAT(go({}, 30s), IsEmpty());
    EXPECT_TRUE(load.may_come(person_c, now));
    come(person_c);
    EXPECT_THAT(go({person_a, person_b, person_c}, 1400ms), ElementsAre(person_c, person_b));
}

TEST_F(Load, WhoHasJustComeGoesIfAnotherOneBecomesSlow) {
    come(person_a);
    EXPECT_THAT(go({}, 10s), IsEmpty());
    come(person_b);
    EXPECT_THAT(go({person_a}, 700ms), ElementsAre(person_b));
    EXPECT_FALSE(load.may_come(person_b, now + 20s));
    EXPECT_THAT(go({person_a}, 700ms), ElementsAre(person_a))
        << "it is slow without the other one, too";
}

TEST_F(Load, ComesAgainAfterPausesThatGrowUntilItHasStayed) {
    const auto barred = [&] {
        const TimePoint begun = now;
        while (!load.may_come(person_a, now))
            now += 1s;
        return now - begun;
    };
    EXPECT_TRUE(load.may_come(person_a, now));
    for (const Duration bar : {2s, 4s, 8s, 16s, 32s, 64s, 128s, 256s, 512s, 600s, 600s}) {
        come(person_a);
        EXPECT_THAT(go({person_a}, 600ms), ElementsAre(person_a));
        EXPECT_NEAR(to_ms(barred()), to_ms(bar), 1000);
    }
    come(person_a);
    EXPECT_THAT(go({}, DirectLoad::proven + 1s), IsEmpty());
    EXPECT_THAT(go({person_a}, 600ms), ElementsAre(person_a));
    EXPECT_NEAR(to_ms(barred()), 2000, 1000);
}

TEST_F(Load, ForgetsThoseWhoAreNoLongerGranted) {
    come(person_a);
    EXPECT_THAT(go({person_a}, 600ms), ElementsAre(person_a));
    EXPECT_FALSE(load.may_come(person_a, now));
    load.keep_only({person_b});
    EXPECT_TRUE(load.may_come(person_a, now));
    come(person_b);
    load.on_left(person_b);
    EXPECT_THAT(go({person_b}, 2s), IsEmpty()) << "it is gone already";
}

}  // namespace
}  // namespace theatron::session
