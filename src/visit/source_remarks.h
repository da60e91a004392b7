// SPDX-License-Identifier: Apache-2.0
// Sentences for the person who sends cameras and screens: that one of them stands still and why,
// and that it goes on.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/time.h"
#include "publish/camera_publisher.h"
#include "wire/control.h"

namespace theatron::visit {

class SourceRemarks {
public:
    // A shorter pause of a source is not worth a sentence.
    static constexpr Duration patience = std::chrono::seconds(1);

    struct Source {
        std::string name;
        wire::CameraCondition condition{};
        std::string problem;  // a sentence, or empty
    };
    // The sentences that are new with this state of all sources, which keep their order. A reason
    // that changes while a source stands still is said once more, not more often.
    std::vector<std::string> take(const std::vector<Source>& sources, TimePoint now);
    // The same of a publisher, without the sources whose share somebody has ended. It may be called
    // at any rate.
    std::vector<std::string> take(const publish::CameraPublisher& publisher, TimePoint now);

private:
    struct Known {
        bool stands = false;
        TimePoint since;
        int said = 0;
        std::string last;
    };
    std::map<std::size_t, Known> known_;  // by place in the list
    TimePoint next_look_;                 // at a publisher
};

// Writes them on the terminal.
void say(const std::vector<std::string>& remarks);

}  // namespace theatron::visit
