// SPDX-License-Identifier: Apache-2.0
#include "face/emotion_reader.h"

#include <algorithm>
#include <cmath>

namespace theatron::face {

void EmotionReader::calibrate(TimePoint now) {
    calibrated_from_ = now;
    calibration_.clear();
}

void EmotionReader::keep(const FaceNow& face, TimePoint now) {
    if (window_.empty())
        began_ = now;
    const float time_s = float(to_seconds(now - began_));
    // Trackers of more than 300 Hz are thinned out.
    if (window_.empty() || time_s - window_.back().time_s >= window_s / float(max_samples - 8))
        window_.push_back({time_s, face.values});
    else
        window_.back().values = face.values;
    // One sample that is older shows that the window is full.
    std::size_t old = 0;
    while (old + 1 < window_.size() && time_s - window_[old + 1].time_s > window_s)
        ++old;
    window_.erase(window_.begin(), window_.begin() + std::ptrdiff_t(old));
    if (!calibrated_from_)
        return;
    if (now - *calibrated_from_ < calibration) {
        if (calibration_.size() < 10 * max_samples)
            calibration_.push_back({time_s, face.values});
    } else if (!calibration_.empty()) {
        rest_ = mean_of(calibration_);
        calibrated_from_.reset();
        calibration_.clear();
    }
}

void EmotionReader::smooth(const Emotions& told, TimePoint now) {
    const double step_s = last_ ? std::clamp(to_seconds(now - *last_), 0.0, 1.0) : 0;
    const float follow = float(1 - std::exp(-step_s / smoothing_s));
    for (std::size_t i = 0; i < emotion_count; ++i)
        now_.weights[i] += follow * (told[i] - now_.weights[i]);
    last_ = now;
}

void EmotionReader::decide_steadily(TimePoint now) {
    const Emotion best = decide(now_.weights);
    // Anger that is not certain enough is neutral, whatever the weight of neutral is.
    const bool leads =
        now_.weights[std::size_t(best)] >= now_.weights[std::size_t(now_.told)] + margin ||
        (now_.told == Emotion::anger && best == Emotion::neutral);
    if (best == now_.told || !leads) {
        candidate_ = now_.told;
        return;
    }
    if (best != candidate_) {
        candidate_ = best;
        candidate_since_ = now;
    }
    if (now - candidate_since_ >= steady)
        now_.told = best;
}

EmotionNow EmotionReader::put(const FaceNow& face, TimePoint now) {
    Emotions told{0, 0, 0, 0, 0, 1};
    if (face.tracking == Tracking::tracked) {
        keep(face, now);
        // A person is not read while they are asked to be at rest.
        if (fills_window(window_) && !calibrated_from_)
            told =
                evaluate(network_, features_of(window_, rest_.value_or(Channels{})), face.present);
    } else {
        window_.clear();
    }
    smooth(told, now);
    decide_steadily(now);
    now_.is_calibrated = rest_.has_value();
    return now_;
}

}  // namespace theatron::face
