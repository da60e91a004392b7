// SPDX-License-Identifier: Apache-2.0
// Counts the allocations of a test program. Replaces the program's operator new: for one file of
// each program only.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

// Sanitizers see allocations by an operator new of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define THEATRON_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define THEATRON_COUNTS_ALLOCATIONS 0
#endif
#endif
#ifndef THEATRON_COUNTS_ALLOCATIONS
#define THEATRON_COUNTS_ALLOCATIONS 1
#endif

namespace theatron::testing {

// False: a test of allocations skips, with the reason.
inline constexpr bool counts_allocations = THEATRON_COUNTS_ALLOCATIONS;
inline constexpr const char* counts_none =
    "a sanitizer's own operator new is in the place of the one that counts";

// Those of all threads while `counting`; large ones have 4096 bytes or more.
inline std::atomic<bool> counting{false};
inline std::atomic<std::uint64_t> allocations{0}, large_allocations{0};

}  // namespace theatron::testing

#if THEATRON_COUNTS_ALLOCATIONS
// The compiler takes those that it sees through for calls of malloc() and free() that do not match.
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (theatron::testing::counting) {
        ++theatron::testing::allocations;
        if (size >= 4096)
            ++theatron::testing::large_allocations;
    }
    if (void* memory = std::malloc(size))
        return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
#endif
