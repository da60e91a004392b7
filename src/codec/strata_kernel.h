// SPDX-License-Identifier: Apache-2.0
// The inner loops of Strata, on skewed planes (strata_layout.h), for the best
// instructions of this CPU.
//
// The model goes over all steps, predicts each pixel from pixels that both sides
// have, and chooses its context. The encoder's model pass turns pixels into
// tokens; the decoder does the same step by step while it reads tokens.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/strata_layout.h"
#include "codec/strata_tables.h"
#include "codec/strata_tokens.h"

namespace theatron::codec::strata {

// Weights of the linear predictor in 2^-15, for the differences of these pixels
// to the mean of the left and upper one: left, upper left, upper right, two to
// the left, two above, two right of above; in the reference the same place,
// left, above, right, below.
inline constexpr int tap_count = 11;
inline constexpr int intra_taps = 6;
using Weights = std::array<std::int16_t, tap_count>;

// How far a pixel may be off: constant + squared * (depth / 1024)^2, at most
// 2047, and 0 in the region.
struct Tolerance {
    std::uint16_t constant = 0;
    std::uint16_t squared = 0;
    bool lossless() const { return constant == 0 && squared == 0; }
};

// What the model of both sides takes. Planes start plane_margin steps before
// step 0. Of `valid`, bit plane_origin + k is lane k's.
struct Model {
    Layout layout;
    const std::uint16_t* reference_depth = nullptr;  // null: an intra frame
    const std::uint64_t* reference_valid = nullptr;
    std::uint16_t* depth = nullptr;  // receives the depth with holes filled
    std::uint64_t* valid = nullptr;  // receives where depth was measured
    Weights weights{};
    bool blend = false;  // choose among predictors by their errors nearby
    Tolerance tolerance;
    const std::uint8_t* region = nullptr;  // by step and lane: 255 where exact; if lossy
};

// How often each token occurs in each context; the sum of the tables counts.
struct TokenCounts {
    std::array<Counts, 4> of;
};

// What the model pass makes of the pixels. One value per step and lane, without
// margins, but has_extra, which is by step. `token` may be where the pixels are.
struct CodedPixels {
    std::uint16_t* token = nullptr;     // context * token_count + token
    std::uint16_t* extra = nullptr;     // only where a token has further bits
    std::uint8_t* has_extra = nullptr;  // 1 if any lane's token has further bits
    TokenCounts* counts = nullptr;      // is added to
};

// The model pass of the encoder. `pixels` holds the depth by step and lane, 0 outside
// the image.
void encode_model(const Model& model, const std::uint16_t* pixels, const CodedPixels& coded);

// Where the encoder's words go, and the states that the decoder starts from.
struct Stream {
    std::uint16_t* words = nullptr;
    std::size_t word_count = 0;
    std::array<std::uint32_t, lane_count> states{};
};

// Most words that encode_tokens can write, and slack for whole vectors.
inline std::size_t max_words(const Layout& layout) {
    return 2 * layout.coded_values() + 2 * lane_count;
}
inline constexpr std::size_t word_slack = 2 * lane_count;  // readable after and before the words

void encode_tokens(const Layout& layout, const CodedPixels& coded, const Frequencies& frequencies,
                   Stream& stream);

// Decodes all steps. `pixels` receives the depth by step and lane. False if the
// stream is not one that encode_tokens could have written.
bool decode_steps(const Model& model, const SlotTable& slots, const Stream& stream,
                  std::uint16_t* pixels);

// Rows to steps, 0 outside the image, and back, through a table if there is one.
void rows_to_steps(const Layout& layout, DepthView depth, std::uint16_t* pixels);
void steps_to_rows(const Layout& layout, const std::uint16_t* pixels, const std::uint16_t* depths,
                   MutableDepthView out);

// Rows to steps through a table of the rank of each depth. Depths without one have no_rank;
// they are found, once, and marked in the table. Found are also the bands of 8 rows in
// which no_rank or 65535 occurs. With `bands` only those are done, and nothing is found.
inline constexpr std::uint16_t no_rank = 0x7fff;
struct NewDepths {
    std::vector<std::uint16_t> depths;
    std::vector<int> bands;           // their first rows
    std::vector<std::uint16_t> band;  // scratch memory
};
void rows_to_ranks(const Layout& layout, DepthView depth, const std::vector<int>* bands,
                   std::uint16_t* ranks, std::uint16_t* pixels, NewDepths& found);

// Sums for the linear predictor's normal equations over a sample of the pixels:
// the upper triangle of taps by taps, then taps by target.
inline constexpr int equation_count = tap_count * (tap_count + 1) / 2 + tap_count;
using Equations = std::array<double, equation_count>;
void sample_equations(const Model& model, const std::uint16_t* pixels, int limit,
                      Equations& equations);

// Adds to each number how many of the bounds it reaches. `to` may be `from`.
void shift_ranks(const std::uint16_t* from, std::size_t count, const std::uint16_t* bounds,
                 std::size_t bound_count, std::uint16_t* to);

}  // namespace theatron::codec::strata
