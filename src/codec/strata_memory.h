// SPDX-License-Identifier: Apache-2.0
// The part of a Strata reference frame other than its depth image, kept as bytes in
// Reference::memory. It is never sent; both sides compute it equally.
#pragma once

#include "base/bytes.h"
#include "codec/strata_layout.h"
#include "codec/strata_tables.h"
#include "codec/strata_values.h"

namespace theatron::codec::strata {

// The header in front of the planes.
struct MemoryHead {
    std::uint32_t magic = 0;
    std::uint16_t width = 0, height = 0;
    std::uint16_t value_count = 0;
    std::uint8_t blend = 0;
    std::uint8_t age = 0;  // see next_age in strata.cpp
    Levels levels{};
    std::array<std::uint16_t, max_values> values{};
};

inline constexpr std::uint32_t memory_magic = 0x31a7a257;

// Pointers to the parts of the bytes, not owned.
struct Memory {
    MemoryHead* head = nullptr;
    std::uint16_t* depth = nullptr;
    std::uint64_t* valid = nullptr;

    Values values() const {
        return {head->values.begin(), head->values.begin() + head->value_count};
    }
};

// Resizes `bytes` for the layout; contents are unspecified. The result points into
// `bytes`.
Memory make_memory(const Layout& layout, Bytes& bytes);

// Checks and opens bytes of make_memory. False if they do not belong to this layout.
bool open_memory(const Layout& layout, const Bytes& bytes, Memory& memory);

}  // namespace theatron::codec::strata
