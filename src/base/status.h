// SPDX-License-Identifier: Apache-2.0
// How functions say that outside data was refused, without exceptions or text.
//
// Status is the plain answer, Result<T> an answer with a value. Both are
// returned by value, allocate nothing and are safe on the frame path. Set-up
// code that meets rare, deep failures throws base/error.h's Error instead.
#pragma once

#include <cassert>
#include <cstdint>
#include <string_view>
#include <utility>

namespace theatron {

// Why a piece of outside data was refused.
enum class [[nodiscard]] Status : std::uint8_t{
    ok,
    truncated,            // input ended inside a field
    malformed,            // a field holds a value the format forbids
    unsupported_version,  // valid, but newer than this build
    unsupported,          // valid, but uses something this build cannot do
    size_mismatch,        // valid, but not the size the caller prepared for
    too_large,            // beyond a stated limit
    trailing_bytes,       // complete message followed by more bytes
    missing_reference,    // a temporal frame whose reference frame is not here
};

// A few words for a person, for example "truncated".
constexpr std::string_view to_text(Status status) {
    switch (status) {
        case Status::ok:
            return "ok";
        case Status::truncated:
            return "truncated";
        case Status::malformed:
            return "malformed";
        case Status::unsupported_version:
            return "made by a newer version";
        case Status::unsupported:
            return "not supported by this build";
        case Status::size_mismatch:
            return "of an unexpected size";
        case Status::too_large:
            return "too large";
        case Status::trailing_bytes:
            return "followed by surplus bytes";
        case Status::missing_reference:
            return "missing its reference frame";
    }
    return "unknown";
}

// A value or the reason why there is none. The member names are those of
// std::expected, which C++20 does not have yet.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : value_(std::move(value)), error_(Status::ok) {}
    Result(Status error) : error_(error) { assert(error != Status::ok); }

    bool has_value() const { return error_ == Status::ok; }
    explicit operator bool() const { return has_value(); }
    Status error() const { return error_; }

    T& value() {
        assert(has_value());
        return value_;
    }
    const T& value() const {
        assert(has_value());
        return value_;
    }
    T& operator*() { return value(); }
    const T& operator*() const { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

private:
    T value_{};
    Status error_;
};

}  // namespace theatron
