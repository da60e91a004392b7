// SPDX-License-Identifier: Apache-2.0
#include "face/sources.h"

#include <algorithm>
#include <cmath>

#include "face/source_table_unified.h"
#include "face/source_tables_xr.h"

namespace theatron::face {
namespace {

constexpr auto arkit_terms = [] {
    std::array<Term, channel_count> terms{};
    for (std::size_t i = 0; i < channel_count; ++i)
        terms[i] = {i, Channel(i)};
    return terms;
}();

SourceTable with_mask(std::span<const std::string_view> inputs, std::span<const Term> terms) {
    SourceTable table{inputs, terms, {}};
    for (const Term& term : terms)
        table.mask.set(term.channel);
    return table;
}

constexpr float open_lid = 0.75F;

float shaped(float value, Shape shape) {
    switch (shape) {
        case Shape::plain:
            break;
        case Shape::positive:
            return std::clamp(value, 0.F, 1.F);
        case Shape::negative:
            return std::clamp(-value, 0.F, 1.F);
        case Shape::lid_closed:
            return std::clamp(1 - value / open_lid, 0.F, 1.F);
        case Shape::lid_wide:
            return std::clamp((value - open_lid) / (1 - open_lid), 0.F, 1.F);
        case Shape::opening:
            return std::clamp(1 - value, 0.F, 1.F);
    }
    return std::clamp(value, 0.F, 1.F);
}

// "XR_FACE_EXPRESSION2_JAW_DROP_FB" -> "JAW_DROP", "XR_LIP_EXPRESSION_JAW_OPEN_HTC" ->
// "LIP_JAW_OPEN"; others unchanged.
struct Plain {
    std::string_view part, rest;
};
Plain plain_name(std::string_view name) {
    struct Spelling {
        std::string_view prefix, part, ending;
    };
    constexpr Spelling spellings[] = {{"XR_FACE_EXPRESSION2_", "", "_FB"},
                                      {"XR_FACE_EXPRESSION_", "", "_FB"},
                                      {"XR_EYE_EXPRESSION_", "EYE_", "_HTC"},
                                      {"XR_LIP_EXPRESSION_", "LIP_", "_HTC"}};
    for (const Spelling& one : spellings)
        if (name.size() > one.prefix.size() + one.ending.size() &&
            name.substr(0, one.prefix.size()) == one.prefix &&
            name.substr(name.size() - one.ending.size()) == one.ending)
            return {one.part, name.substr(one.prefix.size(),
                                          name.size() - one.prefix.size() - one.ending.size())};
    return {"", name};
}

}  // namespace

std::string_view source_name(Source source) {
    switch (source) {
        case Source::arkit:
            return "arkit";
        case Source::unified:
            return "unified";
        case Source::xr_fb_face2:
            return "xr_fb";
        case Source::xr_htc:
            return "xr_htc";
    }
    return "";
}

std::optional<Source> source_of(std::string_view name) {
    for (const Source source : all_sources)
        if (source_name(source) == name)
            return source;
    return std::nullopt;
}

std::optional<std::size_t> SourceTable::input_of(std::string_view name) const {
    const auto [part, rest] = plain_name(name);
    for (std::size_t i = 0; i < inputs.size(); ++i)
        if (inputs[i].size() == part.size() + rest.size() &&
            inputs[i].substr(0, part.size()) == part && inputs[i].substr(part.size()) == rest)
            return i;
    return std::nullopt;
}

const SourceTable& table_of(Source source) {
    static const SourceTable arkit = with_mask(channel_names, arkit_terms);
    static const SourceTable unified = with_mask(unified_inputs, unified_terms);
    static const SourceTable fb = with_mask(fb_inputs, fb_terms);
    static const SourceTable htc = with_mask(htc_inputs, htc_terms);
    switch (source) {
        case Source::arkit:
            break;
        case Source::unified:
            return unified;
        case Source::xr_fb_face2:
            return fb;
        case Source::xr_htc:
            return htc;
    }
    return arkit;
}

Mapped map_inputs(Source source, std::span<const float> inputs, const std::vector<bool>& present) {
    Mapped mapped;
    Channels weights{};
    for (const Term& term : table_of(source).terms) {
        if (term.input >= inputs.size() || term.input >= present.size() || !present[term.input] ||
            !std::isfinite(inputs[term.input]))
            continue;
        mapped.values[term.channel] += term.weight * shaped(inputs[term.input], term.shape);
        weights[term.channel] += term.weight;
        mapped.present.set(term.channel);
    }
    for (std::size_t i = 0; i < channel_count; ++i)
        if (mapped.present[i])
            mapped.values[i] /= weights[i];
    return mapped;
}

Mapped map_inputs(Source source, std::span<const float> inputs) {
    return map_inputs(source, inputs, std::vector<bool>(inputs.size(), true));
}

}  // namespace theatron::face
