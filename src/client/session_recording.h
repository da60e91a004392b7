// SPDX-License-Identifier: Apache-2.0
// A recording of a session that is joined for it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "files/state_folder.h"
#include "net/link.h"
#include "record/source.h"

namespace theatron::client {

// Joins the session as `name` and records its streams as they arrive. `patience`: how long to wait
// for a host that does not answer, at the beginning and after each loss; not given: 15 s, then
// until it is told to end. `person_folder`: of the person's id (client/person_id.h).
std::unique_ptr<record::RecordSource> record_session(
    const net::Link& link, const std::string& name, const std::string& file,
    const record::RecordCodecs& codecs, const record::Recorder::Options& options,
    std::optional<Duration> patience = {},
    const std::filesystem::path& person_folder = files::state_folder());

}  // namespace theatron::client
