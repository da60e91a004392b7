// SPDX-License-Identifier: Apache-2.0
// Strata in the browser beside the same decoder for one instruction set of this machine.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "browser_page.h"

namespace theatron::bench {

// {strata_decode_ms, native_sse4_decode_ms, strata_decode_over_native_sse4}: the fastest of some
// passes over a key frame of 640x576, in the page's own thread. The ratio is 0 where this processor
// has no SSE4. `page` has loaded the client. Throws Error.
nlohmann::json time_strata(BrowserPage& page);

}  // namespace theatron::bench
