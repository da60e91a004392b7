// SPDX-License-Identifier: Apache-2.0
// A file in memory whose content is exchanged while a reader's process holds it open: one process
// reads several files, and opens none. One thread at a time. Only for this module.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "base/descriptor.h"

namespace theatron::cases {

class ExchangedFile {
public:
    ExchangedFile();  // empty; throws Error

    int descriptor() const { return memory_.get(); }

    // Takes the bytes of the file in the place of those before. Follows no link. Throws Error, also
    // where the file has more than `most` bytes.
    void load(const std::filesystem::path& path, std::size_t most);

private:
    Descriptor memory_;
    std::vector<char> buffer_;
};

}  // namespace theatron::cases
