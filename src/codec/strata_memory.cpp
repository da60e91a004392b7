// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_memory.h"

#include <new>

namespace theatron::codec::strata {
namespace {

static_assert(plane_stride * 2 % sizeof(std::uint64_t) == 0);
constexpr std::size_t head_size = (sizeof(MemoryHead) + 63) / 64 * 64;

std::size_t memory_size(const Layout& layout) {
    return head_size + layout.plane_values() * 2 + layout.plane_steps() * 8;
}

Memory parts(const Layout& layout, std::byte* bytes) {
    Memory memory;
    memory.head = reinterpret_cast<MemoryHead*>(bytes);
    memory.depth = reinterpret_cast<std::uint16_t*>(bytes + head_size);
    memory.valid = reinterpret_cast<std::uint64_t*>(bytes + head_size + layout.plane_values() * 2);
    return memory;
}

}  // namespace

Memory make_memory(const Layout& layout, Bytes& bytes) {
    bytes.resize(memory_size(layout));
    Memory memory = parts(layout, bytes.data());
    new (memory.head) MemoryHead;
    memory.head->magic = memory_magic;
    memory.head->width = std::uint16_t(layout.size.width);
    memory.head->height = std::uint16_t(layout.size.height);
    return memory;
}

bool open_memory(const Layout& layout, const Bytes& bytes, Memory& memory) {
    if (bytes.size() != memory_size(layout))
        return false;
    memory = parts(layout, const_cast<std::byte*>(bytes.data()));
    return memory.head->magic == memory_magic && memory.head->width == layout.size.width &&
           memory.head->height == layout.size.height && memory.head->value_count <= max_values;
}

}  // namespace theatron::codec::strata
