// SPDX-License-Identifier: Apache-2.0
// A case that is fetched while something else is measured.
#pragma once

#include "client/participant.h"

namespace theatron::bench {

// Opens the first case that the host offers. The participant keeps room and cases. Throws Error
// if none is offered within 30 s.
void open_offered_case(client::Participant& participant);

// Bytes of the open case that have come, and all.
session::ContentFetch::Progress case_progress(const client::Participant& participant);

}  // namespace theatron::bench
