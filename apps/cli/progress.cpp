// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <unistd.h>

#include <memory>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"

namespace theatron::cli {

capture::Progress show_progress() {
    struct State {
        std::string what;
        TimePoint begin;
        int shown = -1;  // percent
    };
    const auto state = std::make_shared<State>();
    const bool terminal = isatty(STDERR_FILENO);
    return [state, terminal](std::string_view what, double done) {
        if (stop_requested())
            throw Error("Stopped before this was complete: " + std::string(what) + ".");
        if (state->what != what)
            *state = {std::string(what), steady_now(), -1};
        // A step shorter than a second shows no progress.
        if (steady_now() - state->begin < 1s)
            return;
        const int percent = int(done * 100) / (terminal ? 1 : 10) * (terminal ? 1 : 10);
        if (percent == state->shown)
            return;
        state->shown = percent;
        const std::string line = state->what + " " + std::to_string(percent) + " %";
        if (!terminal)
            return log::say(line);
        output::status_line(line, output::Stream::error);
        if (percent >= 100)
            output::end_status_line();
    };
}

}  // namespace theatron::cli
