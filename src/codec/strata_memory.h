// SPDX-License-Identifier: Apache-2.0
// What Strata remembers of a frame besides its depth, as bytes in
// Reference::memory: never sent, the same on both sides.
#pragma once

#include "base/bytes.h"
#include "codec/strata_layout.h"
#include "codec/strata_tables.h"
#include "codec/strata_values.h"

namespace theatron::codec::strata {

// The part in front of the planes.
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

// A view of the memory's parts.
struct Memory {
    MemoryHead* head = nullptr;
    std::uint16_t* depth = nullptr;
    std::uint64_t* valid = nullptr;

    Values values() const {
        return {head->values.begin(), head->values.begin() + head->value_count};
    }
};

// Gives `bytes` the size that the layout needs; contents are unspecified.
Memory make_memory(const Layout& layout, Bytes& bytes);

// False if the bytes are not a memory of this layout.
bool open_memory(const Layout& layout, const Bytes& bytes, Memory& memory);

}  // namespace theatron::codec::strata
