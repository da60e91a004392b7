// SPDX-License-Identifier: Apache-2.0
#include "send/jpeg_budget.h"

#include <gtest/gtest.h>

namespace theatron::send {
namespace {

// A camera whose pictures take these bytes with the finest step.
class Pictures {
public:
    explicit Pictures(const JpegLimits& limits = {}) : budget(limits) {}

    // Encodes one until it is taken; the bytes sent.
    std::size_t send(double finest_bytes) {
        for (;;) {
            ++encodings;
            const auto bytes = std::size_t(finest_bytes * budget.step().size);
            if (budget.takes(bytes))
                return bytes;
        }
    }
    JpegBudget budget;
    int encodings = 0;
};

TEST(JpegBudget, IsTwentyMegabitsASecondAtAnyRate) {
    EXPECT_EQ(JpegBudget({.frames_per_second = 30}).most_bytes(), 83'333u);
    EXPECT_EQ(JpegBudget({.frames_per_second = 15}).most_bytes(), 166'666u);
    EXPECT_EQ(JpegBudget({.frames_per_second = 0}).most_bytes(), 2'500'000u);
}

TEST(JpegBudget, PicturesThatFitKeepTheFinestStep) {
    Pictures pictures;
    for (int i = 0; i < 100; ++i)
        EXPECT_EQ(pictures.send(83'333), 83'333u);
    EXPECT_EQ(pictures.encodings, 100);
    EXPECT_EQ(pictures.budget.step().quality, 85);
}

TEST(JpegBudget, AnyPictureThatIsTooLargeIsEncodedAgainUntilItFits) {
    for (double bytes = 10'000; bytes < 2'500'000; bytes *= 1.1) {
        Pictures pictures;
        EXPECT_LE(pictures.send(bytes), pictures.budget.most_bytes()) << bytes;
        EXPECT_LE(pictures.encodings, 2) << bytes;
    }
}

TEST(JpegBudget, QualityFallsBeforeTheSize) {
    int quality = 100, divisor = 1;
    for (const JpegBudget::Step& step : JpegBudget({}).steps()) {
        EXPECT_TRUE(step.divisor > divisor || step.quality < quality);
        EXPECT_GE(step.divisor, divisor);
        quality = step.quality;
        divisor = step.divisor;
    }
    EXPECT_EQ(divisor, 4);
    for (const JpegBudget::Step& step : JpegBudget({.may_be_smaller = false}).steps())
        EXPECT_EQ(step.divisor, 1);
}

TEST(JpegBudget, TheCoarsestStepTakesAnyPicture) {
    Pictures pictures;
    EXPECT_GT(pictures.send(1e9), pictures.budget.most_bytes());
    EXPECT_EQ(&pictures.budget.step(), &pictures.budget.steps().back());
}

TEST(JpegBudget, QualityComesBackStepByStepWhenPicturesAreSmallAgain) {
    Pictures pictures;
    pictures.send(250'000);
    const std::size_t steps = std::size_t(&pictures.budget.step() - pictures.budget.steps().data());
    ASSERT_GT(steps, 2u);
    for (std::size_t i = 0; i < steps; ++i) {
        const auto* const before = &pictures.budget.step();
        for (int n = 0; n < JpegBudget::first_wait; ++n) {
            EXPECT_EQ(&pictures.budget.step(), before);
            pictures.send(40'000);
        }
        EXPECT_EQ(&pictures.budget.step(), before - 1);
    }
    EXPECT_EQ(pictures.budget.step().quality, 85);
}

TEST(JpegBudget, StepsThatWereTriedInVainAreTriedLessAndLess) {
    // Takes more bytes with a finer step than is typical, so that every try fails.
    JpegBudget budget({});
    int tries = 0;
    const auto send = [&] {
        while (!budget.takes(budget.step().quality > 55 ? 100'000 : 50'000))
            ++tries;
    };
    send();
    ASSERT_LE(budget.step().quality, 55);
    tries = 0;
    for (int i = 0; i < 5000; ++i)
        send();
    EXPECT_GE(tries, 5);
    EXPECT_LE(tries, 10);
}

TEST(JpegBudget, ACamerasOwnPicturesAreSentUntilOneIsTooLargeAndAgainAfterManySmallOnes) {
    JpegBudget budget({});
    EXPECT_TRUE(budget.takes_own(83'000));
    EXPECT_FALSE(budget.takes_own(84'000));
    // Below the bound, but not by much: sent again they might soon be too large.
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(budget.takes_own(80'000));
    for (int i = 1; i < JpegBudget::first_wait; ++i)
        EXPECT_FALSE(budget.takes_own(60'000));
    EXPECT_TRUE(budget.takes_own(60'000));
    EXPECT_TRUE(budget.takes_own(83'000));
}

}  // namespace
}  // namespace theatron::send
