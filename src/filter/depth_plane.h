// SPDX-License-Identifier: Apache-2.0
// Depth between two filters, with a margin of "no measurement" around it, so that kernels
// read neighbours and whole vectors without tests for the image's borders.
#pragma once

#include <algorithm>
#include <cstdint>
#include <new>
#include <vector>

#include "image/view.h"

namespace theatron::filter {

// Readable: rows -1 to height, and in each row the pixels -margin to padded_width + margin.
// Everything outside the image is 0.
class DepthPlane {
public:
    static constexpr int margin = 32;  // the longest vector of 16-bit lanes

    static int padded_width_of(Size size) { return (size.width + margin - 1) / margin * margin; }
    // A multiple of 64 pixels: the bit arrays of HoleScratch have the same shape.
    static std::ptrdiff_t pitch_of(Size size) {
        return (padded_width_of(size) + 2 * margin + 63) / 64 * 64;
    }

    explicit DepthPlane(Size size)
        : size_(size),
          padded_width_(padded_width_of(size)),
          pitch_(pitch_of(size)),
          pixels_(std::size_t(pitch_) * std::size_t(size.height + 2)) {}

    Size size() const { return size_; }
    int padded_width() const { return padded_width_; }
    std::ptrdiff_t pitch() const { return pitch_; }

    std::uint16_t* row(int y) { return pixels_.data() + (y + 1) * pitch_ + margin; }
    const std::uint16_t* row(int y) const { return pixels_.data() + (y + 1) * pitch_ + margin; }

    MutableDepthView view() { return {row(0), size_, pitch_}; }
    DepthView view() const { return {row(0), size_, pitch_}; }

    void clear() { std::fill(pixels_.begin(), pixels_.end(), std::uint16_t(0)); }

private:
    // Aligns rows to vectors: a vector that crosses cache lines costs two accesses.
    template <class T>
    struct VectorAllocator {
        using value_type = T;
        static constexpr std::align_val_t alignment{2 * margin};
        VectorAllocator() = default;
        template <class U>
        VectorAllocator(const VectorAllocator<U>&) {}
        T* allocate(std::size_t count) {
            return static_cast<T*>(::operator new(count * sizeof(T), alignment));
        }
        void deallocate(T* values, std::size_t) { ::operator delete(values, alignment); }
        bool operator==(const VectorAllocator&) const { return true; }
    };

    Size size_;
    int padded_width_;
    std::ptrdiff_t pitch_;
    std::vector<std::uint16_t, VectorAllocator<std::uint16_t>> pixels_;
};

}  // namespace theatron::filter
