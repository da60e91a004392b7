// SPDX-License-Identifier: Apache-2.0
// A recording of cameras of this machine, without a session.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture/camera.h"
#include "record/source.h"

namespace theatron::host {

// Opens the cameras, waits for all of them, and begins with all at once.
std::unique_ptr<record::RecordSource> record_cameras(const std::vector<std::string>& specifications,
                                                     const std::string& file,
                                                     const record::RecordCodecs& codecs,
                                                     const record::Recorder::Options& options,
                                                     const capture::Progress& progress);

}  // namespace theatron::host
