// SPDX-License-Identifier: Apache-2.0
// The bytes of a recording: a file that may be larger than memory, or bytes in
// memory.
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
    // Fills `out` with the bytes from `at` on; false if the source ends before. From any thread.
    virtual bool read(std::uint64_t at, std::span<std::byte> out) = 0;
};

class MemorySource final : public ByteSource {
public:
    // `bytes` must outlive this object.
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

// A part of another source, which must reach that far.
class PartSource final : public ByteSource {
public:
    PartSource(std::shared_ptr<ByteSource> whole, std::uint64_t begin, std::uint64_t end)
        : whole_(std::move(whole)), begin_(begin), size_(end - begin) {
        // A part of a part refers to the whole directly.
        if (const auto* part = dynamic_cast<const PartSource*>(whole_.get())) {
            begin_ += part->begin_;
            whole_ = std::shared_ptr(part->whole_);
        }
    }
    std::uint64_t size() const override { return size_; }
    bool read(std::uint64_t at, std::span<std::byte> out) override {
        return at <= size_ && size_ - at >= out.size() && whole_->read(begin_ + at, out);
    }

private:
    std::shared_ptr<ByteSource> whole_;
    std::uint64_t begin_, size_;
};

// A regular file, read without mapping it: it may shrink meanwhile. Throws
// Error if it cannot be opened.
std::unique_ptr<ByteSource> open_file_source(const std::filesystem::path& path);

}  // namespace theatron::record
