// SPDX-License-Identifier: Apache-2.0
// The protocol of a study: what a participant is told, does and is asked, in which order.
//
// Its text has lines "KEY = VALUE" (base/config_text.h); docs/formats/study.md describes them:
//
//   study = Splats or mesh
//   seed = 7
//   order = latin-square
//   condition = splats            # begins a condition; the values that a session takes follow
//     renderer = splat
//   condition = mesh
//     renderer = mesh
//   phase = agree                 # begins a phase
//     kind = consent
//     text = I agree ...
//   phase = build
//     kind = bricks
//     each-condition = yes
//
// Pure and safe for any bytes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "study/questionnaire.h"

namespace theatron::study {

inline constexpr std::size_t max_conditions = 12;
inline constexpr std::size_t max_phases = 50;
inline constexpr std::size_t max_paragraphs = 40;  // of a phase
inline constexpr std::size_t max_text_files = 16;
inline constexpr int max_task_questions = 12;
inline constexpr int max_bricks = 40;
inline constexpr int max_phase_seconds = 3600;
inline constexpr int max_added_latency_ms = 5000;

struct Condition {
    std::string id;
    // Values that a session takes; empty or 0: as usual.
    std::string renderer, color_codec, depth_codec;
    int latency_ms = 0;  // added to that of the session
    int line = 0;
};

struct Phase {
    enum class Kind { consent, instruction, questionnaire, bricks, pause };
    std::string id;
    Kind kind = Kind::instruction;
    bool has_kind = false;
    bool each_condition = false;
    std::vector<std::string> texts;           // paragraphs
    std::vector<std::string> questionnaires;  // names
    int bricks = 8, questions = 3;            // of a task
    int watch_s = 60;                         // before the questions of a task
    int limit_s = 0;                          // for a reply to one of them; 0: none
    int line = 0;
};

enum class Order { as_written, random, latin_square };

struct Protocol {
    std::string title, break_off;
    std::uint64_t seed = 1;
    Order order = Order::latin_square;
    std::vector<std::string> text_files;  // of questionnaires; names in the study's folder
    std::vector<Condition> conditions;
    std::vector<Phase> phases;
    std::uint64_t hash = 0;  // of the text
};

struct ReadProtocol {
    Protocol protocol;
    std::vector<ConfigMistake> mistakes;  // all; with any of them the protocol is of no use
};

ReadProtocol parse_protocol(std::string_view text);

// Mistakes that need the questionnaires: names that are none, texts that are missing.
std::vector<ConfigMistake> check_questionnaires(const Protocol& protocol,
                                                const Questionnaires& known);

// Questionnaires of the protocol with a rated item whose points have no meaning.
std::vector<std::string> without_anchors(const Protocol& protocol, const Questionnaires& known);

// The beginning of a new study: an example with comments, which is right and runs at once.
std::string_view example_protocol();

// "renderer=mesh latency-ms=80"; "as usual" without values.
std::string values_text(const Condition& condition);

// Not cryptographic: notices that a file was changed. `before`: that of the texts before.
std::uint64_t text_hash(std::string_view text, std::uint64_t before = 0xcbf29ce484222325u);

}  // namespace theatron::study
