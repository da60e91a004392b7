// SPDX-License-Identifier: Apache-2.0
// A bounded queue from one thread to one other: no call waits, takes a lock or allocates. For
// threads that must be done in time, such as the callbacks of sound devices.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace theatron {

template <class T>
class SpscRing {
    static_assert(std::is_trivially_copyable_v<T>);
    static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

public:
    explicit SpscRing(std::size_t capacity) : items_(capacity) {}
    SpscRing(const SpscRing&) = delete;
    SpscRing& operator=(const SpscRing&) = delete;

    std::size_t capacity() const noexcept { return items_.size(); }

    // From the thread that puts. Takes as many of the first items as there is room for, and returns
    // their number.
    std::size_t put(std::span<const T> items) noexcept {
        const std::uint64_t begin = put_.load(std::memory_order_relaxed);
        const std::size_t count = std::min(items.size(), room());
        const std::size_t at = place_of(begin), first = std::min(count, items_.size() - at);
        std::copy_n(items.begin(), first, items_.begin() + std::ptrdiff_t(at));
        std::copy_n(items.begin() + std::ptrdiff_t(first), count - first, items_.begin());
        put_.store(begin + count, std::memory_order_release);
        return count;
    }
    // Items for which there is room at least.
    std::size_t room() const noexcept {
        return items_.size() - std::size_t(put_.load(std::memory_order_relaxed) -
                                           taken_.load(std::memory_order_acquire));
    }

    // From the thread that takes. Fills the beginning of `out`, in the order in which the items
    // were put, and returns their number.
    std::size_t take(std::span<T> out) noexcept {
        const std::uint64_t begin = taken_.load(std::memory_order_relaxed);
        const std::size_t here = std::size_t(put_.load(std::memory_order_acquire) - begin);
        const std::size_t count = std::min(out.size(), here);
        const std::size_t at = place_of(begin), first = std::min(count, items_.size() - at);
        std::copy_n(items_.begin() + std::ptrdiff_t(at), first, out.begin());
        std::copy_n(items_.begin(), count - first, out.begin() + std::ptrdiff_t(first));
        taken_.store(begin + count, std::memory_order_release);
        return count;
    }

private:
    std::size_t place_of(std::uint64_t number) const noexcept {
        return std::size_t(number % items_.size());
    }

    static constexpr std::size_t cache_line = 64;
    std::vector<T> items_;
    // Numbers of items since the beginning, each written by one of the threads.
    alignas(cache_line) std::atomic<std::uint64_t> put_{0};
    alignas(cache_line) std::atomic<std::uint64_t> taken_{0};
};

}  // namespace theatron
