// SPDX-License-Identifier: Apache-2.0
// Where a recording's bytes come from: a file that may be larger than memory,
// or bytes in memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "base/bytes.h"

namespace theatron::record {

class ByteSource {
public:
    virtual ~ByteSource() = default;
    virtual std::uint64_t size() const = 0;
    // Fills `out` from `at` on; false if not all of it is there.
    virtual bool read(std::uint64_t at, std::span<std::byte> out) = 0;
};

class MemorySource final : public ByteSource {
public:
    // `bytes` must stay.
    explicit MemorySource(ByteView bytes) : bytes_(bytes) {}
    std::uint64_t size() const override { return bytes_.size(); }
    bool read(std::uint64_t at, std::span<std::byte> out) override {
        if (at > bytes_.size() || bytes_.size() - at < out.size())
            return false;
        std::copy_n(bytes_.begin() + std::ptrdiff_t(at), out.size(), out.begin());
        return true;
    }

private:
    ByteView bytes_;
};

// A regular file, read without mapping it: it may shrink meanwhile. Throws
// Error if it cannot be opened.
std::unique_ptr<ByteSource> open_file_source(const std::filesystem::path& path);

}  // namespace theatron::record
