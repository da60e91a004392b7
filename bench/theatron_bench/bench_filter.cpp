// SPDX-License-Identifier: Apache-2.0
#include "bench_filter.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/statistics.h"
#include "bench_coder.h"
#include "bench_filter_yardstick.h"
#include "cli/instruction_set.h"
#include "filter/chain.h"
#include "filter/stage_rules.h"

namespace theatron::bench {
namespace {

using filter::DepthPlane;

template <class Work>
double elapsed_ms(Work work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

// The minimum time of each frame over several passes; the result is their median.
class FrameTimes {
public:
    explicit FrameTimes(std::size_t frames) : best_(frames, std::numeric_limits<double>::max()) {}
    void add(std::size_t frame, double ms) { best_[frame] = std::min(best_[frame], ms); }
    double ms() const { return median(best_); }

private:
    std::vector<double> best_;
};

void require_equal(const DepthPlane& a, const DepthPlane& b, const std::string& name) {
    for (int y = 0; y < a.size().height; ++y)
        if (std::memcmp(a.row(y), b.row(y), 2 * std::size_t(a.size().width)) != 0)
            throw Error("The filter " + name + " does not equal its reference.");
}

// A common interface of the filters. Both functions read `in`. They write `out`, which equals
// `in` beforehand for filters that work in place, or a plane stored in the filter.
struct StageBench {
    std::string name;
    bool in_place = false;
    std::function<void(DepthPlane&in, DepthPlane&out)> simd, reference;
    const DepthPlane *kept = nullptr, *kept_by_reference = nullptr;
};

StageBench bench_of(const filter::FlyingPixelParams& params, const filter::ChainCamera& camera) {
    const auto rule = filter::rule_of(params, camera);
    return {
        "flying_pixels", false,
        [=](DepthPlane& in, DepthPlane& out) { remove_flying_pixels(in, rule, out); },
        [=](DepthPlane& in, DepthPlane& out) { remove_flying_pixels_reference(in, rule, out); }};
}

StageBench bench_of(const filter::SpeckleParams& params, const filter::ChainCamera& camera) {
    const auto rule = filter::rule_of(params, camera);
    const auto scratch = std::make_shared<filter::SpeckleScratch>(camera.size);
    return {"speckles", true,
            [=](DepthPlane&, DepthPlane& out) { remove_speckles(out, rule, *scratch); },
            [=](DepthPlane&, DepthPlane& out) { remove_speckles_reference(out, rule); }};
}

StageBench bench_of(const filter::HoleParams& params, const filter::ChainCamera& camera) {
    const auto rule = filter::rule_of(params, camera);
    const auto scratch = std::make_shared<filter::HoleScratch>(camera.size);
    return {"holes", true, [=](DepthPlane&, DepthPlane& out) { fill_holes(out, rule, *scratch); },
            [=](DepthPlane&, DepthPlane& out) { fill_holes_reference(out, rule); }};
}

StageBench bench_of(const filter::KalmanParams& params, const filter::ChainCamera& camera) {
    const auto rule = filter::rule_of(params, camera);
    const auto state = std::make_shared<filter::KalmanState>(camera.size);
    const auto reference_state = std::make_shared<filter::KalmanState>(camera.size);
    return {
        "kalman",
        false,
        [=](DepthPlane& in, DepthPlane&) { apply_kalman(in, rule, 0, *state); },
        [=](DepthPlane& in, DepthPlane&) { apply_kalman_reference(in, rule, 0, *reference_state); },
        &state->depth,
        &reference_state->depth};
}

StageBench bench_of(const filter::SteadyParams& params, const filter::ChainCamera& camera) {
    const auto rule = filter::rule_of(params, camera);
    const auto state = std::make_shared<filter::SteadyState>(camera.size);
    const auto reference_state = std::make_shared<filter::SteadyState>(camera.size);
    return {
        "steady",
        false,
        [=](DepthPlane& in, DepthPlane&) { apply_steady(in, rule, 0, *state); },
        [=](DepthPlane& in, DepthPlane&) { apply_steady_reference(in, rule, 0, *reference_state); },
        &state->depth,
        &reference_state->depth};
}

template <class Params>
StageBench limits_bench(const char* name, const Params& params, const filter::ChainCamera& camera) {
    const auto limits = std::make_shared<filter::Limits>(camera.size);
    narrow(*limits, params, camera);
    return {
        name, false,
        [=](DepthPlane& in, DepthPlane& out) { apply_limits(in.view(), *limits, out); },
        [=](DepthPlane& in, DepthPlane& out) { apply_limits_reference(in.view(), *limits, out); }};
}

StageBench bench_of(const filter::RangeParams& params, const filter::ChainCamera& camera) {
    return limits_bench("range", params, camera);
}
StageBench bench_of(const filter::BackgroundParams& params, const filter::ChainCamera& camera) {
    return limits_bench("background", params, camera);
}

struct Times {
    double simd = 0, reference = 0;
};

// Times a stage and checks its pixels. `frames` are replaced by its results.
Times time_stage(const StageBench& bench, std::vector<DepthPlane>& frames, FilterCompany company) {
    // A static picture is repeated until filters with memory are stationary, and only then
    // timed. (Without memory, in the first frame, a reference is fastest.)
    const bool still = frames.size() == 1;
    const int settling = still ? 25 : 0;
    const int passes = still ? 75 : 15;
    const int reference_passes = company == FilterCompany::nothing ? 0
                                 : company == FilterCompany::check ? 1
                                 : still                           ? passes
                                                                   : 2;
    FrameTimes simd(frames.size()), reference(frames.size());
    DepthPlane out(frames.front().size()), expected = out;
    const auto timed = [&](const auto& run, DepthPlane& in, DepthPlane& result) {
        if (bench.in_place)
            result = in;
        return elapsed_ms([&] { run(in, result); });
    };
    for (int pass = 0; pass < passes; ++pass)
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const double ms = timed(bench.simd, frames[i], out);
            if (pass >= settling)
                simd.add(i, ms);
            if (pass >= reference_passes)
                continue;
            const double reference_ms = timed(bench.reference, frames[i], expected);
            if (pass >= settling)
                reference.add(i, reference_ms);
            require_equal(bench.kept ? *bench.kept : out,
                          bench.kept ? *bench.kept_by_reference : expected, bench.name);
        }
    for (DepthPlane& frame : frames) {
        timed(bench.simd, frame, out);
        frame = bench.kept ? *bench.kept : out;
    }
    return {simd.ms(), reference.ms()};
}

// The time of a chain, and with everything that of zstd level 1 on the same frames, in turns.
struct ChainTimes {
    double ms = 0, zstd1_ms = 0;
};

ChainTimes time_chain(const filter::ChainSettings& settings, const filter::ChainCamera& camera,
                      const std::vector<DepthImage>& frames, FilterCompany company) {
    filter::Chain chain(settings, camera);
    const std::unique_ptr<BenchCoder> zstd = zstd_yardstick();
    Bytes encoded;
    FrameTimes times(frames.size()), zstd_times(frames.size());
    for (int pass = 0; pass < (frames.size() == 1 ? 75 : 25); ++pass) {
        for (std::size_t i = 0; company == FilterCompany::everything && i < frames.size(); ++i)
            zstd_times.add(i, elapsed_ms([&] { (void)zstd->encode(frames[i], encoded); }));
        for (std::size_t i = 0; i < frames.size(); ++i)
            times.add(i, elapsed_ms([&] {
                          chain.apply(frames[i].view(), std::chrono::milliseconds(33));
                      }));
    }
    return {times.ms(), zstd_times.ms()};
}

// The time of one ring of hole filling when every vector has pixels to fill in each ring:
// stripes of eight pixels. The difference of two runs removes the constant part.
double time_hole_iteration(const filter::ChainCamera& camera) {
    DepthPlane stripes(camera.size), out = stripes;
    for (int y = 0; y < camera.size.height; ++y)
        for (int x = 0; x < camera.size.width; ++x)
            stripes.row(y)[x] = x / 8 % 2 == 0 ? std::uint16_t(2000 + (x ^ y) % 8) : 0;
    filter::HoleScratch scratch(camera.size);
    const auto fastest = [&](int iterations) {
        const filter::HoleRule rule{iterations, 8, 3, {100, 0}};
        FrameTimes time(1);
        for (int pass = 0; pass < 40; ++pass) {
            out = stripes;
            time.add(0, elapsed_ms([&] { fill_holes(out, rule, scratch); }));
        }
        return time.ms();
    };
    return (fastest(4) - fastest(1)) / 3;
}

}  // namespace

nlohmann::json bench_filter(const std::vector<DepthImage>& frames,
                            const std::vector<std::string>& names, FilterCompany company) {
    const bool everything = company == FilterCompany::everything;
    const filter::ChainCamera camera{.size = frames.front().size};
    nlohmann::json stages = nlohmann::json::array(), chains = nlohmann::json::array();
    const auto add_stage = [&](const std::string& name, const std::string& variant, double ms) {
        stages.push_back({{"name", name}, {"variant", variant}, {"ms", ms}});
    };

    for (const std::string& preset : names) {
        const filter::ChainSettings settings = filter::parse_chain(preset).settings;
        std::vector<DepthPlane> planes;
        for (const DepthImage& frame : frames) {
            planes.emplace_back(frame.size);
            copy_pixels(frame.view(), planes.back().view());
        }
        double reference = 0;
        for (const filter::Step& step : settings.steps) {
            const StageBench bench =
                std::visit([&](const auto& params) { return bench_of(params, camera); }, step);
            const Times times = time_stage(bench, planes, company);
            reference += times.reference;
            add_stage(preset + "/" + bench.name, "simd", times.simd);
            if (everything)
                add_stage(preset + "/" + bench.name, "reference", times.reference);
        }
        const ChainTimes times = time_chain(settings, camera, frames, company);
        chains.push_back({{"variant", preset}, {"ms", times.ms}});
        if (!everything)
            continue;
        chains.back()["zstd1_ms"] = times.zstd1_ms;
        chains.back()["of_zstd1"] = times.ms / times.zstd1_ms;
        chains.push_back({{"variant", preset + "/reference"}, {"ms", reference}});
    }

    if (everything) {
        add_stage("hole_iteration_everywhere", "simd", time_hole_iteration(camera));
        if (const auto opencv = opencv_median_ms(frames.front()))
            add_stage("median3_without_validity", "opencv", *opencv);
    }
    return {{"width", camera.size.width},
            {"height", camera.size.height},
            {"target", cli::instruction_set_in_use()},
            {"stages", stages},
            {"chain", chains}};
}

}  // namespace theatron::bench
