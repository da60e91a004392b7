// SPDX-License-Identifier: Apache-2.0
// Made-up persons who show the six emotions: what the network learns from, and the scripted actor
// of the demonstration.
//
// The prototypes are action units of Ekman and Friesen's FACS, in several variants. Each person has
// gains, offsets at rest and sides of different strength; each take an intensity, units that fail
// to appear, a beginning and swaying, blinks, gaze and, in half of the takes, speech. A figure that
// is measured on these persons says how well the network learned this model of faces. It is no
// measure of how well it reads real ones.
#pragma once

#include "face/random.h"
#include "face/recording.h"

namespace theatron::face {

class SyntheticPerson {
public:
    // The same person for the same seed.
    explicit SyntheticPerson(std::uint64_t seed);

    struct Wish {
        Emotion emotion = Emotion::neutral;
        double seconds = 3;
        double rate_hz = 30;
        bool speaks = false;
        double onset_s = 0.4;  // until the expression is there
    };
    // `values` of channels outside `mask` are 0. Successive takes differ.
    Take take(const Wish& wish, const ChannelMask& mask);

    // A take of 2 s at rest, as a user gives it for calibration.
    Take rest(const ChannelMask& mask);

private:
    Random random_;
    Channels gain_{}, rest_{};
    double noise_ = 0, liveliness_ = 0;
};

// Two takes of each emotion by each of `persons`, one of them with speech, and before them the
// person's take at rest. Persons of different seeds are different ones.
Recording synthetic_recording(Source source, int persons, std::uint64_t seed);

// The face of the scripted actor at a time: the six emotions in turn, three seconds each.
Channels actor_channels(double seconds);
Emotion actor_emotion(double seconds);

}  // namespace theatron::face
