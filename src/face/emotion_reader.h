// SPDX-License-Identifier: Apache-2.0
// Six emotions out of a stream of channels: calibration, network, smoothing, and a decision that
// does not flicker. Time is passed in.
//
// The result is a guess about a face's muscles. It does not say what a person feels.
#pragma once

#include <optional>

#include "face/face_input.h"
#include "face/network.h"

namespace theatron::face {

struct EmotionNow {
    Emotions weights{};  // smoothed; for blending pictures and shapes. Their sum is 1.
    Emotion told = Emotion::neutral;
    bool is_calibrated = false;
};

class EmotionReader {
public:
    // Weights follow the network by a first-order filter with this time constant.
    static constexpr double smoothing_s = 0.3;
    // Another emotion is told after it led the present one by `margin` for `steady`.
    static constexpr float margin = 0.15F;
    static constexpr Duration steady = 400ms;
    static constexpr Duration calibration = 2s;

    explicit EmotionReader(const Network& network) : network_(network) {}

    // From now on the face is at rest, for `calibration`. Before the first one the tracker's own
    // zero is taken for rest.
    void calibrate(TimePoint now);
    // A rest that is known from earlier.
    void set_rest(const Channels& rest) { rest_ = rest; }

    // Call it for each new state of the face, at least ten times a second. A face that is not
    // tracked is neutral: the window is forgotten.
    EmotionNow put(const FaceNow& face, TimePoint now);

private:
    void keep(const FaceNow& face, TimePoint now);
    void smooth(const Emotions& told, TimePoint now);
    void decide_steadily(TimePoint now);

    static constexpr std::size_t max_samples = 256;

    Network network_;
    std::optional<Channels> rest_;
    std::optional<TimePoint> calibrated_from_, last_;
    TimePoint began_;
    std::vector<Sample> calibration_, window_;
    EmotionNow now_{{0, 0, 0, 0, 0, 1}, Emotion::neutral, false};
    Emotion candidate_ = Emotion::neutral;
    TimePoint candidate_since_;
};

}  // namespace theatron::face
