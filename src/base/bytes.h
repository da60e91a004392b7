// SPDX-License-Identifier: Apache-2.0
// Little-endian reading and writing of byte sequences, checked at every step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace theatron {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

template <class T>
requires std::is_integral_v<T>
constexpr void store_le(std::byte* out, T value) {
    using U = std::make_unsigned_t<T>;
    const U bits = U(value);
    for (std::size_t i = 0; i < sizeof(T); ++i)
        out[i] = std::byte(std::uint8_t(bits >> (8 * i)));
}

template <class T>
requires std::is_integral_v<T>
constexpr T load_le(const std::byte* in) {
    using U = std::make_unsigned_t<T>;
    U bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
        bits = U(bits | U(U(std::to_integer<std::uint8_t>(in[i])) << (8 * i)));
    return T(bits);
}

// Appends fields to a growing sequence.
class ByteWriter {
public:
    explicit ByteWriter(Bytes& out) : out_(out) {}

    template <class T>
    requires std::is_integral_v<T>
    void put(T value) {
        const std::size_t at = out_.size();
        out_.resize(at + sizeof(T));
        store_le(out_.data() + at, value);
    }
    void put_f64(double value) {
        std::uint64_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        put(bits);
    }
    void put_bytes(ByteView bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }

private:
    Bytes& out_;
};

// Reads fields from outside data. A read past the end yields zero and marks the
// reader as failed; check ok() once after a group of fields. Safe on any bytes.
class ByteReader {
public:
    explicit ByteReader(ByteView in) : in_(in) {}

    template <class T>
    requires std::is_integral_v<T> T get() {
        if (in_.size() < sizeof(T)) {
            fail();
            return 0;
        }
        const T value = load_le<T>(in_.data());
        in_ = in_.subspan(sizeof(T));
        return value;
    }
    double get_f64() {
        const auto bits = get<std::uint64_t>();
        double value;
        std::memcpy(&value, &bits, sizeof(value));
        return value;
    }
    ByteView get_bytes(std::size_t count) {
        if (in_.size() < count) {
            fail();
            return {};
        }
        const ByteView bytes = in_.first(count);
        in_ = in_.subspan(count);
        return bytes;
    }

    bool ok() const { return !failed_; }
    ByteView rest() const { return in_; }

private:
    void fail() {
        failed_ = true;
        in_ = {};
    }

    ByteView in_;
    bool failed_ = false;
};

inline ByteView as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace theatron
