// SPDX-License-Identifier: Apache-2.0
#include "face/network.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

#include "face/emotion_reader.h"
#include "face/synthetic_faces.h"
#include "face/training.h"

namespace theatron::face {
namespace {

// Less than a user trains with, so that sanitizers have done soon.
constexpr TrainingParams little{.persons = 30, .epochs = 10, .own_epochs = 3};

const Network& trained(Source source) {
    static const Network fb = train_synthetic(Source::xr_fb_face2, little);
    static const Network htc = train_synthetic(Source::xr_htc, little);
    return source == Source::xr_htc ? htc : fb;
}

constexpr std::uint64_t held_out_seed = 9000;

TEST(FaceNetwork, TellsEmotionsOfPersonsThatItHasNotSeen) {
    for (const Source source : {Source::xr_fb_face2, Source::xr_htc}) {
        const Recording others = synthetic_recording(source, 10, held_out_seed);
        const Confusion all = confusion_of(trained(source), others);
        const Confusion some = confusion_of(trained(source), others, 0.2);
        EXPECT_GT(all.accuracy(), source == Source::xr_htc ? 0.7 : 0.85) << to_text(all);
        EXPECT_GT(some.accuracy(), source == Source::xr_htc ? 0.6 : 0.75) << to_text(some);
        EXPECT_LT(some.accuracy(), all.accuracy());
    }
}

TEST(Training, EndsWhenItIsToldTo) {
    constexpr TrainingParams three_epochs{.persons = 3, .epochs = 3};
    int calls = 0;
    EXPECT_FALSE(train_synthetic_until(Source::xr_htc, three_epochs, [&] { return ++calls == 2; }));
    EXPECT_EQ(calls, 2);
    EXPECT_TRUE(train_synthetic_until(Source::xr_htc, three_epochs, [] { return false; }));
}

TEST(FaceNetwork, IsTheSameForTheSameSeed) {
    constexpr TrainingParams least{.persons = 3, .epochs = 1};
    EXPECT_EQ(network_bytes(train_synthetic(Source::xr_htc, least)),
              network_bytes(train_synthetic(Source::xr_htc, least)));
}

TEST(FaceNetwork, ChannelsOutsideItsMaskSayNothing) {
    Features features{};
    const Network& network = trained(Source::xr_htc);
    const Emotions before = evaluate(network, features, ChannelMask().set());
    features[brow_down_left] = 1;
    EXPECT_EQ(evaluate(network, features, ChannelMask().set()), before);
    EXPECT_NEAR(std::accumulate(before.begin(), before.end(), 0.F), 1, 1e-5);
}

TEST(FaceNetwork, AngerNeedsTwiceTheCertainty) {
    EXPECT_EQ(decide({0, 0.35F, 0, 0, 0.6F, 0.05F}), Emotion::neutral);
    EXPECT_EQ(decide({0, 0.3F, 0, 0, 0.65F, 0.05F}), Emotion::anger);
    EXPECT_EQ(decide({0, 0.6F, 0, 0, 0.35F, 0.05F}), Emotion::disgust);
}

TEST(FaceNetwork, BytesRoundTripAndDamageIsRefused) {
    const Bytes whole = network_bytes(trained(Source::xr_htc));
    const Result<Network> read = parse_network(whole);
    ASSERT_TRUE(read);
    EXPECT_EQ(network_bytes(*read), whole);
    EXPECT_TRUE(read->is_synthetic_only);
    for (std::size_t n = 0; n < whole.size(); n += 97)
        EXPECT_FALSE(parse_network(ByteView(whole).first(n))) << n;
    for (std::size_t at = 0; at < whole.size(); at += 61) {
        Bytes damaged = whole;
        damaged[at] ^= std::byte(0x10);
        EXPECT_FALSE(parse_network(damaged)) << at;
    }
    Bytes longer = whole;
    longer.push_back(std::byte(0));
    EXPECT_EQ(parse_network(longer).error(), Status::trailing_bytes);
    Bytes newer = whole;
    newer[5] = std::byte(2);
    EXPECT_EQ(parse_network(newer).error(), Status::unsupported_version);
}

TEST(FaceNetwork, LearnsFromOwnTakesAndTellsTheOneLeftOut) {
    Recording own = synthetic_recording(Source::xr_htc, 1, 4711);
    own.is_synthetic = false;
    for (Take& take : own.takes)
        take.person = 0;
    ASSERT_EQ(problem_of_own(own), "");
    const Confusion confusion = leave_one_take_out(trained(Source::xr_htc), own, little);
    // 13 takes: one of 2 s, others of 3 s, a window each 0.3 s after 0.8 s.
    EXPECT_EQ(confusion.total(), 4 + 12 * 8);
    EXPECT_GT(confusion.accuracy(), 0.4);
    const Network network = train_own(trained(Source::xr_htc), own, little);
    EXPECT_FALSE(network.is_synthetic_only);
    EXPECT_EQ(network.own_takes, 13U);
    EXPECT_GT(confusion_of(network, own).accuracy(), confusion.accuracy());
}

TEST(FaceNetwork, SaysWhatARecordingLacks) {
    Recording own = synthetic_recording(Source::xr_htc, 1, 5);
    own.takes.pop_back();
    own.takes.pop_back();
    EXPECT_EQ(problem_of_own(own), "");  // the take at rest is a neutral one
    own.takes.erase(own.takes.begin() + 1, own.takes.begin() + 3);
    EXPECT_EQ(problem_of_own(own),
              "there is no take of sadness; a recording needs all six emotions");
    own.takes[1].samples.resize(10);
    EXPECT_EQ(problem_of_own(own),
              "a take of disgust is shorter than 0.8 s; record takes of 3 to 5 s");
}

// A person at rest, then with one emotion, at 60 Hz.
class ReadPerson {
public:
    explicit ReadPerson(std::uint64_t seed) : person_(seed), reader_(trained(Source::xr_fb_face2)) {
        reader_.calibrate(now_);
        play({.seconds = 2.5, .rate_hz = 60});
    }
    EmotionNow play(const SyntheticPerson::Wish& wish) {
        const Take take = person_.take(wish, mask_);
        for (const Sample& sample : take.samples) {
            now_ += seconds_to_duration(1 / wish.rate_hz);
            put({sample.values, mask_, Tracking::tracked});
        }
        return state_;
    }
    EmotionNow put(const FaceNow& face) {
        const Emotion before = state_.told;
        state_ = reader_.put(face, now_);
        changes_ += state_.told != before;
        return state_;
    }
    EmotionNow lose(Duration time) {
        for (const TimePoint end = now_ + time; now_ < end;) {
            now_ += 16ms;
            put({{}, {}, Tracking::lost});
        }
        return state_;
    }
    int changes() const { return changes_; }

private:
    const ChannelMask mask_ = table_of(Source::xr_fb_face2).mask;
    SyntheticPerson person_;
    EmotionReader reader_;
    TimePoint now_ = from_us(1'000'000);
    EmotionNow state_;
    int changes_ = 0;
};

TEST(EmotionReader, FollowsAPersonAndRelaxesWithoutATracker) {
    int right = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        ReadPerson person(held_out_seed * 31 + seed);
        right += person.play({.emotion = Emotion::surprise, .seconds = 4, .rate_hz = 60}).told ==
                 Emotion::surprise;
        const EmotionNow lost = person.lose(2s);
        EXPECT_EQ(lost.told, Emotion::neutral);
        EXPECT_GT(lost.weights[std::size_t(Emotion::neutral)], 0.95F);
        EXPECT_TRUE(lost.is_calibrated);
    }
    EXPECT_GE(right, 5);
}

TEST(EmotionReader, ItsWeightsFollowByTheStatedTime) {
    ReadPerson person(3);
    person.play({.emotion = Emotion::surprise, .seconds = 4, .rate_hz = 60});
    const float before = person.lose(16ms).weights[std::size_t(Emotion::surprise)];
    const float after = person.lose(304ms).weights[std::size_t(Emotion::surprise)];
    EXPECT_NEAR(after / before, 0.363F, 0.02F);  // 1/e after 0.3 s
}

TEST(EmotionReader, SpeechAndASingleFrameChangeNothing) {
    ReadPerson person(12);
    person.play({.seconds = 20, .rate_hz = 60, .speaks = true});
    EXPECT_LE(person.changes(), 1);
    const int before = person.changes();
    Channels grimace{};
    grimace.fill(1);
    person.put({grimace, ChannelMask().set(), Tracking::tracked});
    person.play({.seconds = 1, .rate_hz = 60});
    EXPECT_EQ(person.changes(), before);
}

TEST(ScriptedActor, ShowsEachEmotionAndStaysInRange) {
    std::array<bool, emotion_count> seen{};
    for (int i = 0; i < 21 * 30; ++i) {
        seen[std::size_t(actor_emotion(i / 30.0))] = true;
        for (const float value : actor_channels(i / 30.0))
            ASSERT_TRUE(value >= 0 && value <= 1);
    }
    for (const bool each : seen)
        EXPECT_TRUE(each);
}

}  // namespace
}  // namespace theatron::face
