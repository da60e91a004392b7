// SPDX-License-Identifier: Apache-2.0
// Any text: what is taken for a recording is in range, and is the same after being written.
#include <cstdlib>

#include "face/recording.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron::face;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const RecordingRead read = parse_recording(text);
    if (!read.problem.empty())
        return 0;
    for (const Take& take : read.recording.takes)
        for (const Sample& sample : take.samples)
            for (const float value : sample.values)
                if (!(value >= 0 && value <= 1))
                    std::abort();
    const std::string written = recording_text(read.recording);
    const RecordingRead again = parse_recording(written);
    // A recording of nothing but fear has no row that could be written.
    if (!read.recording.takes.empty() &&
        (!again.problem.empty() || again.recording.takes.size() != read.recording.takes.size()))
        std::abort();
    return 0;
}
