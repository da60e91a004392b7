// SPDX-License-Identifier: Apache-2.0
// Input of the fast JPEG decoder's kernels: tables and memory for one picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "image/view.h"
#include "video/jpeg_baseline.h"
#include "video/jpeg_lookup.h"
#include "video/jpeg_zigzag.h"

namespace theatron::video::jpeg_scan {

// Four blocks side by side, transposed each: the u-th row holds column u of all
// four. Vectors of 128, 256 and 512 bits take one, two or four blocks of a row.
inline constexpr int quad_blocks = 4;
inline constexpr int quad_row = quad_blocks * 8;
inline constexpr int quad_values = 8 * quad_row;

// Where the k-th coefficient belongs in a quad, and in a block alone.
inline constexpr std::size_t place(std::size_t k, std::size_t row) {
    return jpeg_zigzag[k] % 8 * row + jpeg_zigzag[k] / 8;
}

// Units are decoded in groups of four: whole quads of each component.
inline constexpr int group_units = quad_blocks;
inline constexpr int max_unit_blocks = 6;
inline constexpr int max_group_quads = max_unit_blocks;

// One row of units in one component, and above it the last sample row of the row
// of units before. Rows begin at a multiple of `alignment`; `margin` samples
// before and after each may be read.
inline constexpr int alignment = 64;
inline constexpr int margin = 64;
struct Strip {
    std::uint8_t* first = nullptr;  // sample of the new rows
    std::ptrdiff_t stride = 0;
    std::uint8_t* row(int y) const { return first + y * stride; }  // from -1
};

struct Component {
    // The scaled steps as a block of a quad has its coefficients.
    alignas(16) std::array<std::int16_t, 64> powers, rests;
    std::uint8_t dc_step = 0;
    std::size_t lookup = 0;  // number of its tables in JpegLookup
    const JpegComponent* codes = nullptr;
    Strip strip;
};

// Readable bytes after the last coded byte.
inline constexpr std::size_t slack = 32;

struct Scan {
    const BaselineJpeg* jpeg = nullptr;
    const JpegLookup* lookup = nullptr;
    std::array<Component, 3> components;
    // Holds one restart interval without its stuffed zeros: as many bytes as there
    // are coded ones, `slack`, and a vector.
    std::uint8_t* bits = nullptr;
    // max_group_quads quads, aligned.
    std::int16_t* coefficients = nullptr;
    // For each chroma component one row of column sums, with a margin.
    std::array<std::int16_t*, 2> sums{};
    MutableColorView out;
};

// Decodes the picture with the best instructions of this processor. Unsupported
// where it has no vectors.
Status decode(const Scan& scan);

}  // namespace theatron::video::jpeg_scan
