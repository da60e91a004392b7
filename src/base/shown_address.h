// SPDX-License-Identifier: Apache-2.0
// Addresses of streams on their way into sentences, logs and figures.
#pragma once

#include <string>
#include <string_view>

namespace theatron {

// The first address in `text`, SCHEME://USER:PASSWORD@HOST/PATH?QUERY, without user and password,
// and ending with "..." where a query begins, or a part of the path that names a value: cameras
// take passwords there, too. A text without an address stays as it is.
std::string shown_address(std::string_view text);

}  // namespace theatron
