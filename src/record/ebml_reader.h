// SPDX-License-Identifier: Apache-2.0
// EBML elements (RFC 8794) of a file that may be larger than memory. Safe on
// any bytes: nothing is read outside of an element's parent.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/bytes.h"
#include "base/status.h"
#include "record/byte_source.h"

namespace theatron::record {

// Headers of blocks lie between images: a small window spares most system calls.
class Window {
public:
    explicit Window(ByteSource& source) : source_(source) {}

    std::uint64_t size() const { return source_.size(); }

    bool read(std::uint64_t at, std::span<std::byte> out) {
        if (out.size() > bytes_.size())
            return source_.read(at, out);
        if (at < begin_ || at + out.size() > begin_ + filled_) {
            if (at > size())
                return false;
            filled_ = std::size_t(std::min<std::uint64_t>(bytes_.size(), size() - at));
            begin_ = at;
            if (out.size() > filled_ ||
                !source_.read(at, std::span<std::byte>(bytes_).first(filled_))) {
                filled_ = 0;
                return false;
            }
        }
        std::copy_n(bytes_.begin() + std::ptrdiff_t(at - begin_), out.size(), out.begin());
        return true;
    }

private:
    ByteSource& source_;
    std::array<std::byte, 1024> bytes_;
    std::uint64_t begin_ = 0;
    std::size_t filled_ = 0;
};

struct Element {
    std::uint32_t id = 0;
    std::uint64_t begin = 0;  // of its content
    std::uint64_t end = 0;    // at most the end of its parent
    bool size_known = true;

    std::uint64_t size() const { return end - begin; }
};

// Reads the head of the element at `at`, which must end before `end`.
inline Result<Element> read_element(Window& window, std::uint64_t at, std::uint64_t end) {
    const auto byte_at = [&](std::uint64_t where, unsigned& value) {
        std::byte b;
        if (where >= end || !window.read(where, {&b, 1}))
            return false;
        value = std::to_integer<unsigned>(b);
        return true;
    };
    unsigned first = 0;
    if (!byte_at(at, first))
        return Status::truncated;
    Element element;
    int length = 1;
    while (length <= 4 && !(first & (0x100u >> length)))
        ++length;
    if (length > 4)
        return Status::malformed;
    element.id = first;
    for (int i = 1; i < length; ++i) {
        unsigned next = 0;
        if (!byte_at(at + std::uint64_t(i), next))
            return Status::truncated;
        element.id = element.id << 8 | next;
    }

    at += std::uint64_t(length);
    if (!byte_at(at, first))
        return Status::truncated;
    length = 1;
    while (length <= 8 && !(first & (0x100u >> length)))
        ++length;
    if (length > 8)
        return Status::malformed;
    std::uint64_t size = first & ((0x100u >> length) - 1);
    for (int i = 1; i < length; ++i) {
        unsigned next = 0;
        if (!byte_at(at + std::uint64_t(i), next))
            return Status::truncated;
        size = size << 8 | next;
    }
    element.begin = at + std::uint64_t(length);
    element.size_known = size != (std::uint64_t(1) << (7 * length)) - 1;
    element.end = end;
    if (element.size_known) {
        if (size > end - element.begin)
            return Status::truncated;
        element.end = element.begin + size;
    }
    return element;
}

// Calls `visit` for each child in turn, until one is refused.
template <class Visit>
Status for_each_child(Window& window, const Element& parent, Visit visit) {
    for (std::uint64_t at = parent.begin; at < parent.end;) {
        const Result<Element> child = read_element(window, at, parent.end);
        if (!child)
            return child.error();
        if (!child->size_known)
            return Status::malformed;
        if (const Status status = visit(*child); status != Status::ok)
            return status;
        at = child->end;
    }
    return Status::ok;
}

inline Status read_unsigned(Window& window, const Element& element, std::uint64_t& value) {
    std::array<std::byte, 8> bytes;
    if (element.size() > bytes.size())
        return Status::malformed;
    const std::size_t size = std::size_t(element.size());
    if (!window.read(element.begin, std::span(bytes).first(size)))
        return Status::truncated;
    value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    return Status::ok;
}

}  // namespace theatron::record
