// SPDX-License-Identifier: Apache-2.0
// The inner loops of Strata on skewed planes (strata_layout.h), compiled for every
// instruction set and selected at run time.
//
// The model runs over all steps, predicts each pixel from pixels that both sides
// know, and selects its context. The encoder runs the model over the whole image
// first and gets tokens; the decoder runs it step by step while it reads tokens.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/strata_layout.h"
#include "codec/strata_tables.h"
#include "codec/strata_tokens.h"

namespace theatron::codec::strata {

// Weights of the linear predictor, in units of 2^-15. Each weight multiplies the
// difference between one neighbour (tap) and the mean of left and upper neighbour.
// Order of the taps: left, upper left, upper right, second left, second above, and
// (x + 2, y - 1); then in the reference frame: same place, left, above, right, below.
inline constexpr int tap_count = 11;
inline constexpr int intra_taps = 6;
using Weights = std::array<std::int16_t, tap_count>;

// The largest error allowed per pixel: constant + squared * (depth / 1024)^2, at
// most 2047; 0 inside the region.
struct Tolerance {
    std::uint16_t constant = 0;
    std::uint16_t squared = 0;
    bool lossless() const { return constant == 0 && squared == 0; }
};

// Input and output of the model on either side; pointers are not owned. Planes
// start plane_margin steps before step 0. Bit plane_origin + k of an element of
// `valid` belongs to lane k.
struct Model {
    Layout layout;
    const std::uint16_t* reference_depth = nullptr;  // null: an intra frame
    const std::uint64_t* reference_valid = nullptr;
    std::uint16_t* depth = nullptr;  // written: depth with holes filled
    std::uint64_t* valid = nullptr;  // written: bits of the measured pixels
    Weights weights{};
    bool blend = false;  // choose among predictors by their errors on the neighbours
    Tolerance tolerance;
    const std::uint8_t* region = nullptr;  // by step and lane, 255 = exact; unused if lossless
};

// Occurrences of each token in each context, spread over tables to be summed.
struct TokenCounts {
    std::array<Counts, 8> of;
};

// Output of the encoder's model pass: one value per step and lane, without
// margins; has_extra has one per step. `token` may be the array of the pixels.
struct CodedPixels {
    std::uint16_t* token = nullptr;     // context * token_count + token
    std::uint16_t* extra = nullptr;     // only where a token has further bits
    std::uint8_t* has_extra = nullptr;  // 1 if any lane's token has further bits
    TokenCounts* counts = nullptr;      // incremented
};

// Runs the encoder's model over all steps. `pixels` holds the depth by step and
// lane, 0 outside the image.
void encode_model(const Model& model, const std::uint16_t* pixels, const CodedPixels& coded);

// The entropy coded words, and the states from which the decoder starts.
struct Stream {
    std::uint16_t* words = nullptr;
    std::size_t word_count = 0;
    std::array<std::uint32_t, lane_count> states{};
};

// The largest number of words that encode_tokens writes, whole vectors included.
inline std::size_t max_words(const Layout& layout) {
    return 2 * layout.coded_values() + 2 * lane_count;
}
inline constexpr std::size_t word_slack = 2 * lane_count;  // readable before and after the words

// Entropy codes the tokens into `stream`, whose buffer holds max_words words.
void encode_tokens(const Layout& layout, const CodedPixels& coded, const Frequencies& frequencies,
                   Stream& stream);

// Decodes all steps. `pixels` receives the depth by step and lane. False if
// encode_tokens could not have written the stream.
bool decode_steps(const Model& model, const SlotTable& slots, const Stream& stream,
                  std::uint16_t* pixels);

// Converts rows to step order, 0 outside the image, and back. The way back maps
// each value through `depths` (65536 entries) unless it is null.
void rows_to_steps(const Layout& layout, DepthView depth, std::uint16_t* pixels);
void steps_to_rows(const Layout& layout, const std::uint16_t* pixels, const std::uint16_t* depths,
                   MutableDepthView out);

// Converts rows to step order and maps each depth through `ranks` (65536 entries).
// A depth whose entry is no_rank is appended once to `found.depths` and marked in
// `ranks`; the 8-row bands that contain such a depth or 65535 go to `found.bands`.
// With `bands`, only those bands are converted, and `found` receives nothing.
inline constexpr std::uint16_t no_rank = 0x7fff;
struct NewDepths {
    std::vector<std::uint16_t> depths;
    std::vector<int> bands;           // first row of each
    std::vector<std::uint16_t> band;  // scratch memory
};
void rows_to_ranks(const Layout& layout, DepthView depth, const std::vector<int>* bands,
                   std::uint16_t* ranks, std::uint16_t* pixels, NewDepths& found);

// Accumulates the normal equations of the linear predictor over a sample of the
// pixels: the upper triangle of taps by taps, each row followed by tap times target.
inline constexpr int equation_count = tap_count * (tap_count + 1) / 2 + tap_count;
using Equations = std::array<double, equation_count>;
void sample_equations(const Model& model, const std::uint16_t* pixels, int limit,
                      Equations& equations);

// Adds to each rank the number of bounds that are not above it. `to` may be `from`.
void shift_ranks(const std::uint16_t* from, std::size_t count, const std::uint16_t* bounds,
                 std::size_t bound_count, std::uint16_t* to);

}  // namespace theatron::codec::strata
