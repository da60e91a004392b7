// SPDX-License-Identifier: Apache-2.0
// The six emotions as expressions of a face: what each moves, and their blend with the channels
// that follow the person directly. Pure.
#pragma once

#include "face/channels.h"
#include "face/emotion.h"

namespace theatron::face {

// The channels of an emotion at full strength; of `neutral`: all 0. Jaw and lids are at rest, since
// they follow the person.
const Channels& channels_of(Emotion emotion);

// Channels that move with the person, whatever the emotions are.
struct DirectChannels {
    float jaw_open = 0, blink_left = 0, blink_right = 0;
};

// Weights limited to 0..1, and divided by their sum where that is above 1; a weight that is no
// number is 0.
Emotions limited_weights(const Emotions& weights);

// A face of these emotions. Channels are limited to 0..1; one that is no number is 0. A closed lid
// opens no wider for an emotion.
Channels blend_expressions(const Emotions& weights, const DirectChannels& direct);

}  // namespace theatron::face
