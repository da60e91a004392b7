// SPDX-License-Identifier: Apache-2.0
// A recording of a session that is joined for it.
#pragma once

#include <memory>
#include <string>

#include "net/link.h"
#include "record/source.h"

namespace theatron::client {

// Joins the session and records what comes as it comes.
std::unique_ptr<record::RecordSource> record_session(const net::Link& link, const std::string& file,
                                                     const record::RecordCodecs& codecs,
                                                     const record::Recorder::Options& options);

}  // namespace theatron::client
