// SPDX-License-Identifier: Apache-2.0
// The chain as a sequence of launches; each applies one function to all pixels in parallel.
//
// CUDA runs them on the GPU (cuda_chain.cu). The tests run the same functions in a plain
// loop (HostLauncher) and compare every pixel with the chain of chain.h. The decisions per
// pixel are the functions of the reference.
#pragma once

#include <algorithm>
#include <cstdint>

#include "filter/stage_rules.h"

namespace theatron::filter {

// An image in the launcher's memory with a margin of one pixel, which is always 0.
struct ParallelImage {
    std::uint16_t* pixels = nullptr;  // the first pixel of the image itself
    int width = 0, height = 0;
    int pitch = 0;

    THEATRON_HD std::uint16_t* at(int x, int y) const { return pixels + y * pitch + x; }
};

// Flags of the pixels and of a margin of `reach` pixels on each side.
struct ParallelFlags {
    std::uint8_t* flags = nullptr;
    int width = 0, height = 0;
    static constexpr int reach = 32;

    THEATRON_HD int pitch() const { return width + 2 * reach; }
    THEATRON_HD std::uint8_t& at(int x, int y) const {
        return flags[(y + reach) * pitch() + x + reach];
    }
    THEATRON_HD bool holds(int x, int y) const {
        return x >= -reach && y >= -reach && x < width + reach && y < height + reach;
    }
};

namespace parallel {

struct Limit {
    ParallelImage in, out, furthest;
    int nearest;
    THEATRON_HD void operator()(int x, int y) const {
        const int depth = *in.at(x, y);
        *out.at(x, y) = depth >= nearest && depth < *furthest.at(x, y) ? std::uint16_t(depth) : 0;
    }
};

struct FlyingPixel {
    ParallelImage in, out;
    FlyingPixelRule rule;
    THEATRON_HD void operator()(int x, int y) const {
        *out.at(x, y) = supported_or_none(in.at(x, y), in.pitch, rule);
    }
};

struct KalmanPixelStep {
    ParallelImage in, depth, estimate, gain;
    KalmanRule rule;
    int boost;
    THEATRON_HD void operator()(int x, int y) const {
        const KalmanPixel before{*depth.at(x, y), *estimate.at(x, y), *gain.at(x, y)};
        const KalmanPixel after = kalman_step(before, *in.at(x, y), rule, boost);
        *depth.at(x, y) = after.depth;
        *estimate.at(x, y) = after.estimate;
        *gain.at(x, y) = after.gain;
    }
};

// One pixel of `moves` for each block.
struct SteadyBlock {
    ParallelImage in, depth, moves;
    SteadyRule rule;
    THEATRON_HD void operator()(int x, int y) const {
        const int left = x * steady_block, top = y * steady_block;
        *moves.at(x, y) = steady_block_moves(depth.at(left, top), depth.pitch, in.at(left, top),
                                             in.pitch, smaller(steady_block, in.width - left),
                                             smaller(steady_block, in.height - top), rule);
    }
};

struct SteadyPixelStep {
    ParallelImage in, depth, run, moves;
    SteadyRule rule;
    int missed;
    THEATRON_HD void operator()(int x, int y) const {
        const SteadyPixel before{*depth.at(x, y), *run.at(x, y)};
        const bool block_moves = *moves.at(x / steady_block, y / steady_block) != 0;
        const SteadyPixel after = steady_step(before, *in.at(x, y), rule, missed, block_moves);
        *depth.at(x, y) = after.depth;
        *run.at(x, y) = after.run;
    }
};

struct Copy {
    ParallelImage from, to;
    THEATRON_HD void operator()(int x, int y) const { *to.at(x, y) = *from.at(x, y); }
};

// Holes. The flags include the margins, where nothing is measured.
struct FindHoles {
    ParallelImage depth;
    ParallelFlags hole;
    THEATRON_HD void operator()(int x, int y) const {
        const bool inside = x >= 0 && y >= 0 && x < depth.width && y < depth.height;
        hole.at(x, y) = !inside || *depth.at(x, y) == none;
    }
};

// out = all (or any) of `side` flags in a row or column that begins (or ends) at the pixel.
struct Window {
    ParallelFlags in, out;
    int side, dx, dy;
    bool all;  // true: erosion, window ahead; false: dilation, window behind
    THEATRON_HD void operator()(int x, int y) const {
        bool result = all;
        for (int i = 0; i < side; ++i) {
            const int u = all ? x + i * dx : x - i * dx, v = all ? y + i * dy : y - i * dy;
            // Flags beyond the margin equal those at its rim.
            const bool flag = in.holds(u, v) ? in.at(u, v) != 0 : all;
            result = all ? result && flag : result || flag;
        }
        out.at(x, y) = result;
    }
};

struct MayFill {
    ParallelFlags hole, large, may_fill;
    THEATRON_HD void operator()(int x, int y) const {
        may_fill.at(x, y) = hole.at(x, y) && !large.at(x, y);
    }
};

struct FillRing {
    ParallelImage in, out;
    ParallelFlags may_fill;
    HoleRule rule;
    THEATRON_HD void operator()(int x, int y) const {
        const std::uint16_t* pixel = in.at(x, y);
        std::uint16_t depth = *pixel;
        if (may_fill.at(x, y) && depth == none) {
            const HoleRim rim = rim_of(pixel, in.pitch, rule.tolerance);
            if (rim.count >= rule.min_neighbours && !rim.edge)
                depth = std::uint16_t(rim.median);
        }
        *out.at(x, y) = depth;
    }
};

struct MarkEdge {
    ParallelImage depth;
    ParallelFlags may_fill, edge;
    Tolerance tolerance;
    THEATRON_HD void operator()(int x, int y) const {
        edge.at(x, y) = may_fill.at(x, y) && rim_of(depth.at(x, y), depth.pitch, tolerance).edge;
    }
};

struct SpreadEdge {
    ParallelFlags in, out, may_fill;
    THEATRON_HD void operator()(int x, int y) const {
        bool near_edge = false;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const int u = x + dx, v = y + dy;
                const bool inside = u >= 0 && v >= 0 && u < in.width && v < in.height;
                near_edge = near_edge || (inside && in.at(u, v));
            }
        out.at(x, y) = near_edge && may_fill.at(x, y);
    }
};

struct EmptyAtEdge {
    ParallelImage depth;
    ParallelFlags edge;
    THEATRON_HD void operator()(int x, int y) const {
        if (edge.at(x, y))
            *depth.at(x, y) = none;
    }
};

// Speckles: each pixel refers to an earlier one of its component, the root to itself.
THEATRON_HD inline int root_of(const int* parent, int i) {
    while (parent[i] != i)
        i = parent[i];
    return i;
}

template <class Atomics>
struct JoinNeighbours {
    ParallelImage depth;
    int* parent;
    Tolerance tolerance;
    THEATRON_HD void operator()(int x, int y) const {
        if (x > 0 && hang_together(*depth.at(x, y), *depth.at(x - 1, y), tolerance))
            join(y * depth.width + x, y * depth.width + x - 1);
        if (y > 0 && hang_together(*depth.at(x, y), *depth.at(x, y - 1), tolerance))
            join(y * depth.width + x, (y - 1) * depth.width + x);
    }
    THEATRON_HD void join(int a, int b) const {
        // Other threads join at the same time, so a root may lose its status.
        while (true) {
            a = root_of(parent, a);
            b = root_of(parent, b);
            if (a == b)
                return;
            const int first = smaller(a, b), second = larger(a, b);
            const int was = Atomics::min(parent + second, first);
            if (was == second)
                return;
            a = was;
            b = first;
        }
    }
};

struct BeginIslands {
    int *parent, *pixels;
    int width;
    THEATRON_HD void operator()(int x, int y) const {
        parent[y * width + x] = y * width + x;
        pixels[y * width + x] = 0;
    }
};

template <class Atomics>
struct CountIslands {
    int *parent, *pixels;
    int width;
    THEATRON_HD void operator()(int x, int y) const {
        Atomics::add(pixels + root_of(parent, y * width + x), 1);
    }
};

struct RemoveIslands {
    ParallelImage depth;
    const int *parent, *pixels;
    int max_pixels;
    THEATRON_HD void operator()(int x, int y) const {
        if (pixels[root_of(parent, y * depth.width + x)] <= max_pixels)
            *depth.at(x, y) = none;
    }
};

}  // namespace parallel

// Runs a chain with a launcher, which owns the memory of its device and provides:
//   T* allocate<T>(count): zeroed memory for the launcher's lifetime; null if exhausted
//   launch(left, top, right, bottom, body): calls body(x, y) for all pixels; in order
//   clear(pointer, count), upload/download(view, ParallelImage), Atomics
template <class Launcher>
class ParallelChain {
public:
    ParallelChain(const ChainSettings& settings, const ChainCamera& camera, Launcher& launcher)
        : settings_(settings), camera_(camera), launcher_(launcher) {
        camera_.background = nullptr;
        current_ = make_image();
        next_ = make_image();
        for (const Step& step : settings_.steps) {
            Memory memory;
            if (std::holds_alternative<RangeParams>(step) ||
                std::holds_alternative<BackgroundParams>(step)) {
                Limits limits(camera.size);
                if (const auto* range = std::get_if<RangeParams>(&step))
                    narrow(limits, *range, camera);
                else
                    narrow(limits, std::get<BackgroundParams>(step), camera);
                memory.nearest = limits.nearest;
                memory.images[0] = make_image();
                launcher_.upload(limits.furthest.view(), memory.images[0]);
            } else if (std::holds_alternative<KalmanParams>(step) ||
                       std::holds_alternative<SteadyParams>(step)) {
                for (ParallelImage& image : memory.images)
                    image = make_image();
            } else if (std::holds_alternative<HoleParams>(step)) {
                for (ParallelFlags& flags : memory.flags)
                    flags = make_flags();
            } else if (std::holds_alternative<SpeckleParams>(step)) {
                memory.parent = launcher_.template allocate<int>(camera.size.area());
                memory.pixels = launcher_.template allocate<int>(camera.size.area());
            }
            memories_.push_back(memory);
        }
    }

    // As Chain::apply; `forgets` and `missed` are computed from the time between frames.
    void apply(DepthView in, MutableDepthView out, bool forgets, int missed) {
        launcher_.upload(in, current_);
        for (std::size_t i = 0; i < settings_.steps.size(); ++i)
            std::visit([&](const auto& params) { run(params, memories_[i], forgets, missed); },
                       settings_.steps[i]);
        launcher_.download(current_, out);
    }

private:
    struct Memory {
        int nearest = 1;
        ParallelImage images[3];
        ParallelFlags flags[4];
        int *parent = nullptr, *pixels = nullptr;
    };

    ParallelImage make_image() {
        const int pitch = (camera_.size.width + 2 + 31) / 32 * 32;
        std::uint16_t* memory = launcher_.template allocate<std::uint16_t>(
            std::size_t(pitch) * std::size_t(camera_.size.height + 2) + 2);
        return {memory + pitch + 1, camera_.size.width, camera_.size.height, pitch};
    }
    ParallelFlags make_flags() {
        ParallelFlags flags{nullptr, camera_.size.width, camera_.size.height};
        flags.flags = launcher_.template allocate<std::uint8_t>(
            std::size_t(flags.pitch()) *
            std::size_t(camera_.size.height + 2 * ParallelFlags::reach));
        return flags;
    }
    template <class Body>
    void launch(const Body& body) {
        launcher_.launch(0, 0, camera_.size.width, camera_.size.height, body);
    }
    template <class Body>
    void launch_with_margin(const Body& body) {
        constexpr int reach = ParallelFlags::reach;
        launcher_.launch(-reach, -reach, camera_.size.width + reach, camera_.size.height + reach,
                         body);
    }

    void run(const RangeParams&, Memory& memory, bool, int) { limit(memory); }
    void run(const BackgroundParams&, Memory& memory, bool, int) { limit(memory); }
    void limit(Memory& memory) {
        launch(parallel::Limit{current_, current_, memory.images[0], memory.nearest});
    }
    void run(const FlyingPixelParams& params, Memory&, bool, int) {
        launch(parallel::FlyingPixel{current_, next_, rule_of(params, camera_)});
        std::swap(current_, next_);
    }
    void run(const KalmanParams& params, Memory& memory, bool forgets, int missed) {
        const KalmanRule rule = rule_of(params, camera_);
        if (forgets)
            clear(memory);
        launch(parallel::KalmanPixelStep{current_, memory.images[0], memory.images[1],
                                         memory.images[2], rule, missed * rule.least_gain});
        launch(parallel::Copy{memory.images[0], current_});
    }
    void run(const SteadyParams& params, Memory& memory, bool forgets, int missed) {
        const SteadyRule rule = rule_of(params, camera_);
        const auto& [depth, state, moves] = memory.images;
        if (forgets)
            clear(memory);
        const auto blocks = [](int side) { return (side + steady_block - 1) / steady_block; };
        launcher_.launch(0, 0, blocks(camera_.size.width), blocks(camera_.size.height),
                         parallel::SteadyBlock{current_, depth, moves, rule});
        launch(parallel::SteadyPixelStep{current_, depth, state, moves, rule, missed});
        launch(parallel::Copy{depth, current_});
    }
    void clear(const Memory& memory) {
        for (const ParallelImage& image : memory.images)
            launcher_.clear(image.pixels - image.pitch - 1,
                            std::size_t(image.pitch) * std::size_t(image.height + 2));
    }
    void run(const HoleParams& params, Memory& memory, bool, int) {
        const HoleRule rule = rule_of(params, camera_);
        const auto& [hole, may_fill, a, b] = memory.flags;
        const int side = rule.max_size + 1;
        launch_with_margin(parallel::FindHoles{current_, hole});
        launch_with_margin(parallel::Window{hole, a, side, 1, 0, true});
        launch_with_margin(parallel::Window{a, b, side, 0, 1, true});
        launch_with_margin(parallel::Window{b, a, side, 1, 0, false});
        launch_with_margin(parallel::Window{a, b, side, 0, 1, false});
        launch(parallel::MayFill{hole, b, may_fill});
        for (int i = 0; i < rule.iterations; ++i) {
            launch(parallel::FillRing{current_, next_, may_fill, rule});
            std::swap(current_, next_);
        }
        launch(parallel::MarkEdge{current_, may_fill, a, rule.tolerance});
        ParallelFlags edge = a, spread = b;
        for (int i = 0; i < rule.iterations; ++i) {
            launch(parallel::SpreadEdge{edge, spread, may_fill});
            std::swap(edge, spread);
        }
        launch(parallel::EmptyAtEdge{current_, edge});
    }
    void run(const SpeckleParams& params, Memory& memory, bool, int) {
        using Atomics = typename Launcher::Atomics;
        const SpeckleRule rule = rule_of(params, camera_);
        const int width = camera_.size.width;
        launch(parallel::BeginIslands{memory.parent, memory.pixels, width});
        launch(parallel::JoinNeighbours<Atomics>{current_, memory.parent, rule.tolerance});
        launch(parallel::CountIslands<Atomics>{memory.parent, memory.pixels, width});
        launch(parallel::RemoveIslands{current_, memory.parent, memory.pixels, rule.max_pixels});
    }

    ChainSettings settings_;
    ChainCamera camera_;
    Launcher& launcher_;
    std::vector<Memory> memories_;
    ParallelImage current_, next_;
};

}  // namespace theatron::filter
