// SPDX-License-Identifier: Apache-2.0
#include "wire/condition_text.h"

namespace theatron::wire {

const char* text_of(CameraCondition condition) {
    switch (condition) {
        case CameraCondition::live:
            return "live";
        case CameraCondition::stale:
            return "stale";
        case CameraCondition::ended:
            return "ended";
        case CameraCondition::failed:
            return "failed";
    }
    return "unknown";
}

}  // namespace theatron::wire
