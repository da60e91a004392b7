// SPDX-License-Identifier: Apache-2.0
// Strata: vectors of 16-bit lanes, their masks as bits, and look-ups of bytes.
// Included once per instruction set, by strata_kernel.cpp.
//
// Highway 1.0 looks up bytes one by one in WebAssembly, and makes bits of masks by
// multiplication. WebAssembly has instructions for both, which are used here.

// No include guard: the namespace differs from one inclusion to the next.
#include <cstring>

#include "codec/strata_kernel.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<std::uint16_t, lane_count>;
using S16 = hn::RebindToSigned<D16>;
using D8 = hn::Rebind<std::uint8_t, D16>;
using V16 = hn::Vec<D16>;
using VS16 = hn::Vec<S16>;

inline constexpr int part_lanes = int(hn::MaxLanes(D16()));
inline constexpr int part_count = lane_count / part_lanes;
// Highway's vectors for WebAssembly have none of their own. One that crosses a cache line is slow.
inline constexpr std::size_t vector_alignment = 64;

// Converts the lowest bits of a 64-bit mask to a vector mask, and back.
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
HWY_INLINE hn::Mask<D16> mask_of(std::uint64_t bits) {
    return hn::Mask<D16>{static_cast<decltype(hn::Mask<D16>::raw)>(bits)};
}
HWY_INLINE std::uint64_t bits_of(hn::Mask<D16> mask) {
    return mask.raw;
}
#else
HWY_INLINE hn::Mask<D16> mask_of(std::uint64_t bits) {
    std::uint8_t bytes[sizeof(bits)];
    std::memcpy(bytes, &bits, sizeof(bits));
    return hn::LoadMaskBits(D16(), bytes);
}
HWY_INLINE std::uint64_t bits_of(hn::Mask<D16> mask) {
#if HWY_TARGET == HWY_WASM
    return std::uint64_t(wasm_i16x8_bitmask(mask.raw));
#else
    // Highway converts masks to bits only through memory.
    std::uint8_t bytes[sizeof(std::uint64_t)] = {};
    hn::StoreMaskBits(D16(), mask, bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
#endif
}
#endif

// a < b, both below 2^15: most instruction sets compare signed numbers only.
HWY_INLINE hn::Mask<D16> less(V16 a, V16 b) {
    return hn::RebindMask(D16(), hn::Lt(hn::BitCast(S16(), a), hn::BitCast(S16(), b)));
}

// A table that is loaded where it is used. em++ would put its bytes into the code, from which
// browsers make a vector with four instructions each time.
template <class T>
HWY_INLINE const T* in_memory(const T* table) {
#if HWY_TARGET == HWY_WASM
    asm("" : "+r"(table));
#endif
    return table;
}

#if HWY_TARGET != HWY_SCALAR
// The bytes of `from` at these places, 0 to 15, in each 16 bytes.
template <class V8>
HWY_INLINE V8 bytes_at(V8 from, V8 places) {
#if HWY_TARGET == HWY_WASM
    return V8{wasm_i8x16_swizzle(from.raw, places.raw)};
#else
    return hn::TableLookupBytes(from, places);
#endif
}
#endif

}  // namespace theatron::codec::strata::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
