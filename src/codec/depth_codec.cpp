// SPDX-License-Identifier: Apache-2.0
#include "codec/depth_codec.h"

#include <cassert>

#include "base/options.h"
#include "codec/library_codec.h"
#include "codec/quantise.h"
#include "codec/simple_codecs.h"
#include "codec/strata.h"

namespace theatron::codec {
namespace {

// All parameters of a setting. Each codec reads the ones that it uses.
struct Parameters {
    bool delta = false;
    int level = 1;
    int quant_mm = 1;
    int layers = 1;
    StrataParams strata;
};

// One codec of the family.
struct Kind {
    std::string_view name;
    DepthCodecId id;
    bool in_this_build;
    // Reads the codec's parameters from the options. Returns true if it is temporal.
    bool (*read)(Options& options, Parameters& parameters);
    std::unique_ptr<DepthCodec> (*make)(const Parameters& parameters);
};

bool read_nothing(Options&, Parameters&) {
    return false;
}

bool read_nothing_temporal(Options&, Parameters& parameters) {
    parameters.delta = true;
    return true;
}

bool read_delta(Options& options, Parameters& parameters) {
    return parameters.delta = options.take_flag("delta");
}

bool read_zstd(Options& options, Parameters& parameters) {
    parameters.level = options.take_int("level", 1, 1, 19);
    return read_delta(options, parameters);
}

bool read_lz4(Options& options, Parameters& parameters) {
    parameters.quant_mm = options.take_int("quant_mm", 1, 1, max_quantisation_step);
    return read_delta(options, parameters);
}

bool read_strata(Options& options, Parameters& parameters) {
    parameters.strata.max_error_mm = options.take_int("max_error_mm", 0, 0, 255);
    parameters.strata.noise_scaled = options.take_int("noise_scaled", 0, 0, 15);
    parameters.strata.everywhere = options.take_flag("everywhere");
    return parameters.delta = true;
}

std::unique_ptr<DepthCodec> make_zstd(const Parameters& p) {
    return make_library_codec(
        DepthCodecId::zstd, {make_zstd_compressor(p.level), make_zstd_decompressor()}, p.delta, 1);
}

std::unique_ptr<DepthCodec> make_lz4(const Parameters& p) {
    return make_library_codec(DepthCodecId::lz4, {make_lz4_compressor(), make_lz4_decompressor()},
                              p.delta, p.quant_mm);
}

// In the order of help texts and benchmarks.
const std::vector<Kind>& kinds() {
    using P = const Parameters&;
    static const std::vector<Kind> all = {
        {"raw", DepthCodecId::raw, true, read_nothing, [](P) { return make_raw(); }},
        {"rvl", DepthCodecId::rvl, true, read_nothing, [](P) { return make_rvl(); }},
        {"trvl", DepthCodecId::trvl, true, read_nothing_temporal, [](P) { return make_trvl(); }},
        {"zstd", DepthCodecId::zstd, has_zstd(), read_zstd, make_zstd},
        {"lz4", DepthCodecId::lz4, has_lz4(), read_lz4, make_lz4},
        {"ans", DepthCodecId::ans, true, read_delta, [](P p) { return make_ans(p.delta); }},
        {"strata", DepthCodecId::strata, true, read_strata,
         [](P p) { return make_strata(p.strata); }},
    };
    return all;
}

const Kind* find_kind(std::string_view name) {
    for (const Kind& kind : kinds()) {
        if (kind.name == name)
            return &kind;
    }
    return nullptr;
}

std::string names_in_this_build() {
    std::string names;
    for (const std::string& name : depth_codec_names())
        names += (names.empty() ? "" : ", ") + name;
    return names;
}

// The canonical text of a setting: fixed order, default values omitted.
std::string spelling(const Kind& kind, const Parameters& p) {
    std::string text(kind.name);
    char separator = ':';
    const auto add = [&](const char* key, int value, int standard) {
        if (value == standard)
            return;
        text += separator + std::string(key) + "=" + std::to_string(value);
        separator = ',';
    };
    const bool always_temporal = kind.id == DepthCodecId::trvl || kind.id == DepthCodecId::strata;
    add("delta", p.delta, always_temporal);
    add("everywhere", p.strata.everywhere, 0);
    add("layers", p.layers, 1);
    add("level", p.level, 1);
    add("max_error_mm", p.strata.max_error_mm, 0);
    add("noise_scaled", p.strata.noise_scaled, 0);
    add("quant_mm", p.quant_mm, 1);
    return text;
}

struct Understood {
    const Kind* kind = nullptr;
    Parameters parameters;
    std::string problem;
};

Understood understand(std::string_view text) {
    Options options = Options::parse(text);
    Understood result;
    result.kind = find_kind(options.kind());
    if (result.kind == nullptr || !result.kind->in_this_build) {
        result.problem = "The depth codec '" + options.kind() +
                         (result.kind ? "' is not in this build" : "' does not exist") +
                         "; choose one of: " + names_in_this_build() + ".";
        return result;
    }
    if (!options.value().empty()) {
        result.problem =
            "In '" + options.text() + "', '" + options.value() + "' is not a key=value pair.";
        return result;
    }
    // RVL of the change since a reference is a codec with its own name.
    if (result.kind->id == DepthCodecId::rvl && options.take_flag("delta"))
        result.kind = find_kind("trvl");
    const bool temporal = result.kind->read(options, result.parameters);
    result.parameters.layers = options.take_int("layers", 1, 1, max_layers);
    result.problem = options.problem();
    if (result.problem.empty() && result.parameters.layers > 1 && !temporal)
        result.problem = "In '" + options.text() +
                         "', layers need a codec that refers to earlier frames, such as trvl.";
    return result;
}

}  // namespace

ParsedDepthSetting parse_depth_setting(std::string_view text) {
    const Understood found = understand(text);
    ParsedDepthSetting parsed;
    parsed.problem = found.problem;
    if (parsed.problem.empty())
        parsed.setting = {found.kind->id, spelling(*found.kind, found.parameters),
                          found.parameters.layers};
    return parsed;
}

std::unique_ptr<DepthCodec> make_depth_codec(const DepthSetting& setting) {
    const Understood found = understand(setting.text);
    assert(found.problem.empty());
    return found.kind->make(found.parameters);
}

std::vector<std::string> depth_codec_names() {
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) {
        if (kind.in_this_build)
            names.emplace_back(kind.name);
    }
    return names;
}

}  // namespace theatron::codec
