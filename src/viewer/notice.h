// SPDX-License-Identifier: Apache-2.0
// The newest sentence for the person. It is shown for some seconds, and one from before the first
// picture for some seconds of that: nobody has seen it earlier.
#pragma once

#include <optional>
#include <string>

#include "base/time.h"

namespace theatron::viewer {

class Notice {
public:
    static constexpr Duration time_shown = std::chrono::seconds(5);

    // Replaces the sentence before it.
    void say(std::string text, TimePoint now);
    // That sentence, if it is the newest one, is not true any more.
    void take_back(const std::string& text);
    // The first picture has been shown. Later calls change nothing.
    void begin(TimePoint now);
    // Empty: none, or its time is over.
    const std::string& text(TimePoint now) const;

private:
    std::string text_;
    TimePoint said_at_;
    std::optional<TimePoint> began_at_;
};

}  // namespace theatron::viewer
