// SPDX-License-Identifier: Apache-2.0
#include "window_watch.h"

#include "base/log.h"
#include "cli/stop_signal.h"
#include "phrases/phrase.h"
#include "viewer/age_text.h"

namespace theatron::app {
namespace {

std::string words(Duration still) {
    return say(Phrase::window_stands_still, viewer::age_text(to_ms(still)));
}

// A picture that looks live is worse than none.
void end_uncovered() {
    log::say(say(Phrase::window_cannot_be_covered));
    cli::begin_end(1);
}

}  // namespace

WindowWatch::WindowWatch(const window::DesktopWindow& window)
    : cover_(window.x11_number(), words, end_uncovered) {}

}  // namespace theatron::app
