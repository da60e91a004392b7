// SPDX-License-Identifier: Apache-2.0
// The comparison as one page of HTML with its pictures, for people who decide and know no codec.
// The file needs no other file and no network.
#pragma once

#include <string>

#include "compare.h"

namespace theatron::bench {

std::string compare_page(const Compared& compared);

}  // namespace theatron::bench
