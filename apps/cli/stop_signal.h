// SPDX-License-Identifier: Apache-2.0
// Ctrl-C, SIGTERM and SIGHUP (its terminal is gone) end a command cleanly: running work stops,
// files are closed, figures are printed.
#pragma once

namespace theatron::cli {

// From now on the signals only set a flag.
void catch_stop_signals();
bool stop_requested();

}  // namespace theatron::cli
