// SPDX-License-Identifier: Apache-2.0
// Ctrl-C, SIGTERM and SIGHUP (its terminal is gone) end a command cleanly: running work stops,
// files are closed, figures are printed. A thread of its own ends the process where something
// hangs meanwhile, as end_watch.h says.
#pragma once

#include "cli/end_watch.h"

namespace theatron::cli {

// From now on the signals only set a flag.
void catch_stop_signals();
bool stop_requested();
// The first of these signals was Ctrl-C: a person at the terminal ends the command, and no service
// manager that may start it again.
bool stopped_by_person();

// The command ends by itself, because of a key, a line or the end of a session: from now on it has
// as long as after a signal. The exit code is that of a process which must be ended.
void begin_end(int exit_code = 0);

// While one lives something must be saved, for which the command has this long. A process that has
// not saved it then ends with exit code 1.
class Saving {
public:
    explicit Saving(Duration patience);
    ~Saving();
    Saving(const Saving&) = delete;
    Saving& operator=(const Saving&) = delete;

private:
    const Duration patience_;
};

}  // namespace theatron::cli
