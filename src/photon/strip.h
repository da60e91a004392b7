// SPDX-License-Identifier: Apache-2.0
// The strip: a picture of a time, made to be read from a film of a screen.
//
// It shows milliseconds, counted by one clock, as 16 bits: after 65.536 s the values begin again,
// so the difference of two strips is known for ages below 32.768 s only. Neighbouring values differ
// in one cell (Gray code), so that two values a few milliseconds apart never mix into one that is
// far from both; 12 check bits refuse nearly all mixtures.
//
// All coordinates are in cells, x to the right and y down: a white border, one cell wide, around a
// black frame, one cell wide, around 12 x 3 cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/time.h"
#include "image/view.h"

namespace theatron::photon {

inline constexpr int strip_columns = 12, strip_rows = 3;
inline constexpr int strip_width = strip_columns + 4, strip_height = strip_rows + 4;

// Milliseconds of the strip's clock, modulo 65536.
using StripTime = std::uint16_t;
inline constexpr int strip_wrap_ms = 1 << 16;
// Strips show whole milliseconds, rounded down: what is lost by that on average.
inline constexpr double strip_rounding_ms = 0.5;

// Row by row from the top; true is white.
using StripCells = std::array<bool, std::size_t(strip_columns) * strip_rows>;

StripCells cells_of(StripTime time);
// Nullopt if the check bits do not fit or fixed cells have the other colour.
std::optional<StripTime> time_of(const StripCells& cells);

// A strip of which some cells change colour: those of a picture that was taken while the screen
// went from one time to another. `is_changing` says which; of the others `cells` has the colours.
// Nullopt unless exactly one pair of times, at most 100 ms apart, has these cells: each of the
// changing ones differs between the two, and no other. The first is the earlier one.
struct ChangingTimes {
    StripTime earlier, later;
};
std::optional<ChangingTimes> changing_times_of(const StripCells& cells,
                                               const StripCells& is_changing);

// The colour that a cell has in all strips; nullopt where it depends on the time. By these eight
// cells a strip is known, and its direction.
std::optional<bool> fixed_cell(int column, int row);

// True where the strip of these cells is white; a place outside it is.
bool is_white(const StripCells& cells, double x, double y);

// `later` less `earlier`, in milliseconds from -32768 to 32767.
inline int difference_ms(StripTime later, StripTime earlier) {
    return std::int16_t(std::uint16_t(later - earlier));
}

// The time on a strip at this moment of the clock that drives it.
inline StripTime strip_time_at(TimePoint now) {
    return StripTime(std::uint64_t(to_us(now)) / 1000 % strip_wrap_ms);
}

// How long ago, before `now` of the same clock, a strip began to show this time: milliseconds from
// -32769 to 32768.
inline double age_ms(TimePoint now, StripTime time) {
    return difference_ms(strip_time_at(now), time) + double(to_us(now) % 1000) / 1000 -
           strip_rounding_ms;
}

// Fills the picture with the strip. A picture that is `strip_width` to `strip_height` keeps the
// cells square.
void draw_strip(StripTime time, MutableColorView out);

}  // namespace theatron::photon
