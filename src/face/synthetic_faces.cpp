// SPDX-License-Identifier: Apache-2.0
#include "face/synthetic_faces.h"

#include <algorithm>

namespace theatron::face {
namespace {

struct Part {
    Channel left, right;  // the same where a channel has no sides
    float size;
};

constexpr Part both(Channel left, Channel right, float size) {
    return {left, right, size};
}
constexpr Part one(Channel channel, float size) {
    return {channel, channel, size};
}

constexpr Part brow_down(float s) {
    return both(brow_down_left, brow_down_right, s);
}
constexpr Part inner_up(float s) {
    return one(brow_inner_up, s);
}
constexpr Part outer_up(float s) {
    return both(brow_outer_up_left, brow_outer_up_right, s);
}
constexpr Part lids_tight(float s) {
    return both(eye_squint_left, eye_squint_right, s);
}
constexpr Part lids_wide(float s) {
    return both(eye_wide_left, eye_wide_right, s);
}
constexpr Part cheeks(float s) {
    return both(cheek_squint_left, cheek_squint_right, s);
}
constexpr Part sneer(float s) {
    return both(nose_sneer_left, nose_sneer_right, s);
}
constexpr Part smile(float s) {
    return both(mouth_smile_left, mouth_smile_right, s);
}
constexpr Part frown(float s) {
    return both(mouth_frown_left, mouth_frown_right, s);
}
constexpr Part upper_up(float s) {
    return both(mouth_upper_up_left, mouth_upper_up_right, s);
}
constexpr Part lower_down(float s) {
    return both(mouth_lower_down_left, mouth_lower_down_right, s);
}
constexpr Part press(float s) {
    return both(mouth_press_left, mouth_press_right, s);
}
constexpr Part stretch(float s) {
    return both(mouth_stretch_left, mouth_stretch_right, s);
}

using Prototype = std::vector<Part>;

// Variants of each emotion; FACS' numbers of the action units in the comments.
std::vector<Prototype> variants_of(Emotion emotion) {
    switch (emotion) {
        case Emotion::happiness:
            // 6 + 12; 6 + 12 + 25; 12 alone, a polite smile
            return {{smile(0.8F), cheeks(0.6F), lids_tight(0.2F),
                     both(mouth_dimple_left, mouth_dimple_right, 0.2F)},
                    {smile(0.9F), cheeks(0.7F), lids_tight(0.3F), upper_up(0.3F), lower_down(0.2F),
                     one(jaw_open, 0.15F)},
                    {smile(0.6F), both(mouth_dimple_left, mouth_dimple_right, 0.3F)}};
        case Emotion::sadness:
            // 1 + 4 + 15; with 17; 1 + 15 with lowered eyes
            return {{inner_up(0.8F), brow_down(0.3F), frown(0.7F)},
                    {inner_up(0.7F), brow_down(0.3F), frown(0.7F), one(mouth_shrug_lower, 0.5F),
                     lids_tight(0.15F)},
                    {inner_up(0.6F), frown(0.8F),
                     both(eye_look_down_left, eye_look_down_right, 0.4F), one(mouth_pucker, 0.1F)}};
        case Emotion::surprise:
            // 1 + 2 + 5 + 26; 5 + 26 strong; 1 + 2 + 5
            return {{inner_up(0.9F), outer_up(0.9F), lids_wide(0.8F), one(jaw_open, 0.45F)},
                    {inner_up(0.6F), outer_up(0.6F), lids_wide(0.9F), one(jaw_open, 0.7F)},
                    {inner_up(0.9F), outer_up(0.9F), lids_wide(0.9F), one(jaw_open, 0.2F),
                     one(mouth_funnel, 0.15F)}};
        case Emotion::anger:
            // 4 + 5 + 7 + 23; 4 + 7 + 24; 4 + 5 + 7 with teeth
            return {{brow_down(0.9F), lids_wide(0.2F), lids_tight(0.5F), press(0.5F),
                     one(mouth_roll_lower, 0.2F), one(mouth_roll_upper, 0.2F)},
                    {brow_down(0.8F), lids_tight(0.6F), press(0.8F), one(mouth_roll_lower, 0.4F),
                     one(mouth_roll_upper, 0.4F)},
                    {brow_down(0.9F), lids_tight(0.5F), sneer(0.3F), stretch(0.4F),
                     lower_down(0.4F), one(mouth_roll_upper, 0.3F), one(jaw_forward, 0.2F)}};
        case Emotion::disgust:
            // 9 + 15 + 16; 10 + 17 + 4; 9 + 10
            return {{sneer(0.9F), frown(0.3F), lower_down(0.3F), lids_tight(0.4F), upper_up(0.4F)},
                    {sneer(0.4F), upper_up(0.8F), one(mouth_shrug_lower, 0.5F),
                     one(mouth_shrug_upper, 0.3F), brow_down(0.4F), lids_tight(0.3F)},
                    {sneer(0.9F), upper_up(0.7F), brow_down(0.4F), lids_tight(0.4F), cheeks(0.3F)}};
        case Emotion::neutral:
            break;
    }
    return {{}};
}

// Where the right one of two sides is.
bool is_right_side(Channel channel) {
    return channel_names[channel].size() > 5 &&
           channel_names[channel].substr(channel_names[channel].size() - 5) == "Right";
}

// Speech: one mouth shape after the other, four to six a second.
class Speech {
public:
    Speech(Random& random, double strength) : random_(random), strength_(strength) {}

    void add(double t, double step, Channels& face) {
        if (t >= until_) {
            until_ = t + random_.between(0.16, 0.25);
            goal_ = {};
            const auto size = [&] { return float(strength_ * random_.between(0.2, 1)); };
            switch (random_.below(6)) {
                case 0:  // a
                    goal_[jaw_open] = 0.4F * size();
                    goal_[mouth_lower_down_left] = goal_[mouth_lower_down_right] = 0.3F * size();
                    break;
                case 1:  // o
                    goal_[jaw_open] = 0.25F * size();
                    goal_[mouth_funnel] = 0.5F * size();
                    break;
                case 2:  // u
                    goal_[mouth_pucker] = 0.6F * size();
                    goal_[jaw_open] = 0.08F * size();
                    break;
                case 3:  // e
                    goal_[mouth_stretch_left] = goal_[mouth_stretch_right] = 0.3F * size();
                    goal_[jaw_open] = 0.15F * size();
                    goal_[mouth_upper_up_left] = goal_[mouth_upper_up_right] = 0.15F * size();
                    break;
                case 4:  // m, b, p
                    goal_[mouth_press_left] = goal_[mouth_press_right] = 0.4F * size();
                    goal_[mouth_roll_lower] = goal_[mouth_roll_upper] = 0.2F * size();
                    goal_[mouth_close] = 0.1F * size();
                    break;
                default:  // f
                    goal_[mouth_roll_lower] = 0.3F * size();
                    goal_[mouth_upper_up_left] = goal_[mouth_upper_up_right] = 0.1F * size();
                    break;
            }
        }
        const float follow = float(1 - std::exp(-step / 0.05));
        for (std::size_t i = 0; i < channel_count; ++i) {
            now_[i] += follow * (goal_[i] - now_[i]);
            face[i] += now_[i];
        }
    }

private:
    Random& random_;
    double strength_, until_ = 0;
    Channels goal_{}, now_{};
};

// Blinks every few seconds, of a fifth of a second; gaze that jumps.
class Eyes {
public:
    explicit Eyes(Random& random) : random_(random), next_blink_(random.between(0.2, 4)) {}

    void add(double t, Channels& face) {
        if (t > next_blink_ + blink_s)
            next_blink_ = t + random_.between(1.5, 6);
        const double phase = (t - next_blink_) / blink_s;
        if (phase > 0 && phase < 1) {
            const float closed = float(std::sin(phase * std::numbers::pi));
            for (const Channel lid : {eye_blink_left, eye_blink_right})
                face[lid] = std::max(face[lid], closed);
        }
        if (t >= next_look_) {
            next_look_ = t + random_.between(0.4, 2);
            across_ = float(0.25 * random_.normal());
            up_ = float(0.2 * random_.normal());
        }
        face[eye_look_in_left] += std::max(across_, 0.F);
        face[eye_look_out_right] += std::max(across_, 0.F);
        face[eye_look_out_left] += std::max(-across_, 0.F);
        face[eye_look_in_right] += std::max(-across_, 0.F);
        for (const Channel up : {eye_look_up_left, eye_look_up_right})
            face[up] += std::max(up_, 0.F);
        for (const Channel down : {eye_look_down_left, eye_look_down_right})
            face[down] += std::max(-up_, 0.F);
    }

private:
    static constexpr double blink_s = 0.2;
    Random& random_;
    double next_blink_, next_look_ = 0;
    float across_ = 0, up_ = 0;
};

// The units of a take: a variant, its intensity, one side stronger, some units missing, and a
// little of what nobody asked for.
Channels expression(Random& random, Emotion emotion) {
    Channels face{};
    const auto variants = variants_of(emotion);
    const Prototype& prototype = variants[random.below(variants.size())];
    const double intensity = random.between(0.3, 1);
    for (const Part& part : prototype) {
        if (random.chance(0.1))
            continue;
        const double size = part.size * intensity * std::exp(0.15 * random.normal());
        const double lean = 0.12 * random.normal();
        face[part.left] += float(size * (1 + lean));
        if (part.right != part.left)
            face[part.right] += float(size * (1 - lean));
    }
    for (int stray = 0; stray < 2; ++stray)
        face[random.below(channel_count)] += float(random.between(0, 0.12));
    return face;
}

}  // namespace

SyntheticPerson::SyntheticPerson(std::uint64_t seed) : random_(seed) {
    for (std::size_t i = 0; i < channel_count; ++i) {
        // Both sides of a face are of one person.
        const bool has_pair = is_right_side(Channel(i)) && i > 0;
        gain_[i] = float(std::exp(0.2 * random_.normal()));
        rest_[i] = random_.chance(0.5) ? float(std::fabs(0.06 * random_.normal())) : 0.F;
        if (!has_pair)
            continue;
        const std::string left =
            std::string(channel_names[i].substr(0, channel_names[i].size() - 5)) + "Left";
        if (const auto twin = channel_of(left)) {
            gain_[i] = gain_[*twin] * float(std::exp(0.08 * random_.normal()));
            rest_[i] = std::max(0.F, rest_[*twin] + float(0.01 * random_.normal()));
        }
    }
    noise_ = random_.between(0.005, 0.025);
    liveliness_ = random_.between(0.5, 1.2);
}

Take SyntheticPerson::take(const Wish& wish, const ChannelMask& mask) {
    Take take;
    take.label = wish.emotion;
    take.present = mask;
    const Channels shape = expression(random_, wish.emotion);
    Speech speech(random_, liveliness_);
    Eyes eyes(random_);
    const double step = 1 / wish.rate_hz, sway_hz = random_.between(0.2, 0.8);
    const double sway = random_.between(0, 0.2);
    double accent = 0, accent_until = 0;  // brows that stress what is said
    for (int i = 0; double(i) * step < wish.seconds; ++i) {
        const double t = double(i) * step;
        const double onset = wish.onset_s > 0 ? std::min(1.0, t / wish.onset_s) : 1;
        const double size =
            onset * (1 + sway * (std::sin(2 * std::numbers::pi * sway_hz * t) - 1) / 2);
        Channels face{};
        for (std::size_t c = 0; c < channel_count; ++c)
            face[c] = shape[c] * float(size);
        if (wish.speaks) {
            speech.add(t, step, face);
            if (t >= accent_until) {
                accent = random_.chance(0.3) ? random_.between(0.05, 0.25) * liveliness_ : 0;
                accent_until = t + 0.35;
            }
            face[brow_inner_up] += float(accent);
            face[brow_outer_up_left] += float(accent);
            face[brow_outer_up_right] += float(accent);
        }
        eyes.add(t, face);
        for (std::size_t c = 0; c < channel_count; ++c) {
            const double seen = face[c] * gain_[c] + rest_[c] + noise_ * random_.normal();
            // Trackers give steps of 1/255.
            face[c] = mask[c] ? float(std::round(std::clamp(seen, 0.0, 1.0) * 255) / 255) : 0.F;
        }
        take.samples.push_back({float(t), face});
    }
    return take;
}

Take SyntheticPerson::rest(const ChannelMask& mask) {
    return take({.emotion = Emotion::neutral, .seconds = 2}, mask);
}

Recording synthetic_recording(Source source, int persons, std::uint64_t seed) {
    Recording recording;
    recording.source = source;
    recording.is_synthetic = true;
    const ChannelMask mask = table_of(source).mask;
    for (int number = 1; number <= persons; ++number) {
        SyntheticPerson person(seed * 1000003 + std::uint64_t(number));
        recording.takes.push_back(person.rest(mask));
        recording.takes.back().person = number;
        for (std::size_t emotion = 0; emotion < emotion_count; ++emotion)
            for (const bool speaks : {false, true}) {
                recording.takes.push_back(
                    person.take({.emotion = Emotion(emotion), .speaks = speaks}, mask));
                recording.takes.back().person = number;
            }
    }
    return recording;
}

Emotion actor_emotion(double seconds) {
    constexpr Emotion script[] = {Emotion::neutral, Emotion::happiness, Emotion::surprise,
                                  Emotion::neutral, Emotion::sadness,   Emotion::disgust,
                                  Emotion::anger};
    return script[std::size_t(std::max(seconds, 0.0) / 3) % std::size(script)];
}

Channels actor_channels(double seconds) {
    Channels face{};
    const Emotion emotion = actor_emotion(seconds);
    const Prototype prototype = variants_of(emotion).front();
    const double t = std::fmod(std::max(seconds, 0.0), 3.0);
    const float size = float(std::clamp(std::min(t / 0.4, (3 - t) / 0.4), 0.0, 1.0));
    for (const Part& part : prototype)
        face[part.left] = face[part.right] = part.size * size;
    const double blink = std::fmod(std::max(seconds, 0.0), 3.7);
    if (blink < 0.2)
        for (const Channel lid : {eye_blink_left, eye_blink_right})
            face[lid] = float(std::sin(blink / 0.2 * std::numbers::pi));
    return face;
}

}  // namespace theatron::face
