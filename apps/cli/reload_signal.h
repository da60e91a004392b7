// SPDX-License-Identifier: Apache-2.0
// SIGHUP to a service, which has no terminal that could be gone: it looks at its files again. For a
// program that a service manager has started (service_notice.h).
#pragma once

namespace theatron::cli {

// Call it after catch_stop_signals(), for which SIGHUP is an end.
void catch_reload_signal();
// True once after each signal, or several of them.
bool take_reload_signal();

}  // namespace theatron::cli
