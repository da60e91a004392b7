// SPDX-License-Identifier: Apache-2.0
// The licence of this program, and the notices of the works that became part of it when it was
// built (cmake/Notices.cmake).
#pragma once

#include <string_view>

namespace theatron::app {

std::string_view licences();

}  // namespace theatron::app
