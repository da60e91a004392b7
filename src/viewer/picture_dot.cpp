// SPDX-License-Identifier: Apache-2.0
#include "viewer/picture_dot.h"

#include <algorithm>
#include <cstdio>

#include "pace/drawing_watch.h"
#include "phrases/phrase.h"
#include "viewer/age_text.h"

namespace theatron::viewer {
namespace {

// "0.1": of a live picture, in tenths, at least one.
std::string tenths(double ms) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f", std::max(ms, 100.0) / 1000);
    return decimal(text);
}

}  // namespace

window::PictureDot picture_dot(const DotFacts& facts) {
    using Level = window::PictureDot::Level;
    using Phase = client::Participant::Phase;
    const auto dot = [](Level level, const std::string& words) {
        return window::PictureDot{level, words,
                                  say(level == Level::good   ? Phrase::dot_good_hint
                                      : level == Level::slow ? Phrase::dot_slow_hint
                                                             : Phrase::dot_bad_hint)};
    };
    if (facts.phase == Phase::connecting || facts.phase == Phase::waiting)
        return {Level::slow, say(Phrase::dot_is_connecting), ""};
    if (facts.phase != Phase::joined)
        return {Level::bad, say(Phrase::dot_no_connection), ""};
    if (facts.is_of_another_time)
        return dot(Level::bad, say(Phrase::dot_not_live));
    if (!facts.has_picture)
        return dot(Level::slow, say(Phrase::dot_no_picture));
    if (facts.age_ms.value_or(0) >= to_ms(pace::still_after))
        return dot(Level::bad, say(Phrase::dot_old, age_text(*facts.age_ms)));
    if (facts.is_missing_a_camera)
        return dot(Level::bad, say(Phrase::dot_not_live));
    const std::string words =
        facts.age_ms ? say(Phrase::dot_live, tenths(*facts.age_ms)) : say(Phrase::dot_live_unknown);
    window::PictureDot shown =
        dot(facts.age_ms.value_or(0) >= old_picture_ms || facts.is_late || facts.unrest > 0
                ? Level::slow
                : Level::good,
            words);
    if (facts.unrest > 0)
        shown.hint = say(Phrase::dot_unrest_hint, std::to_string(facts.unrest));
    return shown;
}

}  // namespace theatron::viewer
