// SPDX-License-Identifier: Apache-2.0
// Makes standard levels of Strata (docs/formats/depth_strata.md) from sequences, and
// measures the size of a sequence's first frame with each table of levels.
//
//   strata_levels make FOLDER...              prints a table like the page's
//   strata_levels measure TABLE... -- FOLDER...  bytes of each first frame, for each table,
//                                        but for header, weights and states
//
// FOLDER holds depth/*.png, 16 bits. TABLE is a file as `make` prints it, `standard` for the
// program's table, or `none` for levels of 0. At most 30 frames of a folder are taken, each as
// an intra frame and, except the first, as a delta frame. The levels of a context are
// those of the tokens' mean share of the context's pixels; each sequence counts the same.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "codec/strata_kernel.h"
#include "codec/strata_tables.h"
#include "codec/strata_values.h"
#include "codec/strata_weights.h"
#include "files/png_file.h"

namespace theatron::codec::strata {
namespace {

constexpr std::size_t most_frames = 30;

[[noreturn]] void fail(const std::string& sentence) {
    std::fprintf(stderr, "strata_levels: %s\n", sentence.c_str());
    std::exit(1);
}

std::vector<DepthImage> frames_of(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder / "depth"))
        fail("there is no folder " + (folder / "depth").string() + ".");
    std::vector<std::filesystem::path> pictures;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "depth"))
        pictures.push_back(entry.path());
    std::sort(pictures.begin(), pictures.end());
    pictures.resize(std::min(pictures.size(), most_frames));
    std::vector<DepthImage> frames;
    for (const auto& picture : pictures)
        frames.push_back(files::read_depth_png(picture));
    if (frames.empty())
        fail("there are no pictures in " + (folder / "depth").string() + ".");
    return frames;
}

// The model pass of one frame and of the one that refers to it, without a codec around.
class Frames {
public:
    // The tokens of the next frame, as an intra frame or against the one before.
    Counts tokens(const DepthImage& image, bool delta) {
        const Layout layout = layout_of(image.size);
        Plane now{AlignedPlane(layout.plane_values()),
                  std::vector<std::uint64_t>(layout.plane_steps()),
                  {}};
        std::vector<std::uint16_t> pixels(layout.coded_values()), extra(layout.coded_values());
        std::vector<std::uint8_t> has_extra(std::size_t(layout.steps));
        now.values = delta ? last_.values : find_values(image.view(), {});
        const Values old = now.values;
        if (now.values.empty() ||
            !tables_.to_ranks(layout, image.view(), now.values, pixels.data()))
            rows_to_steps(layout, image.view(), pixels.data());
        Model model;
        model.layout = layout;
        model.depth = now.depth.data();
        model.valid = now.valid.data();
        model.blend = true;
        if (delta) {
            if (old.size() != now.values.size())
                RankShift(old, now.values)
                    .apply(last_.depth.data(), last_.depth.size(), last_.depth.data());
            model.reference_depth = last_.depth.data();
            model.reference_valid = last_.valid.data();
        }
        Equations equations;
        sample_equations(model, pixels.data(), now.values.empty() ? 40 : 8, equations);
        model.weights = solve(equations, delta ? tap_count : intra_taps);
        TokenCounts counts{};
        encode_model(model, pixels.data(),
                     {pixels.data(), extra.data(), has_extra.data(), &counts});
        Counts sum{};
        for (const Counts& part : counts.of)
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += part[i];
        next_ = std::move(now);
        return sum;
    }
    // The next delta frame refers to the frame of the last call.
    void keep() { std::swap(last_, next_); }

private:
    using AlignedPlane = std::vector<std::uint16_t>;
    struct Plane {
        AlignedPlane depth;
        std::vector<std::uint64_t> valid;
        Values values;
    };
    RankTables tables_;
    Plane last_, next_;
};

// Mean shares of tokens over frames, and the levels nearest to them.
class Mean {
public:
    void add(const Counts& counts, double weight) {
        for (unsigned c = 0; c < coded_contexts; ++c) {
            double total = 0;
            for (unsigned t = 0; t < used_tokens; ++t)
                total += counts[at(c, t)];
            for (unsigned t = 0; t < used_tokens && total > 0; ++t)
                shares_[at(c, t)] += weight * counts[at(c, t)] / total;
        }
    }
    Levels levels() const {
        Counts counts{};
        for (unsigned c = 0; c < coded_contexts; ++c) {
            double most = 0;
            for (unsigned t = 0; t < used_tokens; ++t)
                most = std::max(most, shares_[at(c, t)]);
            for (unsigned t = 0; t < used_tokens && most > 0; ++t)
                counts[at(c, t)] = std::uint32_t(std::ceil(1e8 * shares_[at(c, t)] / most));
        }
        Levels result;
        choose_levels(counts, Levels{}, result);
        return result;
    }

private:
    static std::size_t at(unsigned context, unsigned token) {
        return std::size_t(context) * token_count + token;
    }
    std::vector<double> shares_ = std::vector<double>(std::size_t(context_count) * token_count);
};

void make(const std::vector<std::string>& folders) {
    Mean mean;
    for (const std::string& folder : folders) {
        const std::vector<DepthImage> images = frames_of(folder);
        Frames intra, delta;
        for (std::size_t i = 0; i < images.size(); ++i) {
            // Each sequence counts the same, however long it is.
            const double weight = 1.0 / double(images.size());
            mean.add(intra.tokens(images[i], false), weight);
            const Counts tokens = delta.tokens(images[i], i > 0);
            delta.keep();
            if (i > 0)
                mean.add(tokens, weight);
        }
    }
    for (const auto& context : mean.levels()) {
        for (const std::uint8_t level : context)
            std::putchar(level == 0 ? '.' : 'a' + level - 1);
        std::putchar('\n');
    }
}

Levels read_table(const std::string& name) {
    if (name == "standard")
        return standard_levels();
    Levels levels{};
    if (name == "none")
        return levels;
    std::ifstream file(name);
    std::string line;
    for (auto& context : levels) {
        if (!std::getline(file, line) || line.size() != used_tokens)
            fail(name + " is no table of levels.");
        for (unsigned t = 0; t < used_tokens; ++t)
            context[t] = line[t] == '.' ? std::uint8_t(0) : std::uint8_t(line[t] - 'a' + 1);
    }
    return levels;
}

// Bytes of a frame whose encoder starts from the table: levels and tokens, no constant parts.
double coded_bytes(const Counts& counts, const Levels& table) {
    Levels levels;
    choose_levels(counts, table, levels);
    Bytes buffer;
    SideWriter side(buffer);
    put_levels(levels, table, side);
    side.finish();
    Frequencies frequencies;
    make_frequencies(levels, frequencies);
    double bits = 0;
    for (unsigned c = 0; c < coded_contexts; ++c)
        for (unsigned t = 0; t < used_tokens; ++t) {
            const std::size_t at = std::size_t(c) * token_count + t;
            if (counts[at] > 0)
                bits += counts[at] * (extra_bits(t) + probability_bits -
                                      std::log2(double(frequencies.of[at] & 0xffff)));
        }
    return double(buffer.size()) + bits / 8;
}

void measure(const std::vector<std::string>& tables, const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) {
        const Counts counts = Frames().tokens(frames_of(folder).front(), false);
        std::printf("%-40s", std::filesystem::path(folder).filename().string().c_str());
        for (const std::string& table : tables)
            std::printf("  %s %.0f", table.c_str(), coded_bytes(counts, read_table(table)));
        std::printf("\n");
    }
}

}  // namespace
}  // namespace theatron::codec::strata

int main(int count, char** arguments) {
    using namespace theatron::codec::strata;
    const std::vector<std::string> words(arguments + 1, arguments + count);
    const auto dashes = std::find(words.begin(), words.end(), "--");
    if (words.size() > 1 && words[0] == "make")
        make({words.begin() + 1, words.end()});
    else if (words.size() > 3 && words[0] == "measure" && dashes != words.end())
        measure({words.begin() + 1, dashes}, {dashes + 1, words.end()});
    else
        fail("use: strata_levels make FOLDER..., or strata_levels measure TABLE... -- FOLDER...");
}
