// SPDX-License-Identifier: Apache-2.0
#include "face/landmark_draft.h"

#include <gtest/gtest.h>

#include <cmath>

#include "face/expression.h"
#include "face/random.h"

namespace theatron::face {
namespace {

constexpr std::size_t asked[] = {36, 39, 42, 45, 30, 48, 54, 8};

double distance(Vec2 a, Vec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

class LandmarkDraftTest : public testing::Test {
protected:
    static const MorphModel& model() {
        static const MorphModel made = generated_head();
        return made;
    }
    // A person who is not the usual one, seen a little from the side, the eyes about 100 px apart.
    static Landmarks seen(std::uint64_t seed, Emotion emotion) {
        Random random(seed);
        std::vector<float> identity(model().identities.size());
        for (float& share : identity)
            share = float(random.normal());
        const Pose turn{rotation_about({0, 1, 0}, random.between(-0.15, 0.15)), {}};
        Landmarks landmarks;
        for (std::size_t i = 0; i < landmark_count; ++i) {
            const Vec3 at = turn * blended_vertex(model(), identity, channels_of(emotion),
                                                  model().landmarks[i]);
            landmarks[i] = {320 + 1.6 * at.x, 360 - 1.6 * at.y};
        }
        return landmarks;
    }
    LandmarkDraft draft(Emotion emotion = Emotion::neutral) const {
        return LandmarkDraft(usual_landmarks(model(), emotion));
    }
    static void put_all(LandmarkDraft& draft, const Landmarks& truth) {
        for (const std::size_t landmark : asked)
            draft.put(truth[landmark]);
    }
};

TEST_F(LandmarkDraftTest, EightPlacesGiveAllLandmarks) {
    for (const Emotion emotion : {Emotion::neutral, Emotion::happiness, Emotion::surprise}) {
        double worst_mean = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const Landmarks truth = seen(seed, emotion);
            LandmarkDraft marked = draft(emotion);
            EXPECT_FALSE(marked.landmarks_px());
            put_all(marked, truth);
            ASSERT_TRUE(marked.landmarks_px());
            double sum = 0;
            for (std::size_t i = 0; i < landmark_count; ++i)
                sum += distance((*marked.landmarks_px())[i], truth[i]);
            worst_mean = std::max(worst_mean, sum / landmark_count);
        }
        // The eyes are about 100 px apart.
        EXPECT_LT(worst_mean, 6) << to_text(emotion);
    }
}

TEST_F(LandmarkDraftTest, PlacesAreAskedForInTheirOrder) {
    LandmarkDraft marked = draft();
    const Landmarks truth = seen(1, Emotion::neutral);
    for (std::size_t i = 0; i < LandmarkDraft::place_count; ++i) {
        EXPECT_EQ(marked.next(), LandmarkDraft::Place(i));
        EXPECT_FALSE(marked.is_shown(asked[i]));
        marked.put(truth[asked[i]]);
        EXPECT_TRUE(marked.is_shown(asked[i]));
        EXPECT_EQ(marked.point(asked[i]).x, truth[asked[i]].x);
    }
    EXPECT_FALSE(marked.next());
    marked.put({0, 0});
    EXPECT_EQ(marked.point(8).x, truth[8].x) << "nothing is asked for any more";
}

TEST_F(LandmarkDraftTest, AMovedLandmarkStaysAndItsNeighboursFollow) {
    LandmarkDraft marked = draft();
    put_all(marked, seen(2, Emotion::neutral));
    const Vec2 brow = marked.point(19), beside = marked.point(20), far = marked.point(45);
    marked.move(19, {brow.x, brow.y - 12});
    EXPECT_EQ(marked.point(19).y, brow.y - 12);
    EXPECT_LT(marked.point(20).y, beside.y - 3);
    EXPECT_EQ(marked.point(45).y, far.y);
    EXPECT_TRUE(marked.undo());
    EXPECT_NEAR(marked.point(19).y, brow.y, 1e-6);
    EXPECT_NEAR(marked.point(20).y, beside.y, 1e-6);
}

TEST_F(LandmarkDraftTest, ADragIsOneStep) {
    LandmarkDraft marked = draft();
    put_all(marked, seen(2, Emotion::neutral));
    const Vec2 chin = marked.point(8), nose = marked.point(30);
    for (int i = 1; i <= 30; ++i)
        marked.move(8, {chin.x + i, chin.y}, i > 1);
    EXPECT_EQ(marked.point(8).x, chin.x + 30);
    EXPECT_TRUE(marked.undo());
    EXPECT_EQ(marked.point(8).x, chin.x);
    EXPECT_TRUE(marked.undo()) << "the chin itself";
    EXPECT_EQ(marked.next(), LandmarkDraft::Place::chin);
    EXPECT_EQ(marked.point(30).x, nose.x);
}

TEST_F(LandmarkDraftTest, EverythingCanBeTakenBack) {
    LandmarkDraft marked = draft();
    put_all(marked, seen(3, Emotion::neutral));
    for (std::size_t i = 0; i < LandmarkDraft::place_count; ++i)
        EXPECT_TRUE(marked.undo());
    EXPECT_FALSE(marked.undo());
    EXPECT_EQ(marked.next(), LandmarkDraft::Place::left_eye_outer);
}

TEST_F(LandmarkDraftTest, FoundLandmarksMoveOneByOne) {
    LandmarkDraft marked = draft();
    marked.put({1, 2});
    const Landmarks found = seen(4, Emotion::neutral);
    marked.take(found);
    EXPECT_FALSE(marked.next());
    marked.move(19, {found[19].x, found[19].y - 12});
    EXPECT_EQ(marked.point(20).y, found[20].y);
    EXPECT_TRUE(marked.undo());
    EXPECT_EQ(marked.point(19).y, found[19].y);
    EXPECT_FALSE(marked.undo());
}

TEST_F(LandmarkDraftTest, TheNearestLandmarkWithinReachIsMeant) {
    LandmarkDraft marked = draft();
    const Landmarks truth = seen(1, Emotion::neutral);
    marked.put(truth[36]);
    EXPECT_EQ(marked.near({truth[36].x + 3, truth[36].y}, 8), 36u);
    EXPECT_EQ(marked.near({truth[36].x + 9, truth[36].y}, 8), std::nullopt);
    EXPECT_EQ(marked.near(truth[54], 8), std::nullopt) << "not put yet";
    put_all(marked, truth);
    EXPECT_EQ(marked.near(marked.point(60), 8), 60u);
}

TEST_F(LandmarkDraftTest, PlacesOnOnePointGiveNumbers) {
    LandmarkDraft marked = draft();
    for (std::size_t i = 0; i < LandmarkDraft::place_count; ++i)
        marked.put({100, 100});
    ASSERT_TRUE(marked.landmarks_px());
    const Landmarks landmarks = *marked.landmarks_px();
    for (const Vec2 point : landmarks)
        EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
}

}  // namespace
}  // namespace theatron::face
