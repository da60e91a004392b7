// SPDX-License-Identifier: Apache-2.0
// The readers of foreign files and streams as which this program starts itself.
#pragma once

#include <iterator>
#include <vector>

#include "capture/mkv_reader.h"
#include "cases/foreign_files.h"

namespace theatron::app {

inline std::vector<sandbox::Reader> foreign_readers() {
    std::vector<sandbox::Reader> readers(std::begin(capture::foreign_readers),
                                         std::end(capture::foreign_readers));
    readers.insert(readers.end(), std::begin(cases::foreign_readers),
                   std::end(cases::foreign_readers));
    return readers;
}

}  // namespace theatron::app
