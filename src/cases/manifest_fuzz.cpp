// SPDX-License-Identifier: Apache-2.0
// Any text: reading a manifest ends with a case or a problem. A case that was read: writing and
// reading it gives the same again.
#include <cstdint>
#include <cstdlib>

#include "cases/manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron::cases;
    const ParsedManifest parsed = parse_manifest({reinterpret_cast<const char*>(data), size});
    if (!parsed.problem.empty())
        return 0;
    const ParsedManifest again = parse_manifest(manifest_text(parsed.value));
    if (!again.problem.empty() || again.value != parsed.value)
        std::abort();
    return 0;
}
