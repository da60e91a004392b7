// SPDX-License-Identifier: Apache-2.0
#include "face/expression.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace theatron::face {
namespace {

// 0 for a value that is no number.
float limited(float value) {
    return value > 0 ? std::min(value, 1.0F) : 0;
}

Channels with(std::initializer_list<std::pair<Channel, float>> values) {
    Channels channels{};
    for (const auto& [channel, value] : values)
        channels[channel] = value;
    return channels;
}

// Action units of Ekman and Friesen's FACS in the comments.
std::array<Channels, emotion_count> make_expressions() {
    std::array<Channels, emotion_count> all{};
    all[std::size_t(Emotion::sadness)] =  // 1 + 4 + 15 + 17
        with({{brow_inner_up, 0.95F},
              {brow_down_left, 0.1F},
              {brow_down_right, 0.1F},
              {mouth_frown_left, 0.85F},
              {mouth_frown_right, 0.85F},
              {mouth_shrug_lower, 0.3F},
              {eye_squint_left, 0.1F},
              {eye_squint_right, 0.1F},
              {eye_look_down_left, 0.25F},
              {eye_look_down_right, 0.25F}});
    all[std::size_t(Emotion::disgust)] =  // 9 + 10 + 4
        with({{nose_sneer_left, 0.95F},
              {nose_sneer_right, 0.95F},
              {mouth_upper_up_left, 0.9F},
              {mouth_upper_up_right, 0.9F},
              {mouth_frown_left, 0.15F},
              {mouth_frown_right, 0.15F},
              {brow_down_left, 0.6F},
              {brow_down_right, 0.6F},
              {eye_squint_left, 0.75F},
              {eye_squint_right, 0.75F},
              {cheek_squint_left, 0.4F},
              {cheek_squint_right, 0.4F}});
    all[std::size_t(Emotion::happiness)] =  // 6 + 12 + 25
        with({{mouth_smile_left, 0.9F},
              {mouth_smile_right, 0.9F},
              {cheek_squint_left, 0.65F},
              {cheek_squint_right, 0.65F},
              {eye_squint_left, 0.35F},
              {eye_squint_right, 0.35F},
              {mouth_upper_up_left, 0.2F},
              {mouth_upper_up_right, 0.2F},
              {mouth_lower_down_left, 0.25F},
              {mouth_lower_down_right, 0.25F}});
    all[std::size_t(Emotion::surprise)] =  // 1 + 2 + 5
        with({{brow_inner_up, 0.9F},
              {brow_outer_up_left, 0.9F},
              {brow_outer_up_right, 0.9F},
              {eye_wide_left, 0.9F},
              {eye_wide_right, 0.9F},
              {mouth_funnel, 0.45F}});
    all[std::size_t(Emotion::anger)] =  // 4 + 5 + 7 + 24
        with({{brow_down_left, 0.95F},
              {brow_down_right, 0.95F},
              {eye_wide_left, 0.15F},
              {eye_wide_right, 0.15F},
              {eye_squint_left, 0.5F},
              {eye_squint_right, 0.5F},
              {nose_sneer_left, 0.3F},
              {nose_sneer_right, 0.3F},
              {mouth_press_left, 0.7F},
              {mouth_press_right, 0.7F},
              {mouth_frown_left, 0.25F},
              {mouth_frown_right, 0.25F},
              {mouth_roll_lower, 0.35F},
              {mouth_roll_upper, 0.35F}});
    return all;
}

}  // namespace

const Channels& channels_of(Emotion emotion) {
    static const auto expressions = make_expressions();
    return expressions[std::size_t(emotion)];
}

Emotions limited_weights(const Emotions& weights) {
    float sum = 0;
    for (const float weight : weights)
        sum += limited(weight);
    const float scale = 1 / std::max(sum, 1.0F);
    Emotions shares{};
    for (std::size_t e = 0; e < emotion_count; ++e)
        shares[e] = limited(weights[e]) * scale;
    return shares;
}

Channels blend_expressions(const Emotions& weights, const DirectChannels& direct) {
    const Emotions shares = limited_weights(weights);
    Channels blended{};
    for (std::size_t e = 0; e < emotion_count; ++e) {
        const float share = shares[e];
        const Channels& expression = channels_of(Emotion(e));
        for (std::size_t c = 0; share > 0 && c < channel_count; ++c)
            blended[c] += share * expression[c];
    }
    blended[jaw_open] = limited(direct.jaw_open);
    blended[eye_blink_left] = limited(direct.blink_left);
    blended[eye_blink_right] = limited(direct.blink_right);
    blended[eye_wide_left] *= 1 - blended[eye_blink_left];
    blended[eye_wide_right] *= 1 - blended[eye_blink_right];
    return blended;
}

}  // namespace theatron::face
